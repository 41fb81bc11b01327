#include "interface_constraint.hpp"

#include <geodrop/base/error.hpp>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "anchor_rows.hpp"
#include "contact_rows.hpp"
#include "grid/momentum.hpp"
#include "interface_friction.hpp"
#include "mass_at_membranes.hpp"
#include "traction_solver.hpp"

namespace geodrop {
namespace {

/// Flow through membranes, q = permeance (p_inside - p_around), in the rows of both sides of a stretch; the pressure of
/// air is 0, and into the bed nothing flows.
template <int Dim>
SparseRows flow_through(const ContactRows<Dim>& rows, const std::vector<Contact<Dim>>& contacts, double dt,
                        Eigen::Index size) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t r = 0; r < rows.list().size(); ++r) {
    const Contact<Dim>& contact = contacts[rows.list()[r].contact];
    if (rows.list()[r].says != Says::through || contact.on_bed || contact.permeance == 0) continue;
    const int inside = static_cast<int>(r), around = inside - 1;  // its row comes first
    const double flow = contact.permeance * contact.stretch.size / dt;
    entries.emplace_back(inside, inside, flow);
    if (contact.in_air) continue;
    entries.emplace_back(around, around, flow);
    entries.emplace_back(inside, around, -flow);
    entries.emplace_back(around, inside, -flow);
  }
  SparseRows out(size, size);
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

/// What the rows of grains may close by, over the square of the step: their gaps.
template <int Dim>
Eigen::VectorXd room_to_close(const ContactRows<Dim>& rows, const std::vector<Contact<Dim>>& contacts, double dt,
                              std::size_t others) {
  Eigen::VectorXd room = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(rows.list().size() + others));
  for (std::size_t r = 0; r < rows.list().size(); ++r) {
    const Contact<Dim>& contact = contacts[rows.list()[r].contact];
    if (rows.list()[r].says == Says::grains)
      room[static_cast<Eigen::Index>(r)] = contact.gap * contact.stretch.size / (dt * dt);
  }
  return room;
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
  const auto of_contacts = std::ssize(rows.list());
  Eigen::VectorXd last(of_contacts + std::ssize(joint.held));
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t r = 0; r < of_contacts; ++r) {
    const auto& [c, says] = rows.list()[r];
    last[r] = last_traction(joint.contacts[c], grids[joint.contacts[c].membrane->field].outline, says);
  }
  std::vector<bool> only_pushes;
  for (const auto& [c, says] : rows.list())
    only_pushes.push_back(says == Says::grains || (says == Says::normal && joint.contacts[c].on_bed));
  for (const AnchorRow<Dim>& row : joint.held) {
    last[std::ssize(only_pushes)] = row.last();
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

/// Rows at the knots, of a step.
template <int Dim>
struct KnotRows {
  const Rows<Dim>& rows;
  const NodeRows<Dim>& dragged;  ///< E K, see system_of
  const ByPlace<Dim>& by_place;
  const std::vector<bool>& only_pushes;
  double dt;
};

/// The velocities that `traction` gave once more, with the consistent mass beside membranes, and the tractions of all
/// that.
template <int Dim>
Solution join_again(const State<Dim>& state, const KnotRows<Dim>& knots, System& system,
                    const Eigen::VectorXd& traction, Grids<Dim>& grids) {
  const Eigen::VectorXd lumped = knots.rows.scaled_velocities();
  correct_mass_at_membranes(state, grids);
  system.rate += times(knots.dragged, Eigen::VectorXd((knots.rows.scaled_velocities() - lumped) / knots.dt));
  Solution again = solve_tractions<Dim>(system, knots.only_pushes, traction);
  apply_pressures(knots.rows, knots.by_place, Eigen::VectorXd(again.traction - traction), knots.dt, grids);
  return again;
}

/// One normal velocity, and one velocity where the fluid sticks; anchors hold. False if they were not found.
template <int Dim>
bool join(const State<Dim>& state, double dt, Joint<Dim>& joint, Grids<Dim>& grids) {
  auto& [contacts, said, held] = joint;
  ContactRows<Dim> rows(grids);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    Contact<Dim>& contact = contacts[c];
    if (contact.stretch.wet) contact.joined = rows.add(said[c].normal, c, Says::normal);
    const bool holds = contact.joined || (!contact.stretch.wet && !contact.lets_air_in);
    const bool tight = holds && !contact.membrane->pore_pressure.empty() && rows.add(said[c].through, c, Says::through);
    contact.has_rows = contact.joined || tight;
    contact.on_grains = contact.on_grains && contact.joined && rows.add(said[c].grains, c, Says::grains);
    if (!contact.joined || !contact.sticks()) continue;
    for (const Says says : tangents<Dim>()) rows.add(along(contact, says, said[c].normal), c, says);
  }
  for (const AnchorRow<Dim>& anchor : held) rows.rows().add(anchor.row);
  const auto last = last_of(rows, joint, grids);
  for (std::size_t c = 0; c < contacts.size(); ++c)
    if (c == 0 || contacts[c].membrane != contacts[c - 1].membrane) forget_tractions(*contacts[c].membrane);
  if (last.second.empty()) return true;
  const SparseRows basis = traction_basis(contacts, grids, rows.list(), held.size()), to_knots = basis.transpose();
  const Drag drag = rows.rows().drag(dt);
  NodeRows<Dim> E = times(to_knots, rows.rows().matrix());
  const ByPlace<Dim> by_place(E);
  if (!drag.empty()) E = times(E, drag);
  System system = system_of(E, by_place, rows.rows().scaled_velocities() / dt);
  system.rate -= to_knots * room_to_close(rows, contacts, dt, held.size());
  const SparseRows flow = flow_through(rows, contacts, dt, basis.rows());
  if (flow.nonZeros() > 0) system.S += SparseRows(to_knots * flow * basis);
  add_laws(held, dt, system.S, system.rate);
  const auto [guess, only_pushes] = at_knots(to_knots, last);
  auto [traction, converged] = solve_tractions<Dim>(system, only_pushes, guess);
  apply_pressures(rows.rows(), by_place, traction, dt, grids);
  if (!grids.front().mass_correction.empty()) {
    const KnotRows<Dim> knots{rows.rows(), E, by_place, only_pushes, dt};
    const Solution again = join_again(state, knots, system, traction, grids);
    traction = again.traction;
    converged = converged && again.converged;
  }
  store(rows, Eigen::VectorXd(basis * traction), grids, contacts);
  if (!held.empty()) keep_forces(held, dt, traction, Eigen::VectorXd(system.rate - system.S * traction));
  return converged;
}

