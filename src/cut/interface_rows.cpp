#include "interface_rows.hpp"

#include <algorithm>
#include <cmath>

#include "grid/momentum.hpp"
#include "membrane/outline.hpp"
#include "outline_pieces.hpp"
#include "wet_cells.hpp"

namespace geodrop {
namespace {

/// Shorter stretches than this join the next one: a corner of a cell pins no pressure down [width of the cell].
constexpr double least_length = 0.25;

double light_mass(const Grid<2>& grid, int node) {
  return light_mass<2>(grid, {node % grid.layout.stride[1], node / grid.layout.stride[1]});
}

}  // namespace

double length_of(const Membrane<2>& membrane, const CutCells::Piece& piece) {
  return (piece.to - piece.from) * segment_length(membrane, static_cast<std::size_t>(piece.edge));
}

std::vector<Stretch> wet_stretches(const Grid<2>& around, const Membrane<2>& membrane, const CutCells& cells) {
  const auto& pieces = cells.pieces;
  const std::size_t n = pieces.size();
  const auto wet = [&](std::size_t k) { return is_wet(around, flat_of(around.layout, cells, pieces[k].cell)); };
  std::size_t start = 0;  // where a cell begins
  while (start + 1 < n && pieces[start].cell == pieces[(start + n - 1) % n].cell) ++start;
  std::vector<Stretch> stretches;
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
    const double least = least_length * least_width(around.layout, flat_of(around.layout, cells, pieces[at].cell));
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

int Columns::of(int field, int node) {
  int& number = number_[field][node];
  if (number >= 0) return number;
  number = 2 * static_cast<int>(places_.size());
  const GridLayout<2>& layout = grids_[field].layout;
  Place place{field, node, std::sqrt(grids_[field].sum[node][3]), {false, false}};
  const int at[] = {node % layout.stride[1] - layout.pad, node / layout.stride[1] - layout.pad};
  for (int a = 0; a < 2; ++a) {
    if (at[a] != 0 && at[a] != layout.cells[a]) continue;
    place.fixed[a] = true;
    const WallKind wall = at[a] == 0 ? layout.lower_wall[a] : layout.upper_wall[a];
    if (wall == WallKind::no_slip) place.fixed[1 - a] = true;
  }
  places_.push_back(place);
  return number;
}

std::vector<NodeVector> line_integrals(const GridLayout<2>& layout, const Membrane<2>& membrane, const CutCells& cells,
                                       const Stretch& stretch, Direction direction) {
  std::vector<NodeVector> out;
  for_each_piece(cells, stretch, [&](const CutCells::Piece& piece) {
    const PieceIntegral integral = integrate_piece(layout, membrane, cells, piece);
    const auto [nx, ny] = integral.normal;
    const std::array<double, 2> along = direction == Direction::normal ? integral.normal : std::array{-ny, nx};
    const int flat = flat_of(layout, cells, piece.cell);
    for (int n = 0; n < 9; ++n)
      out.push_back({node_around(layout, flat, n), {integral.mean[n] * along[0], integral.mean[n] * along[1]}});
  });
  return out;
}

bool Rows::add(int field, int other, const std::vector<NodeVector>& vectors) {
  const bool complete = add_field(field, 1, vectors) && add_field(other, -1, vectors);
  end_row(complete);
  return complete;
}

bool Rows::add_field(int field, double sign, const std::vector<NodeVector>& vectors) {
  const Grid<2>& grid = grids_[field];
  std::array<double, 2> nowhere{};  // vectors with no mass around
  const std::size_t before = touched_.size();
  for (const NodeVector& vector : vectors) {
    const double mass = grid.sum[vector.node][3], kept = std::min(1.0, mass / light_mass(grid, vector.node));
    const std::array<double, 2> value = {sign * vector.value[0], sign * vector.value[1]};
    if (kept > 0) put(field, vector.node, kept, value);
    if (kept < 1 && !spread(field, vector.node, 1 - kept, value))
      for (int a = 0; a < 2; ++a) nowhere[a] += value[a];
  }
  if (touched_.size() == before) return false;
  if (nowhere[0] != 0 || nowhere[1] != 0) spread_over_row(before, field, nowhere);
  return true;
}

void Rows::put(int field, int node, double share, const std::array<double, 2>& value) {
  const int column = columns_.of(field, node);
  const Columns::Place& place = columns_.places()[column / 2];
  const double scale = share / place.root_mass;
  value_.resize(2 * columns_.places().size(), 0.0);
  for (int a = 0; a < 2; ++a) {
    if (place.fixed[a]) continue;
    if (value_[column + a] == 0) touched_.push_back(column + a);
    value_[column + a] += scale * value[a];
  }
}

/// As grid/momentum hands on what a light node cannot take; false if nothing around has mass.
bool Rows::spread(int field, int node, double share, const std::array<double, 2>& value) {
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
void Rows::spread_over_row(std::size_t first, int field, const std::array<double, 2>& value) {
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

void Rows::end_row(bool keep) {
  std::sort(touched_.begin(), touched_.end());
  touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
  for (const int column : touched_) {
    if (keep) entries_.emplace_back(column, value_[column]);
    value_[column] = 0;
  }
  if (keep) row_begin_.push_back(static_cast<int>(entries_.size()));
  touched_.clear();
}

SparseRows Rows::matrix() const {
  SparseRows E(count(), 2 * static_cast<int>(columns_.places().size()));
  E.reserve(static_cast<int>(entries_.size()));
  for (int r = 0; r < count(); ++r) {
    E.startVec(r);
    for (int k = row_begin_[r]; k < row_begin_[r + 1]; ++k) E.insertBack(r, entries_[k].first) = entries_[k].second;
  }
  E.finalize();
  return E;
}

SparseRows Rows::drag(double dt) {
  struct Pair {
    int water, soil;
    double water_share, soil_share;  // dt c / m
  };
  std::vector<Pair> pairs;
  std::vector<int> soil_of(grids_.size(), -1);
  for (const Grid<2>& grid : grids_)
    if (grid.pore_water >= 0) soil_of[grid.pore_water] = grid.field;
  for (std::size_t k = 0; k < columns_.places().size(); ++k) {  // grows
    const auto [field, node] = std::pair(columns_.places()[k].field, columns_.places()[k].node);
    const int soil = grids_[field].pore_water >= 0 ? field : soil_of[field];
    if (soil < 0) continue;
    const Grid<2>&grid = grids_[soil], &around = grids_[grid.pore_water];
    const double c = dt * around.node_drag[node];
    if (!(c > 0 && grid.sum[node][3] > 0 && around.sum[node][3] > 0)) continue;
    const int water_column = columns_.of(around.field, node), soil_column = columns_.of(soil, node);
    pairs.push_back({water_column, soil_column, c / around.sum[node][3], c / grid.sum[node][3]});
  }
  if (pairs.empty()) return {};
  const auto n = static_cast<Eigen::Index>(2 * columns_.places().size());
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<bool> paired(n, false);
  for (const auto& [water, soil, of_water, of_soil] : pairs)
    for (int a = 0; a < 2; ++a) {
      if (paired[water + a] /* both of a pair name it */ || columns_.places()[water / 2].fixed[a]) continue;
      const double scale = 1 / (1 + of_water + of_soil), both = std::sqrt(of_water * of_soil) * scale;
      entries.emplace_back(water + a, water + a, (1 + of_soil) * scale);
      entries.emplace_back(soil + a, soil + a, (1 + of_water) * scale);
      entries.emplace_back(water + a, soil + a, both);
      entries.emplace_back(soil + a, water + a, both);
      paired[water + a] = paired[soil + a] = true;
    }
  for (Eigen::Index k = 0; k < n; ++k)
    if (!paired[k]) entries.emplace_back(k, k, 1.0);
  SparseRows out(n, n);
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

Eigen::VectorXd Rows::scaled_velocities() const {
  const auto& places = columns_.places();
  Eigen::VectorXd scaled(2 * places.size());
  for (std::size_t n = 0; n < places.size(); ++n)
    for (int a = 0; a < 2; ++a)
      scaled[2 * n + a] = places[n].root_mass * grids_[places[n].field].velocity[places[n].node][a];
  return scaled;
}

void apply_pressures(const Rows& rows, const SparseRows& E, const Eigen::VectorXd& pressure, double dt,
                     Grids<2>& grids) {
  const auto& places = rows.columns().places();
  const Eigen::VectorXd change = -dt * (E.transpose() * pressure);
  for (std::size_t n = 0; n < places.size(); ++n) {
    Grid<2>& grid = grids[places[n].field];
    for (int a = 0; a < 2; ++a) {
      const double v = change[2 * n + a] / places[n].root_mass;
      grid.velocity[places[n].node][a] += v;
      if (!grid.velocity_change.empty()) grid.velocity_change[places[n].node][a] += v;
    }
  }
}

}  // namespace geodrop
