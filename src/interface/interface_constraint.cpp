#include "interface_constraint.hpp"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

#include <algorithm>
#include <utility>
#include <vector>

#include "../grid/momentum.hpp"
#include "outline_pieces.hpp"

namespace geodrop {
namespace {

using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// A vector at a node.
struct NodeVector {
  int node;
  std::array<double, 2> value;
};

/// A part of an outline with one multiplier: consecutive pieces, [first, last) in CutCells::pieces, round its end.
struct Stretch {
  std::size_t first = 0, count = 0;
  double length = 0;  ///< [m]
};

/// Shorter stretches than this join the next one: a corner of a cell pins no pressure down [h].
constexpr double least_length = 0.25;

double length_of(const Membrane<2>& membrane, const CutCells::Piece& piece) {
  const std::size_t from = piece.edge, to = end_of_edge(from, membrane.nodes());
  return (piece.to - piece.from) * std::hypot(membrane.x[0][to] - membrane.x[0][from],  //
                                              membrane.x[1][to] - membrane.x[1][from]);
}

/// The stretches of an outline that has water beside it. Two flanks in one cell are two stretches.
std::vector<Stretch> wet_stretches(const Grid<2>& around, const Membrane<2>& membrane, const CutCells& cells) {
  const auto& pieces = cells.pieces;
  const std::size_t n = pieces.size();
  const auto wet = [&](std::size_t k) {
    return (around.cell_flags[flat_of(around.layout, cells, pieces[k].cell)] & cell_filled) != 0;
  };
  std::size_t start = 0;  // where a cell begins
  while (start + 1 < n && pieces[start].cell == pieces[(start + n - 1) % n].cell) ++start;
  std::vector<Stretch> stretches;
  const double least = least_length * around.layout.h;
  bool open = false;  // the last stretch goes on
  for (std::size_t k = 0; k < n;) {
    const std::size_t at = (start + k) % n;
    Stretch visit{at, 0, 0};
    for (; k < n && pieces[(start + k) % n].cell == pieces[at].cell; ++k, ++visit.count)
      visit.length += length_of(membrane, pieces[(start + k) % n]);
    if (!wet(at)) {
      open = false;
      continue;
    }
    const bool join = open && (visit.length < least || stretches.back().length < least);
    if (join) {
      stretches.back().count += visit.count;
      stretches.back().length += visit.length;
    } else {
      stretches.push_back(visit);
    }
    open = true;
  }
  return stretches;
}

/// int N n dl over a stretch.
std::vector<NodeVector> normals_of(const GridLayout<2>& layout, const Membrane<2>& membrane, const CutCells& cells,
                                   const Stretch& stretch) {
  std::vector<NodeVector> out;
  for (std::size_t k = 0; k < stretch.count; ++k) {
    const CutCells::Piece& piece = cells.pieces[(stretch.first + k) % cells.pieces.size()];
    const PieceIntegral integral = integrate_piece(layout, membrane, cells, piece);
    const int flat = flat_of(layout, cells, piece.cell);
    for (int n = 0; n < 9; ++n)
      out.push_back({node_around(layout, flat, n),
                     {integral.mean[n] * integral.normal[0], integral.mean[n] * integral.normal[1]}});
  }
  return out;
}

/// The nodes that the rows of E reach, of all fields: two columns each.
class Columns {
 public:
  struct Place {
    int field, node;
    double root_mass;  ///< [kg^1/2]
  };

  explicit Columns(const Grids<2>& grids)
      : grids_(grids), number_(grids.size(), std::vector<int>(grids.front().layout.nodes(), -1)) {}

  /// Number of the first of both columns of a node that has mass.
  int of(int field, int node) {
    int& number = number_[field][node];
    if (number < 0) {
      number = 2 * static_cast<int>(places_.size());
      places_.push_back({field, node, std::sqrt(grids_[field].sum[node][3])});
    }
    return number;
  }
  const std::vector<Place>& places() const { return places_; }

 private:
  const Grids<2>& grids_;
  std::vector<std::vector<int>> number_;  ///< by field and node
  std::vector<Place> places_;
};

/// Builds E M^-1/2 row by row.
class Rows {
 public:
  explicit Rows(const Grids<2>& grids) : grids_(grids), columns_(grids) {}

