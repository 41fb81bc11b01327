#include "interface_constraint.hpp"

#include <geodrop/base/error.hpp>

#include <Eigen/Dense>
#include <Eigen/IterativeLinearSolvers>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "anchor_rows.hpp"
#include "grid/momentum.hpp"
#include "interface_contacts.hpp"
#include "interface_rows.hpp"
#include "traction_basis.hpp"

namespace geodrop {
namespace {

std::vector<NodeVector<2>> normals_of(const Grid<2>& grid, const Contact<2>& contact) {
  return normals_over(grid.layout, *contact.membrane, grid.outline, contact.stretch);
}
std::vector<NodeVector<3>> normals_of(const Grid<3>& grid, const Contact<3>& contact) {
  return normals_over(grid.layout, grid.outline, contact.stretch);
}

/// What a contact says, as rows can take it. That along the membrane is the normal one, turned.
template <int Dim>
struct RowsOfContact {
  RawRow<Dim> normal, through;
};

template <int Dim>
RowsOfContact<Dim> rows_of(const Grids<Dim>& grids, const Contact<Dim>& contact) {
  const int field = contact.membrane->field;
  const Grid<Dim>& grid = grids[field];
  std::vector<NodeVector<Dim>> vectors = normals_of(grid, contact);
  RowsOfContact<Dim> rows{make_row(grids, field, 0, vectors), {}};
  if (contact.membrane->pore_pressure.empty()) return rows;
  for (NodeVector<Dim>& vector : vectors)
    for (double& value : vector.value) value *= grids[grid.pore_water].pore_share[vector.node];
  rows.through = make_row(grids, grid.pore_water, field, vectors);
  return rows;
}

template <int Dim>
std::vector<RowsOfContact<Dim>> rows_of(const Grids<Dim>& grids, const std::vector<Contact<Dim>>& contacts) {
  std::vector<RowsOfContact<Dim>> rows(contacts.size());
  const auto count = static_cast<std::ptrdiff_t>(contacts.size());
#pragma omp parallel for schedule(dynamic, 16)
  for (std::ptrdiff_t c = 0; c < count; ++c) rows[c] = rows_of(grids, contacts[c]);
  return rows;
}

/// Rows for some of the contacts.
template <int Dim>
class ContactRows {
 public:
  explicit ContactRows(const Grids<Dim>& grids) : rows_(grids) {}

  /// False if one of the sides has no mass there.
  bool add(const RawRow<Dim>& row, std::size_t c, Says says) {
    const bool complete = rows_.add(row);
    if (complete) list_.push_back({c, says});
    return complete;
  }

  Rows<Dim>& rows() { return rows_; }
  const std::vector<RowOfContact>& list() const { return list_; }