/// In the plane knots follow the outline, see traction_basis; in space they lie on the cloth, and are found once.
void find_knots(const State<2>&, const Grids<2>&, std::vector<ClothKnots>&, std::vector<Contact<2>>&) {}
void find_knots(const State<3>& state, const Grids<3>& grids, std::vector<ClothKnots>& knots,
                std::vector<Contact<3>>& contacts) {
  knots.resize(state.membranes.size());
  const GridLayout<3>& layout = grids.front().layout;
  double finest = layout.finest;  // along the axis whose cells are widest where they are finest
  for (const KnotTable& axis : layout.knots)
    if (!axis.empty()) finest = std::max(finest, axis.finest());
  for (Contact<3>& contact : contacts) {
    ClothKnots& of_cloth = knots[static_cast<std::size_t>(contact.membrane - state.membranes.data())];
    if (of_cloth.count == 0) of_cloth = cloth_knots(*contact.membrane, between_knots * finest);
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
      "the pressures on sharp membranes were not found to 1e-8 in {} steps in a row (ten sets of rows that push), t = "
      "{:g} s; {} steps so far. Membrane nodes that have run into each other, or a body thinner than a cell, are "
      "common causes",
      watch.in_a_row, t, watch.unsolved));
}

template <int Dim>
void join_interfaces(State<Dim>& state, Grids<Dim>& grids, double dt, std::vector<ClothKnots>& knots) {
  Joint<Dim> joint{find_contacts(state, grids), {}, anchor_rows(state, grids)};
  find_knots(state, grids, knots, joint.contacts);
  const auto last = tractions_along(joint.contacts, grids);
  joint.said = rows_of(grids, joint.contacts);
  count_solution(join(state, dt, joint, grids), state.t, state.constraint_watch);
  rub(dt, joint.said, joint.contacts, grids, last);
  check_tractions(state);
  for (Grid<Dim>& grid : grids) impose_wall_velocity(grid);
}

template void join_interfaces(State<2>&, Grids<2>&, double, std::vector<ClothKnots>&);
template void join_interfaces(State<3>&, Grids<3>&, double, std::vector<ClothKnots>&);

}  // namespace geodrop
