#include "interface_constraint.hpp"

#include <geodrop/base/error.hpp>
#include <geodrop/base/find_named.hpp>

#include <Eigen/Dense>
#include <Eigen/IterativeLinearSolvers>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <utility>

#include "grid/momentum.hpp"
#include "grid/point_support.hpp"
#include "interface_rows.hpp"
#include "outline_pieces.hpp"
#include "rough_wall.hpp"

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
  double velocity = -1;      ///< of slipping, at a distance from the membrane [m/s]; < 0: not known there
  double distance = 0;       ///< that one [m]

  bool over_soil() const { return !membrane->contents_pressure.empty(); }
  bool sticks() const { return !on_bed && membrane->shear == Shear::no_slip && !over_soil(); }
  bool rubs() const { return on_bed || (membrane->shear != Shear::none && !sticks()); }

  /// Largest traction along it [Pa]: what is around can give, and the soil inside can take. slip [m2/s]: the velocity
  /// of slipping times the length.
  double most_friction(double slip) const {
    const double taken = over_soil() ? membrane->contents_friction * inside : std::numeric_limits<double>::infinity();
    if (on_bed) return std::min(taken, std::max(0.0, membrane->bed_friction * (pressure - pore_pressure)));
    if (membrane->shear == Shear::no_slip) return taken;
    const bool far = membrane->shear == Shear::rough_wall && velocity >= 0;
    const double u = far ? velocity : slip / stretch.length;
    const double friction = membrane->shear == Shear::rough_wall ? rough_wall_friction(distance, membrane->roughness)
                                                                 : membrane->wall_friction;
    return std::min(taken, 0.5 * membrane->fluid_density * friction * u * u);
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

/// What a row says: the normal velocities inside and around are one, or those along the membrane; or, of the water in
/// pores, what flows through the membrane relative to the grains.
enum class Says { normal, tangent, through };

Array<double>& traction_of(Membrane<2>& membrane, Says says) {
  if (says == Says::through) return membrane.pore_pressure;
  return says == Says::normal ? membrane.water_pressure : membrane.water_shear;
}

/// Mean over a stretch of the traction that its segments had.
double last_traction(const Contact& contact, const CutCells& cells, Says says) {
  const Array<double>& traction = traction_of(*contact.membrane, says);
  double sum = 0;
  for_each_piece(cells, contact.stretch, [&](const CutCells::Piece& piece) {
    sum += traction[piece.edge] * length_of(*contact.membrane, piece);
  });
  return contact.stretch.length > 0 ? (says == Says::tangent ? -cells.sense * sum : sum) / contact.stretch.length : 0;
}

void forget_tractions(Membrane<2>& membrane) {
  std::fill(membrane.water_pressure.begin(), membrane.water_pressure.end(), 0.0);
  std::fill(membrane.water_shear.begin(), membrane.water_shear.end(), 0.0);
  std::fill(membrane.bed_shear.begin(), membrane.bed_shear.end(), 0.0);
  std::fill(membrane.pore_pressure.begin(), membrane.pore_pressure.end(), 0.0);
  std::fill(membrane.seepage.begin(), membrane.seepage.end(), 0.0);
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

/// Velocity of a field at a place by its nodes that have mass; empty where most of the splines are of others.
std::optional<Vec4> velocity_at(const Grid<2>& grid, double x, double y) {
  const GridLayout<2>& layout = grid.layout;
  const std::array<double, 2> place{x, y};
  for (int a = 0; a < 2; ++a)
    if (!layout.periodic(a) && !(place[a] >= layout.lower[a] && place[a] <= layout.upper[a])) return {};
  Vec4 sum{};
  double weights = 0;
  PointSupport<2>(layout, place, 0).for_each_node(layout, [&](int node, double weight) {
    if (!(grid.sum[node][3] > 0)) return;
    sum += weight * grid.velocity[node];
    weights += weight;
  });
  if (weights < 0.5) return {};
  return sum / weights;
}

/// The velocity of slipping beyond the layer of 1.5 to 2 cells beside the membrane, which the grid slows down: with
/// that at the membrane the friction of a flat plate came out as half of what it is.
void look_outside(const Grids<2>& grids, const CutCells& cells, Contact& contact) {
  constexpr double cells_away = 1.75;
  const Membrane<2>& membrane = *contact.membrane;
  const GridLayout<2>& layout = grids.front().layout;
  std::array<double, 2> middle{}, normal{};
  double width = std::numeric_limits<double>::infinity();
  for_each_piece(cells, contact.stretch, [&](const CutCells::Piece& piece) {
    const std::size_t from = piece.edge, to = end_of_edge(from, membrane.nodes());
    const double share = 0.5 * (piece.from + piece.to), length = length_of(membrane, piece);
    std::array<double, 2> way;
    for (int a = 0; a < 2; ++a) {
      way[a] = (piece.to - piece.from) * (membrane.x[a][to] - membrane.x[a][from]);
      middle[a] += length * (membrane.x[a][from] + share * (membrane.x[a][to] - membrane.x[a][from]));
    }
    normal[0] += cells.sense * way[1];
    normal[1] -= cells.sense * way[0];
    width = std::min(width, least_width(layout, flat_of(layout, cells, piece.cell)));
  });
  contact.distance = 0.5 * width;
  const double size = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1]);
  if (!(size > 0 && contact.stretch.length > 0)) return;
  for (int a = 0; a < 2; ++a) middle[a] /= contact.stretch.length, normal[a] /= size;
  const double away = cells_away * width;
  const auto water = velocity_at(grids.front(), middle[0] + away * normal[0], middle[1] + away * normal[1]);
  const auto own = velocity_at(grids[membrane.field], middle[0], middle[1]);
  if (!water || !own) return;
  const Vec4 slip = *water - *own;
  contact.velocity = std::abs(slip[1] * normal[0] - slip[0] * normal[1]);
  contact.distance = away;
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
      if (membrane.shear == Shear::rough_wall) look_outside(grids, cells, contacts.back());
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
    Says says;
  };

  explicit ContactRows(const Grids<2>& grids) : grids_(grids), rows_(grids) {}

  /// False if one of the sides has no mass there.
  bool add(const std::vector<Contact>& contacts, std::size_t c, Says says) {
    const Membrane<2>& membrane = *contacts[c].membrane;
    const Grid<2>& grid = grids_[membrane.field];
    const Direction direction = says == Says::tangent ? Direction::tangent : Direction::normal;
    std::vector<NodeVector> vectors =
        line_integrals(grid.layout, membrane, grid.outline, contacts[c].stretch, direction);
    bool complete = false;
    if (says == Says::through) {
      for (NodeVector& vector : vectors)
        for (double& value : vector.value) value *= grids_[grid.pore_water].pore_share[vector.node];
      complete = rows_.add(grid.pore_water, membrane.field, vectors);
    } else {
      complete = rows_.add(membrane.field, 0, vectors);
    }
    if (complete) list_.push_back({c, says});
    return complete;
  }

  Rows& rows() { return rows_; }
  const std::vector<Row>& list() const { return list_; }

 private:
  const Grids<2>& grids_;
  Rows rows_;
  std::vector<Row> list_;
};

