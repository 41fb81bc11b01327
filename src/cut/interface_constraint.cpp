#include "interface_constraint.hpp"

#include <geodrop/base/error.hpp>
#include <geodrop/base/find_named.hpp>

#include <Eigen/Dense>
#include <Eigen/IterativeLinearSolvers>

#include <algorithm>
#include <limits>
#include <sstream>
#include <utility>

#include "grid/momentum.hpp"
#include "interface_rows.hpp"
#include "outline_pieces.hpp"

namespace geodrop {
namespace {

/// A stretch of a membrane and what lies there.
struct Contact {
  Membrane<2>* membrane;
  Stretch stretch;
  bool on_bed = false;
  double pore_pressure = 0;  ///< of the bed [Pa]
  double inside = 0;         ///< effective pressure of the soil inside on a membrane that slides over it [Pa]
  bool joined = false;       ///< both sides have mass there
  double pressure = 0;       ///< [Pa]

  bool over_soil() const { return !membrane->contents_pressure.empty(); }
  bool sticks() const { return !on_bed && membrane->shear == Shear::no_slip && !over_soil(); }
  bool rubs() const { return on_bed || (membrane->shear != Shear::none && !sticks()); }

  /// Largest traction along it [Pa]: what is around can give, and the soil inside can take. slip [m2/s]: the velocity
  /// of slipping times the length.
  double most_friction(double slip) const {
    const double taken = over_soil() ? membrane->contents_friction * inside : std::numeric_limits<double>::infinity();
    if (on_bed) return std::min(taken, std::max(0.0, membrane->bed_friction * (pressure - pore_pressure)));
    if (membrane->shear == Shear::no_slip) return taken;
    const double velocity = slip / stretch.length;
    return std::min(taken, 0.5 * membrane->fluid_density * membrane->wall_friction * velocity * velocity);
  }
};

/// Mean over a stretch of the effective pressure inside.
double pressure_inside(const Membrane<2>& membrane, const CutCells& cells, const Stretch& stretch) {
  const Array<double>& pressure = membrane.contents_pressure;
  double sum = 0;
  for_each_piece(cells, stretch, [&](const CutCells::Piece& piece) {
    const std::size_t start = piece.edge, end = end_of_edge(start, membrane.nodes());
    const double middle = 0.5 * (piece.from + piece.to);
    sum += length_of(membrane, piece) * ((1 - middle) * pressure[start] + middle * pressure[end]);
  });
  return stretch.length > 0 ? sum / stretch.length : 0;
}

/// Mean over a stretch of the traction that its segments had.
double last_traction(const Contact& contact, const CutCells& cells, Direction direction) {
  const bool normal = direction == Direction::normal;
  const Array<double>& traction = normal ? contact.membrane->water_pressure : contact.membrane->water_shear;
  double sum = 0;
  for_each_piece(cells, contact.stretch, [&](const CutCells::Piece& piece) {
    sum += traction[piece.edge] * length_of(*contact.membrane, piece);
  });
  return contact.stretch.length > 0 ? (normal ? sum : -cells.sense * sum) / contact.stretch.length : 0;
}

void forget_tractions(Membrane<2>& membrane) {
  std::fill(membrane.water_pressure.begin(), membrane.water_pressure.end(), 0.0);
  std::fill(membrane.water_shear.begin(), membrane.water_shear.end(), 0.0);
  std::fill(membrane.bed_shear.begin(), membrane.bed_shear.end(), 0.0);
}

/// Where the bed is around a membrane: volume of its particles in each cell of the box, and that times pore pressure.
struct BedCells {
  Array<double> volume, pore;
};

BedCells bed_around(const State<2>& state, const GridLayout<2>& layout, const Membrane<2>& membrane,
                    const CutCells& cells) {
  BedCells out{Array<double>(cells.size(), 0.0), Array<double>(cells.size(), 0.0)};
  const Body<2>& bed = find_named(state.bodies, membrane.bed);
  for (std::size_t p = 0; p < bed.size(); ++p) {
    const int cell = local_cell(layout, cells, bed.x[0][p], bed.x[1][p]);
    if (cell < 0) continue;
    const double volume = bed.volume(p);
    out.volume[cell] += volume;
    if (!bed.pore_pressure.empty()) out.pore[cell] += volume * bed.pore_pressure[p];
  }
  return out;
}

/// Whether a stretch lies on the bed: most of what is in the cells around it.
void look_for_bed(const Grid<2>& around, const CutCells& cells, const BedCells& bed, Contact& contact) {
  double soil = 0, pore = 0, all = 0;
  for_each_piece(cells, contact.stretch, [&](const CutCells::Piece& piece) {
    for (int n = 0; n < 9; ++n) {
      const int local = local_around(cells, piece.cell, n);
      soil += bed.volume[local];
      pore += bed.pore[local];
      all += around.cell_volume[flat_of(around.layout, cells, local)];
    }
  });
  contact.on_bed = soil > 0.5 * all;
  if (contact.on_bed) contact.pore_pressure = pore / soil;
}

std::vector<Contact> find_contacts(State<2>& state, const Grids<2>& grids) {
  std::vector<Contact> contacts;
  const Grid<2>& around = grids.front();
  for (Membrane<2>& membrane : state.membranes) {
    if (!acts_sharply(membrane)) continue;
    const CutCells& cells = grids[membrane.field].outline;
    const BedCells bed = membrane.bed.empty() ? BedCells{} : bed_around(state, around.layout, membrane, cells);
    for (const Stretch& stretch : wet_stretches(around, membrane, cells)) {
      contacts.push_back({&membrane, stretch});
      if (!membrane.bed.empty()) look_for_bed(around, cells, bed, contacts.back());
      if (contacts.back().over_soil()) contacts.back().inside = pressure_inside(membrane, cells, stretch);
    }
  }
  return contacts;
}

/// Rows for some of the contacts.
class ContactRows {
 public:
  struct Row {
    std::size_t contact;
    Direction direction;
  };