 private:
  Rows<Dim> rows_;
  std::vector<RowOfContact> list_;
};

/// What the rows along a membrane say.
template <int Dim>
constexpr auto tangents() {
  if constexpr (Dim == 2)
    return std::array{Says::tangent};
  else
    return std::array{Says::tangent, Says::second_tangent};
}

/// The row along an outline, from the one normal to it. In space what of it faces the mean normal of the stretch, made
/// as large as the area.
RawRow<2> along(const Contact<2>&, Says, const RawRow<2>& normal) { return along(normal); }
RawRow<3> along(const Contact<3>& contact, Says says, RawRow<3> normal) {
  const std::array<double, 3>&axis = contact.axes[0], &way = contact.axes[says == Says::tangent ? 1 : 2];
  for (auto& entry : normal.entries) {
    const double part = axis[0] * entry.value[0] + axis[1] * entry.value[1] + axis[2] * entry.value[2];
    for (std::size_t a = 0; a < 3; ++a) entry.value[a] = part * way[a];
  }
  return normal;
}

/// Adds up the tractions of rows on the segments or triangles of membranes.
template <int Dim>
void store(ContactRows<Dim>& rows, const Eigen::VectorXd& traction, const Grids<Dim>& grids,
           std::vector<Contact<Dim>>& contacts) {
  for (std::size_t r = 0; r < rows.list().size(); ++r) {
    const std::size_t c = rows.list()[r].contact;
    const Says says = rows.list()[r].says;
    Membrane<Dim>& membrane = *contacts[c].membrane;
    const Outline<Dim>& cells = grids[membrane.field].outline;
    const double of_row = traction[static_cast<Eigen::Index>(r)];
    if (says == Says::normal) contacts[c].pressure = of_row;
    for_each_share(cells, contacts[c].stretch, [&](std::size_t at, double share) {
      add_traction(contacts[c], cells, says, at, share * of_row);
      if (says == Says::through && !contacts[c].on_bed)
        membrane.seepage[at] += share * membrane.permeance * (of_row - contacts[c].pressure);
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
  // Rows stand in the order of the outline. With the diagonal alone 98 iterations in the place of 3
  // (main case, 116 rows, a pressure for each stretch).
  using Preconditioner = Eigen::IncompleteCholesky<double, Eigen::Lower, Eigen::NaturalOrdering<int>>;
  Eigen::ConjugateGradient<SparseRows, Eigen::Lower | Eigen::Upper, Preconditioner> solver(S);
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

/// The system of rows E, without the flow through the membrane. Drag is that of pores/pores, which follows: the rows
/// ask for velocities after it. velocity_rate: M^1/2 v / dt.
System system_of(const SparseRows& E, const Drag& drag, const Eigen::VectorXd& velocity_rate) {
  if (drag.empty()) return {times_transpose(E, E), E * velocity_rate};
  const SparseRows dragged = times(E, drag);
  return {times_transpose(dragged, E), dragged * velocity_rate};
}

/// Flow through membranes, q = permeance (p_inside - p_around), in the rows of both sides of a stretch; into the bed
/// there is none.
template <int Dim>
SparseRows flow_through(const ContactRows<Dim>& rows, const std::vector<Contact<Dim>>& contacts, double dt,
                        Eigen::Index size) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t r = 0; r < rows.list().size(); ++r) {
    const Contact<Dim>& contact = contacts[rows.list()[r].contact];
    if (rows.list()[r].says != Says::through || contact.on_bed || contact.membrane->permeance == 0) continue;
    const int inside = static_cast<int>(r), around = inside - 1;  // its row comes first
    const double flow = contact.membrane->permeance * contact.stretch.size / dt;
    entries.emplace_back(inside, inside, flow);
    entries.emplace_back(around, around, flow);
    entries.emplace_back(inside, around, -flow);
    entries.emplace_back(around, inside, -flow);
  }
  SparseRows out(size, size);
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

template <int Dim>
std::vector<const Array<double>*> tractions_of(const Membrane<Dim>& membrane) {
  std::vector<const Array<double>*> out{&membrane.water_pressure, &membrane.water_shear, &membrane.pore_pressure};
  if constexpr (Dim == 3)
    for (const Array<double>& component : membrane.triangles.water_shear) out.push_back(&component);
  return out;
}

/// Throws where a traction on a sharp membrane is not finite: what is broken moves all that touches it at the next
/// step.
template <int Dim>
void check_tractions(const State<Dim>& state) {
  for (const Membrane<Dim>& membrane : state.membranes)
    for (const Array<double>* traction : tractions_of(membrane)) {
      const auto broken = std::find_if(traction->begin(), traction->end(), [](double t) { return !std::isfinite(t); });
      if (!membrane.sharp || broken == traction->end()) continue;
      auto at = static_cast<std::size_t>(broken - traction->begin());
      if constexpr (Dim == 3) at = membrane.triangles.corner[0][at];
      std::string place;
      for (const Array<double>& x : membrane.x) place += fmt::format(" {:g}", x[at]);
      throw RunError(fmt::format(
          "a traction on the sharp membrane '{}' is not finite at x ={} m, t = {:g} s; a velocity or a mass at the "
          "nodes of the grid there is not",
          membrane.name, place, state.t));
    }
}

/// What meets at sharp membranes, and what holds them.
template <int Dim>
struct Joint {
  std::vector<Contact<Dim>> contacts;
  std::vector<RowsOfContact<Dim>> said;  ///< of each contact
  AnchorRows<Dim> held;
};

/// Multipliers of the last step of all rows, and which may only push (lines: pull).
template <int Dim>
std::pair<Eigen::VectorXd, std::vector<bool>> last_of(const ContactRows<Dim>& rows, const Joint<Dim>& joint,
                                                      const Grids<Dim>& grids) {
  Eigen::VectorXd last(rows.list().size() + joint.held.size());
  std::vector<bool> only_pushes;
  Eigen::Index r = 0;
  for (const auto& [c, says] : rows.list()) {
    const Contact<Dim>& contact = joint.contacts[c];
    last[r++] = last_traction(contact, grids[contact.membrane->field].outline, says);
    only_pushes.push_back(says == Says::normal && contact.on_bed);
  }
  for (const AnchorRow<Dim>& row : joint.held) {
    last[r++] = row.last();
    only_pushes.push_back(row.anchor->line);
  }
  return {last, only_pushes};
}

/// At the knots: means of the rows around, and what may only push for one of them.
std::pair<Eigen::VectorXd, std::vector<bool>> at_knots(const SparseRows& transposed_basis,
                                                       const std::pair<Eigen::VectorXd, std::vector<bool>>& of_rows) {
  const auto& [last, pushes] = of_rows;
  Eigen::VectorXd guess = transposed_basis * last;
  std::vector<bool> only_pushes(transposed_basis.rows(), false);
  for (int k = 0; k < transposed_basis.rows(); ++k) {
    double weight = 0;
    for (SparseRows::InnerIterator entry(transposed_basis, k); entry; ++entry) {
      weight += entry.value();
      if (pushes[entry.col()]) only_pushes[k] = true;
    }
    guess[k] /= weight;
  }
  return {guess, only_pushes};
}

/// One normal velocity, and one velocity where the fluid sticks; anchors hold. False if they were not found.
template <int Dim>
bool join(double dt, Joint<Dim>& joint, Grids<Dim>& grids) {
  auto& [contacts, said, held] = joint;
  ContactRows<Dim> rows(grids);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    contacts[c].joined = rows.add(said[c].normal, c, Says::normal);
    if (!contacts[c].joined) continue;
    if (!contacts[c].membrane->pore_pressure.empty()) rows.add(said[c].through, c, Says::through);
    if (contacts[c].sticks())
      for (const Says says : tangents<Dim>()) rows.add(along(contacts[c], says, said[c].normal), c, says);
  }
  for (const AnchorRow<Dim>& anchor : held) rows.rows().add(anchor.row);
  const auto last = last_of(rows, joint, grids);
  for (const Contact<Dim>& contact : contacts) forget_tractions(*contact.membrane);
  if (last.second.empty()) return true;
  const SparseRows basis = traction_basis(contacts, grids, rows.list(), held.size()), to_knots = basis.transpose();
  const Drag drag = rows.rows().drag(dt);
  const SparseRows E = to_knots * rows.rows().matrix();
  System system = system_of(E, drag, rows.rows().scaled_velocities() / dt);
  const SparseRows flow = flow_through(rows, contacts, dt, basis.rows());
  if (flow.nonZeros() > 0) system.S += SparseRows(to_knots * flow * basis);
  add_laws(held, dt, system.S, system.rate);
  const auto [guess, only_pushes] = at_knots(to_knots, last);
  const auto [traction, converged] = solve(system, only_pushes, guess);
  apply_pressures(rows.rows(), E, traction, dt, grids);
  store(rows, Eigen::VectorXd(basis * traction), grids, contacts);
  if (!held.empty()) keep_forces(held, dt, traction, Eigen::VectorXd(system.rate - system.S * traction));
  return converged;
}

/// Tractions along a membrane at one stretch, no larger together than `most`.
void limit(double most, Eigen::Ref<Eigen::VectorXd> traction) {
  if (traction.size() == 1)
    traction[0] = std::clamp(traction[0], -most, most);
  else if (const double size = traction.norm(); size > most)
    traction *= most / size;
}

/// Tractions that stop the slip of rows, those of each stretch (Dim - 1 rows) together at most `most`: projected
/// Gauss-Seidel from a guess.
template <int Dim>
Eigen::VectorXd solve_limited(const SparseRows& S, const Eigen::VectorXd& slip_rate, const std::vector<double>& most,
                              Eigen::VectorXd traction) {
  constexpr int most_sweeps = 200;
  constexpr double tolerance = 1e-6;  // of the largest traction
  constexpr Eigen::Index ways = Dim - 1;
  Eigen::Matrix<double, ways, 1> before;
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    double change = 0;
    for (Eigen::Index first = 0; first < S.rows(); first += ways) {
      before = traction.template segment<ways>(first);
      for (Eigen::Index r = first; r < first + ways; ++r) {
        double held = 0, diagonal = 1;
        for (SparseRows::InnerIterator entry(S, r); entry; ++entry) {
          held += entry.value() * traction[entry.col()];
          if (entry.col() == r) diagonal = entry.value();
        }
        traction[r] += (slip_rate[r] - held) / diagonal;
      }
      limit(most[static_cast<std::size_t>(first / ways)], traction.segment(first, ways));
      change = std::max(change, (traction.template segment<ways>(first) - before).cwiseAbs().maxCoeff());
    }
    if (change <= tolerance * traction.cwiseAbs().maxCoeff()) break;
  }
  return traction;
}

/// Tractions along the membrane at each contact, before they are forgotten.
template <int Dim>
std::vector<std::array<double, Dim - 1>> tractions_along(const std::vector<Contact<Dim>>& contacts,
                                                         const Grids<Dim>& grids) {
  std::vector<std::array<double, Dim - 1>> out(contacts.size());
  for (std::size_t c = 0; c < contacts.size(); ++c)
    if (contacts[c].rubs())
      for (std::size_t k = 0; k < Dim - 1; ++k)
        out[c][k] = last_traction(contacts[c], grids[contacts[c].membrane->field].outline, tangents<Dim>()[k]);
  return out;
}

/// Friction: tractions along the membrane that stop it from slipping, at most mu times the effective pressure on the
/// bed, what the soil inside takes where water would stick, or what the wall law says in fluid.
template <int Dim>
void rub(double dt, const std::vector<RowsOfContact<Dim>>& said, std::vector<Contact<Dim>>& contacts, Grids<Dim>& grids,
         const std::vector<std::array<double, Dim - 1>>& last) {
  constexpr std::size_t ways = Dim - 1;
  ContactRows<Dim> rows(grids);
  for (std::size_t c = 0; c < contacts.size(); ++c)
    if (contacts[c].joined && contacts[c].rubs())
      for (const Says says : tangents<Dim>()) rows.add(along(contacts[c], says, said[c].normal), c, says);
  if (rows.list().empty()) return;
  const Drag drag = rows.rows().drag(dt);
  const SparseRows T = rows.rows().matrix();
  const auto [S, slip_rate] = system_of(T, drag, rows.rows().scaled_velocities() / dt);
  const Eigen::VectorXd slip = dt * slip_rate;
  Eigen::VectorXd guess(S.rows());
  std::vector<double> most(rows.list().size() / ways);
  for (std::size_t k = 0; k < most.size(); ++k) {
    const auto first = static_cast<Eigen::Index>(ways * k);
    const std::size_t c = rows.list()[ways * k].contact;
    most[k] = contacts[c].most_friction(slip.segment(first, ways).norm());
    for (std::size_t way = 0; way < ways; ++way) guess[first + static_cast<Eigen::Index>(way)] = last[c][way];
    limit(most[k], guess.segment(first, ways));
  }
  const Eigen::VectorXd traction = solve_limited<Dim>(S, slip_rate, most, guess);
  apply_pressures(rows.rows(), T, traction, dt, grids);
  store(rows, traction, grids, contacts);
}

/// In the plane knots follow the outline, see traction_basis; in space they lie on the cloth, and are found once.
void find_knots(const State<2>&, const Grids<2>&, std::vector<ClothKnots>&, std::vector<Contact<2>>&) {}
void find_knots(const State<3>& state, const Grids<3>& grids, std::vector<ClothKnots>& knots,
                std::vector<Contact<3>>& contacts) {
  knots.resize(state.membranes.size());
  for (Contact<3>& contact : contacts) {
    ClothKnots& of_cloth = knots[static_cast<std::size_t>(contact.membrane - state.membranes.data())];
    if (of_cloth.count == 0) of_cloth = cloth_knots(*contact.membrane, between_knots * grids.front().layout.finest);
    contact.knots = &of_cloth;
  }
}

}  // namespace

void count_solution(bool converged, double t, ConstraintWatch& watch) {
  constexpr std::uint64_t most_in_a_row = 100;
  watch.in_a_row = converged ? 0 : watch.in_a_row + 1;
  watch.unsolved += converged ? 0 : 1;
  if (watch.in_a_row < most_in_a_row) return;
  throw RunError(fmt::format(
      "the pressures on sharp membranes were not found in {} steps in a row (conjugate gradients to 1e-8, ten active "
      "sets), t = {:g} s; {} steps so far. Membrane nodes that have run into each other, or a body thinner than a "
      "cell, are common causes",
      watch.in_a_row, t, watch.unsolved));
}

template <int Dim>
void join_interfaces(State<Dim>& state, Grids<Dim>& grids, double dt, std::vector<ClothKnots>& knots) {
  Joint<Dim> joint{find_contacts(state, grids), {}, anchor_rows(state, grids)};
  find_knots(state, grids, knots, joint.contacts);
  const auto last = tractions_along(joint.contacts, grids);
  joint.said = rows_of(grids, joint.contacts);
  count_solution(join(dt, joint, grids), state.t, state.constraint_watch);
  rub(dt, joint.said, joint.contacts, grids, last);
  check_tractions(state);
  for (Grid<Dim>& grid : grids) impose_wall_velocity(grid);
}

template void join_interfaces(State<2>&, Grids<2>&, double, std::vector<ClothKnots>&);
template void join_interfaces(State<3>&, Grids<3>&, double, std::vector<ClothKnots>&);

}  // namespace geodrop