/// Adds up the tractions of rows on the segments of membranes.
void store(ContactRows& rows, const Eigen::VectorXd& traction, const Grids<2>& grids, std::vector<Contact>& contacts) {
  for (std::size_t r = 0; r < rows.list().size(); ++r) {
    const std::size_t c = rows.list()[r].contact;
    const Says says = rows.list()[r].says;
    Membrane<2>& membrane = *contacts[c].membrane;
    const CutCells& cells = grids[membrane.field].outline;
    const bool along = says == Says::tangent;
    if (says == Says::normal) contacts[c].pressure = traction[static_cast<Eigen::Index>(r)];
    Array<double>& target = traction_of(membrane, says);
    const double sign =
        along ? -cells.sense : 1;  // -p t acts on the membrane, t with the nodes if they run anticlockwise
    for_each_piece(cells, contacts[c].stretch, [&](const CutCells::Piece& piece) {
      const double part = sign * (piece.to - piece.from) * traction[static_cast<Eigen::Index>(r)];
      target[piece.edge] += part;
      if (along && contacts[c].on_bed) membrane.bed_shear[piece.edge] += part;
      if (says == Says::through && !contacts[c].on_bed)
        membrane.seepage[piece.edge] += (piece.to - piece.from) * membrane.permeance *
                                        (traction[static_cast<Eigen::Index>(r)] - contacts[c].pressure);
    });
  }
}

/// Tractions of rows, and whether they are as exact as asked.
struct Solution {
  Eigen::VectorXd traction;
  bool converged;
};