  /// Adds sign times the vectors to the present row, as a field's nodes can take them. Field without mass there: false.
  bool add(int field, double sign, const std::vector<NodeVector>& vectors) {
    const Grid<2>& grid = grids_[field];
    std::array<double, 2> nowhere{};  // vectors with no mass around
    const std::size_t before = touched_.size();
    for (const NodeVector& vector : vectors) {
      const double mass = grid.sum[vector.node][3], kept = std::min(1.0, mass / grid.light_mass);
      const std::array<double, 2> value = {sign * vector.value[0], sign * vector.value[1]};
      if (kept > 0) put(field, vector.node, kept, value);
      if (kept < 1 && !spread(field, vector.node, 1 - kept, value))
        for (int a = 0; a < 2; ++a) nowhere[a] += value[a];
    }
    if (touched_.size() == before) return false;
    if (nowhere[0] != 0 || nowhere[1] != 0) spread_over_row(before, field, nowhere);
    return true;
  }

  void end_row() {
    std::sort(touched_.begin(), touched_.end());
    touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
    for (const int column : touched_) {
      entries_.emplace_back(column, value_[column]);
      value_[column] = 0;
    }
    row_begin_.push_back(static_cast<int>(entries_.size()));
    touched_.clear();
  }
  void drop_row() {
    for (const int column : touched_) value_[column] = 0;
    touched_.clear();
  }

  const Columns& columns() const { return columns_; }
  int count() const { return static_cast<int>(row_begin_.size()) - 1; }
  Matrix matrix() const {
    Matrix E(count(), 2 * static_cast<int>(columns_.places().size()));
    E.reserve(static_cast<int>(entries_.size()));
    for (int r = 0; r < count(); ++r) {
      E.startVec(r);
      for (int k = row_begin_[r]; k < row_begin_[r + 1]; ++k) E.insertBack(r, entries_[k].first) = entries_[k].second;
    }
    E.finalize();
    return E;
  }

 private:
  void put(int field, int node, double share, const std::array<double, 2>& value) {
    const int column = columns_.of(field, node);
    const double scale = share / columns_.places()[column / 2].root_mass;
    value_.resize(2 * columns_.places().size(), 0.0);
    for (int a = 0; a < 2; ++a) {
      if (value_[column + a] == 0) touched_.push_back(column + a);
      value_[column + a] += scale * value[a];
    }
  }

  /// As grid/momentum hands on what a light node cannot take; false if nothing around has mass.
  bool spread(int field, int node, double share, const std::array<double, 2>& value) {
    const Grid<2>& grid = grids_[field];
    double mass = 0;
    for (int n = 0; n < 9; ++n) mass += grid.sum[node_around(grid.layout, node, n)][3];
    if (mass <= 0) return false;
    for (int n = 0; n < 9; ++n) {
      const int other = node_around(grid.layout, node, n);
      if (grid.sum[other][3] > 0) put(field, other, share * grid.sum[other][3] / mass, value);
    }
    return true;
  }

  /// Hands the rest to the nodes that the row reaches in this field already, by their mass.
  void spread_over_row(std::size_t first, int field, const std::array<double, 2>& value) {
    std::vector<int> nodes;
    double mass = 0;
    for (std::size_t k = first; k < touched_.size(); ++k) {
      const int node = columns_.places()[touched_[k] / 2].node;
      if (std::find(nodes.begin(), nodes.end(), node) != nodes.end()) continue;
      nodes.push_back(node);
      mass += grids_[field].sum[node][3];
    }
    for (const int node : nodes) put(field, node, grids_[field].sum[node][3] / mass, value);
  }