  explicit ContactRows(const Grids<2>& grids) : grids_(grids), rows_(grids) {}

  /// False if one of the sides has no mass there.
  bool add(const std::vector<Contact>& contacts, std::size_t c, Direction direction) {
    const Membrane<2>& membrane = *contacts[c].membrane;
    const CutCells& cells = grids_[membrane.field].outline;
    const GridLayout<2>& layout = grids_.front().layout;
    if (!rows_.add(membrane.field, 0, line_integrals(layout, membrane, cells, contacts[c].stretch, direction)))
      return false;
    list_.push_back({c, direction});
    return true;
  }

  const Rows& rows() const { return rows_; }
  const std::vector<Row>& list() const { return list_; }

 private:
  const Grids<2>& grids_;
  Rows rows_;
  std::vector<Row> list_;
};

/// Adds up the tractions of rows on the segments of membranes.
void store(const ContactRows& rows, const Eigen::VectorXd& traction, const Grids<2>& grids,
           std::vector<Contact>& contacts) {
  for (std::size_t r = 0; r < rows.list().size(); ++r) {
    const std::size_t c = rows.list()[r].contact;
    const Direction direction = rows.list()[r].direction;
    Membrane<2>& membrane = *contacts[c].membrane;
    const CutCells& cells = grids[membrane.field].outline;
    const bool normal = direction == Direction::normal;
    if (normal) contacts[c].pressure = traction[static_cast<Eigen::Index>(r)];
    Array<double>& target = normal ? membrane.water_pressure : membrane.water_shear;
    const double sign =
        normal ? 1 : -cells.sense;  // -p t acts on the membrane, t with the nodes if they run anticlockwise
    for_each_piece(cells, contacts[c].stretch, [&](const CutCells::Piece& piece) {
      const double part = sign * (piece.to - piece.from) * traction[static_cast<Eigen::Index>(r)];
      target[piece.edge] += part;
      if (!normal && contacts[c].on_bed) membrane.bed_shear[piece.edge] += part;
    });
  }
}

/// Tractions of rows, and whether they are as exact as asked.
struct Solution {
  Eigen::VectorXd traction;
  bool converged;
};

/// Tractions that stop the gaps from opening and closing, and the slip where it sticks.
Solution solve(const SparseRows& S, const Eigen::VectorXd& gap_rate, const Eigen::VectorXd& guess) {
  constexpr double tolerance = 1e-8;  // of the gaps' rate
  constexpr int most_iterations = 1000;
  Eigen::ConjugateGradient<SparseRows, Eigen::Lower | Eigen::Upper> solver(S);
  solver.setTolerance(tolerance);
  solver.setMaxIterations(most_iterations);
  Eigen::VectorXd traction = solver.solveWithGuess(gap_rate, guess);
  return {std::move(traction), solver.info() == Eigen::Success};
}

/// The same, where some rows may only push: those that would pull are open, and take no part, unless their gap would
/// close then (primal-dual active sets, Hintermueller et al. 2002).
Solution solve(const SparseRows& E, const Eigen::VectorXd& velocity_rate, const std::vector<bool>& only_pushes,
               const Eigen::VectorXd& guess) {
  constexpr int most_rounds = 10;
  const SparseRows S = E * E.transpose();
  const Eigen::VectorXd gap_rate = E * velocity_rate;
  Solution found = solve(S, gap_rate, guess);
  if (std::find(only_pushes.begin(), only_pushes.end(), true) == only_pushes.end()) return found;
  Eigen::VectorXd joined = Eigen::VectorXd::Ones(gap_rate.size());
  for (int round = 0; round < most_rounds; ++round) {
    const Eigen::VectorXd closing = gap_rate - S * found.traction;
    bool changed = false;
    for (Eigen::Index r = 0; r < gap_rate.size(); ++r) {
      const double pushes = only_pushes[r] && found.traction[r] + closing[r] / S.coeff(r, r) < 0 ? 0 : 1;
      changed = changed || pushes != joined[r];
      joined[r] = pushes;
    }
    if (!changed) return found;
    const SparseRows F = joined.asDiagonal() * E;
    SparseRows of_joined = F * F.transpose();
    of_joined.diagonal().array() += 1 - joined.array();
    found = solve(of_joined, joined.cwiseProduct(gap_rate), joined.cwiseProduct(guess));
  }
  found.converged = false;  // the last sets are not those of their solution
  return found;
}

/// Counts steps without a solution; throws when they are too many in a row.
void note(bool converged, double t, ConstraintWatch& watch) {
  constexpr std::uint64_t most_in_a_row = 100;
  watch.in_a_row = converged ? 0 : watch.in_a_row + 1;
  watch.unsolved += converged ? 0 : 1;
  if (watch.in_a_row < most_in_a_row) return;
  std::ostringstream text;
  text << "the pressures on sharp membranes were not found in " << watch.in_a_row
       << " steps in a row (conjugate gradients to 1e-8, ten active sets), t = " << t << " s; " << watch.unsolved
       << " steps so far. Membrane nodes that have run into each other, or a body thinner than a cell, are common "
          "causes";
  throw RunError(text.str());
}

/// One normal velocity, and one velocity where the fluid sticks; false if they were not found.
bool join(double dt, std::vector<Contact>& contacts, Grids<2>& grids) {
  ContactRows rows(grids);
  for (std::size_t c = 0; c < contacts.size(); ++c)
    if (contacts[c].joined = rows.add(contacts, c, Direction::normal); contacts[c].joined && contacts[c].sticks())
      rows.add(contacts, c, Direction::tangent);
  Eigen::VectorXd guess(rows.list().size());
  for (std::size_t r = 0; r < rows.list().size(); ++r) {
    const auto [c, direction] = rows.list()[r];
    guess[r] = last_traction(contacts[c], grids[contacts[c].membrane->field].outline, direction);
  }
  for (const Contact& contact : contacts) forget_tractions(*contact.membrane);
  if (rows.list().empty()) return true;
  std::vector<bool> only_pushes;
  for (const ContactRows::Row& row : rows.list())
    only_pushes.push_back(row.direction == Direction::normal && contacts[row.contact].on_bed);
  const SparseRows E = rows.rows().matrix();
  const auto [traction, converged] = solve(E, rows.rows().scaled_velocities() / dt, only_pushes, guess);
  apply_pressures(rows.rows(), E, traction, dt, grids);
  store(rows, traction, grids, contacts);
  return converged;
}

/// Tractions that stop the slip of rows, each at most `most`: projected Gauss-Seidel from a guess.
Eigen::VectorXd solve_limited(const SparseRows& S, const Eigen::VectorXd& slip_rate, const Eigen::VectorXd& most,
                              Eigen::VectorXd traction) {
  constexpr int most_sweeps = 200;
  constexpr double tolerance = 1e-6;  // of the largest traction
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    double change = 0;
    for (Eigen::Index r = 0; r < S.rows(); ++r) {
      double held = 0, diagonal = 1;
      for (SparseRows::InnerIterator entry(S, r); entry; ++entry) {
        held += entry.value() * traction[entry.col()];
        if (entry.col() == r) diagonal = entry.value();
      }
      const double before = traction[r];
      traction[r] = std::clamp(before + (slip_rate[r] - held) / diagonal, -most[r], most[r]);
      change = std::max(change, std::abs(traction[r] - before));
    }
    if (change <= tolerance * traction.cwiseAbs().maxCoeff()) break;
  }
  return traction;
}

/// Friction: tractions along the membrane that stop it from slipping, at most mu times the effective pressure on the
/// bed, what the soil inside takes where water would stick, or what the wall law says in fluid.
void rub(double dt, std::vector<Contact>& contacts, Grids<2>& grids, const std::vector<double>& last) {
  ContactRows rows(grids);
  for (std::size_t c = 0; c < contacts.size(); ++c)
    if (contacts[c].joined && contacts[c].rubs()) rows.add(contacts, c, Direction::tangent);
  if (rows.list().empty()) return;
  const SparseRows T = rows.rows().matrix(), S = T * T.transpose();
  const Eigen::VectorXd slip = T * rows.rows().scaled_velocities();
  Eigen::VectorXd guess(S.rows()), most(S.rows());
  for (Eigen::Index r = 0; r < S.rows(); ++r) {
    const std::size_t c = rows.list()[static_cast<std::size_t>(r)].contact;
    most[r] = contacts[c].most_friction(slip[r]);
    guess[r] = std::clamp(last[c], -most[r], most[r]);
  }
  const Eigen::VectorXd traction = solve_limited(S, slip / dt, most, guess);
  apply_pressures(rows.rows(), T, traction, dt, grids);
  store(rows, traction, grids, contacts);
}

}  // namespace

void join_interfaces(State<2>& state, Grids<2>& grids, double dt) {
  std::vector<Contact> contacts = find_contacts(state, grids);
  std::vector<double> last;  // tractions along the membrane, before they are forgotten
  for (const Contact& contact : contacts)
    last.push_back(last_traction(contact, grids[contact.membrane->field].outline, Direction::tangent));
  note(join(dt, contacts, grids), state.t, state.constraint_watch);
  rub(dt, contacts, grids, last);
  for (Grid<2>& grid : grids) impose_wall_velocity(grid);
}

}  // namespace geodrop