/// What the tractions of rows do to the velocities of the rows: S = E K E^T + D, of the nodes' masses within E, the
/// drag K of pore water (empty: none) and the flow D through the membrane.
struct System {
  SparseRows S;
  Eigen::VectorXd rate;  ///< of the rows without tractions: E K v / dt
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
Solution solve(const System& system, const std::vector<bool>& only_pushes, const Eigen::VectorXd& guess) {
  constexpr int most_rounds = 10;
  const auto& [S, gap_rate] = system;
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
    SparseRows of_joined = joined.asDiagonal() * S * joined.asDiagonal();
    of_joined.diagonal().array() += 1 - joined.array();
    found = solve(of_joined, joined.cwiseProduct(gap_rate), joined.cwiseProduct(guess));
  }
  found.converged = false;  // the last sets are not those of their solution
  return found;
}

/// The system of rows, without the flow through the membrane. Drag is that of pores/pores, which follows: the rows ask
/// for velocities after it.
System system_of(ContactRows& rows, SparseRows& E, double dt) {
  const SparseRows drag = rows.rows().drag(dt);
  E = rows.rows().matrix();
  const Eigen::VectorXd velocity_rate = rows.rows().scaled_velocities() / dt;
  if (drag.size() == 0) return {E * E.transpose(), E * velocity_rate};
  const SparseRows dragged = E * drag;
  return {dragged * E.transpose(), dragged * velocity_rate};
}

/// Flow through membranes, q = permeance (p_inside - p_around), in the rows of both sides of a stretch; into the bed
/// there is none.
void let_through(const ContactRows& rows, const std::vector<Contact>& contacts, double dt, SparseRows& S) {
  for (std::size_t r = 0; r < rows.list().size(); ++r) {
    const Contact& contact = contacts[rows.list()[r].contact];
    if (rows.list()[r].says != Says::through || contact.on_bed || contact.membrane->permeance == 0) continue;
    const auto inside = static_cast<Eigen::Index>(r), around = inside - 1;  // its row comes first
    const double flow = contact.membrane->permeance * contact.stretch.length / dt;
    S.coeffRef(inside, inside) += flow;
    S.coeffRef(around, around) += flow;
    S.coeffRef(inside, around) -= flow;
    S.coeffRef(around, inside) -= flow;
  }
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
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    contacts[c].joined = rows.add(contacts, c, Says::normal);
    if (!contacts[c].joined) continue;
    if (!contacts[c].membrane->pore_pressure.empty()) rows.add(contacts, c, Says::through);
    if (contacts[c].sticks()) rows.add(contacts, c, Says::tangent);
  }
  Eigen::VectorXd guess(rows.list().size());
  for (std::size_t r = 0; r < rows.list().size(); ++r) {
    const auto [c, says] = rows.list()[r];
    guess[r] = last_traction(contacts[c], grids[contacts[c].membrane->field].outline, says);
  }
  for (const Contact& contact : contacts) forget_tractions(*contact.membrane);
  if (rows.list().empty()) return true;
  std::vector<bool> only_pushes;
  for (const ContactRows::Row& row : rows.list())
    only_pushes.push_back(row.says == Says::normal && contacts[row.contact].on_bed);
  SparseRows E;
  System system = system_of(rows, E, dt);
  let_through(rows, contacts, dt, system.S);
  const auto [traction, converged] = solve(system, only_pushes, guess);
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
    if (contacts[c].joined && contacts[c].rubs()) rows.add(contacts, c, Says::tangent);
  if (rows.list().empty()) return;
  SparseRows T;
  const auto [S, slip_rate] = system_of(rows, T, dt);
  const Eigen::VectorXd slip = dt * slip_rate;
  Eigen::VectorXd guess(S.rows()), most(S.rows());
  for (Eigen::Index r = 0; r < S.rows(); ++r) {
    const std::size_t c = rows.list()[static_cast<std::size_t>(r)].contact;
    most[r] = contacts[c].most_friction(slip[r]);
    guess[r] = std::clamp(last[c], -most[r], most[r]);
  }
  const Eigen::VectorXd traction = solve_limited(S, slip_rate, most, guess);
  apply_pressures(rows.rows(), T, traction, dt, grids);
  store(rows, traction, grids, contacts);
}

}  // namespace

void join_interfaces(State<2>& state, Grids<2>& grids, double dt) {
  std::vector<Contact> contacts = find_contacts(state, grids);
  std::vector<double> last;  // tractions along the membrane, before they are forgotten
  for (const Contact& contact : contacts)
    last.push_back(last_traction(contact, grids[contact.membrane->field].outline, Says::tangent));
  note(join(dt, contacts, grids), state.t, state.constraint_watch);
  rub(dt, contacts, grids, last);
  for (Grid<2>& grid : grids) impose_wall_velocity(grid);
}

}  // namespace geodrop