  const Grids<2>& grids_;
  Columns columns_;
  std::vector<double> value_;  ///< of the present row, by column
  std::vector<int> touched_;
  std::vector<std::pair<int, double>> entries_;
  std::vector<int> row_begin_{0};
};

/// A row, the membrane that it belongs to and the part of its outline.
struct Contact {
  Membrane<2>* membrane;
  Stretch stretch;
};

/// f(piece) for the pieces of a stretch.
template <class F>
void for_each_piece(const CutCells& cells, const Stretch& stretch, F&& f) {
  for (std::size_t k = 0; k < stretch.count; ++k) f(cells.pieces[(stretch.first + k) % cells.pieces.size()]);
}

/// Mean over a stretch of the pressure that its segments had.
double last_pressure(const Contact& contact, const CutCells& cells) {
  double sum = 0;
  for_each_piece(cells, contact.stretch, [&](const CutCells::Piece& piece) {
    sum += contact.membrane->water_pressure[piece.edge] * length_of(*contact.membrane, piece);
  });
  return contact.stretch.length > 0 ? sum / contact.stretch.length : 0;
}

std::vector<Contact> build_rows(State<2>& state, const Grids<2>& grids, Rows& rows) {
  std::vector<Contact> contacts;
  for (Membrane<2>& membrane : state.membranes) {
    if (!membrane.sharp || membrane.field == waiting) continue;
    const CutCells& cells = grids[membrane.field].outline;
    for (const Stretch& stretch : wet_stretches(grids.front(), membrane, cells)) {
      const std::vector<NodeVector> normals = normals_of(grids.front().layout, membrane, cells, stretch);
      if (rows.add(membrane.field, 1, normals) && rows.add(0, -1, normals)) {
        rows.end_row();
        contacts.push_back({&membrane, stretch});
      } else {
        rows.drop_row();
      }
    }
  }
  return contacts;
}

/// Pressures that make the velocities agree.
Eigen::VectorXd solve(const Matrix& E, const Eigen::VectorXd& gap_rate, const Eigen::VectorXd& guess) {
  constexpr double tolerance = 1e-8;  // of the gap's rate
  constexpr int most_iterations = 1000;
  const Matrix S = E * E.transpose();
  Eigen::ConjugateGradient<Matrix, Eigen::Lower | Eigen::Upper> solver(S);
  solver.setTolerance(tolerance);
  solver.setMaxIterations(most_iterations);
  return solver.solveWithGuess(gap_rate, guess);
}

void store_pressures(const std::vector<Contact>& contacts, const Eigen::VectorXd& pressure, const Grids<2>& grids,
                     State<2>& state) {
  for (Membrane<2>& membrane : state.membranes)
    std::fill(membrane.water_pressure.begin(), membrane.water_pressure.end(), 0.0);
  for (std::size_t r = 0; r < contacts.size(); ++r) {
    Membrane<2>& membrane = *contacts[r].membrane;
    for_each_piece(grids[membrane.field].outline, contacts[r].stretch, [&](const CutCells::Piece& piece) {
      membrane.water_pressure[piece.edge] += (piece.to - piece.from) * pressure[static_cast<Eigen::Index>(r)];
    });
  }
}

}  // namespace

template <>
void join_interfaces(State<2>& state, Grids<2>& grids, double dt) {
  Rows rows(grids);
  const std::vector<Contact> contacts = build_rows(state, grids, rows);
  const Matrix E = rows.matrix();
  const auto& places = rows.columns().places();
  Eigen::VectorXd scaled(2 * places.size()), guess(contacts.size());  // M^1/2 v
  for (std::size_t n = 0; n < places.size(); ++n)
    for (int a = 0; a < 2; ++a)
      scaled[2 * n + a] = places[n].root_mass * grids[places[n].field].velocity[places[n].node][a];
  for (std::size_t r = 0; r < contacts.size(); ++r)
    guess[r] = last_pressure(contacts[r], grids[contacts[r].membrane->field].outline);
  const Eigen::VectorXd pressure = solve(E, E * scaled / dt, guess);
  const Eigen::VectorXd change = -dt * (E.transpose() * pressure);
  for (std::size_t n = 0; n < places.size(); ++n) {
    Grid<2>& grid = grids[places[n].field];
    for (int a = 0; a < 2; ++a) {
      const double v = change[2 * n + a] / places[n].root_mass;
      grid.velocity[places[n].node][a] += v;
      if (!grid.velocity_change.empty()) grid.velocity_change[places[n].node][a] += v;
    }
  }
  for (Grid<2>& grid : grids) impose_wall_velocity(grid);
  store_pressures(contacts, pressure, grids, state);
}

// Sharp interfaces are for the plane: check_scene refuses them in space.
template <>
void join_interfaces(State<3>&, Grids<3>&, double) {}

}  // namespace geodrop
