#include "slide_membranes.hpp"

#include <algorithm>
#include <numeric>

#include "outline.hpp"

namespace geodrop {
namespace {

/// Stiffness that hinders sliding besides friction, over that of the cloth: makes the sliding of slack cloth unique. At
/// 0.1 m/s it gives some Pa.
constexpr double drag_share = 1e-4;

/// Largest friction of its contacts [-]. Smooth ones load it across its line, whatever its polygon says.
double contact_friction(const State<2>& state, const Membrane<2>& membrane) {
  double friction = 0;
  for (const RigidContact<2>& contact : state.rigid_contacts)
    if (contact.touching == membrane.name) friction = std::max(friction, contact.friction);
  for (const MembraneContact<2>& contact : state.membrane_contacts)
    if (contact.between[0] == membrane.name || contact.between[1] == membrane.name)
      friction = std::max(friction, contact.friction);
  return friction;
}

double half_length(const Cloth& cloth, std::size_t k) {
  const std::size_t n = cloth.segments();
  const double ahead = k < n ? cloth.length[k] : 0, behind = k > 0 ? cloth.length[k - 1] : 0;
  return 0.5 * (ahead + (k == 0 && cloth.closed ? cloth.length[n - 1] : behind));
}

/// Momentum of the `mass` of cloth that lies next to a face on node `k`'s side, from that node on away from the face:
/// if more passes in a step than a node has, the nodes beyond give it. Velocities then stay between those before.
double momentum_beside(const Membrane<2>& membrane, const Array<double>& v, std::size_t k, bool backwards,
                       double mass) {
  double momentum = 0;
  for (std::size_t n = 0; n < membrane.nodes() && mass > membrane.mass[k]; ++n) {
    momentum += membrane.mass[k] * v[k];
    mass -= membrane.mass[k];
    k = backwards ? node_before(membrane, k) : node_after(membrane, k);
  }
  return momentum + mass * v[k];
}

}  // namespace

/// Lengths, rest lengths and loads along the line.
void MembraneSlide::gather(const State<2>& state, const Membrane<2>& membrane) {
  constexpr double least_length = 1e-12;  // of the rest length: two nodes in one place
  cloth_.resize(membrane.segments(), membrane.closed);
  cloth_.stiffness = membrane.axial_stiffness;
  const Array<double>& shear = shear_on_cloth(membrane);
  for (std::size_t s = 0; s < membrane.segments(); ++s) {
    cloth_.length[s] = std::max(least_length * membrane.rest_length[s], segment_length(membrane, s));
    cloth_.rest[s] = membrane.rest_length[s];
    cloth_.tension[s] = membrane.tension[s];
    if (shear.empty()) continue;
    const double half = 0.5 * shear[s] * cloth_.length[s];
    cloth_.load[s] += half;
    cloth_.load[end_of_edge(s, membrane.nodes())] += half;
  }
  const double rough = contact_friction(state, membrane);
  for (std::size_t k = 0; k < membrane.nodes(); ++k) {
    const auto [tx, ty] = tangent_at(membrane, k);
    cloth_.load[k] += membrane.mass[k] * (gravity_[0] * tx + gravity_[1] * ty);
    if (!(rough > 0)) continue;
    cloth_.load[k] += membrane.load[0][k] * tx + membrane.load[1][k] * ty;
    // What touches soil in cloth holds the cloth, too. Over a fluid that would leave slack stretches undetermined.
    if (membrane.contents_friction > 0)
      cloth_.friction[k] = rough * std::min(std::abs(membrane.load[1][k] * tx - membrane.load[0][k] * ty),
                                            rubbing_pressure(membrane, k) * half_length(cloth_, k));
  }
}

void MembraneSlide::slide(Cloth& cloth, double contents_friction) {
  if (contents_friction > 0)
    solver_.solve(cloth);
  else
    slide_freely(cloth);
}

/// Each part of the line is an open line of its own.
void MembraneSlide::slide_between(const std::vector<LinePart>& parts, double contents_friction) {
  using Values = std::vector<double> Cloth::*;
  constexpr std::array<Values, 3> of_segments{&Cloth::length, &Cloth::rest, &Cloth::tension};
  constexpr std::array<Values, 3> of_nodes{&Cloth::friction, &Cloth::drag, &Cloth::load};
  part_.stiffness = cloth_.stiffness;
  for (const auto& [first, count] : parts) {
    if (count == 1) continue;
    const auto segment = [&, first = first](std::size_t s) { return (first + s) % cloth_.segments(); };
    const auto node = [&, first = first](std::size_t k) { return (first + k) % cloth_.nodes(); };
    part_.resize(count, false);
    for (const Values values : of_segments)
      for (std::size_t s = 0; s < count; ++s) (part_.*values)[s] = (cloth_.*values)[segment(s)];
    for (const Values values : of_nodes)
      for (std::size_t k = 0; k <= count; ++k) (part_.*values)[k] = (cloth_.*values)[node(k)];
    slide(part_, contents_friction);
    for (std::size_t s = 0; s < count; ++s) cloth_.rest[segment(s)] = part_.rest[s];
    for (std::size_t k = 0; k <= count; ++k) cloth_.passed[node(k)] = part_.passed[k];
  }
}

/// Mass follows the rest length that passes; momentum goes with it, from the nodes that it leaves: the exact mean of
/// the cloth that lies at a node then, each node's with its velocity.
void MembraneSlide::move_mass(Membrane<2>& membrane) {
  const double density = std::accumulate(membrane.mass.begin(), membrane.mass.end(), 0.0) /
                         std::accumulate(membrane.rest_length.begin(), membrane.rest_length.end(), 0.0);
  for (int a = 0; a < 2; ++a) {
    momentum_[a].resize(membrane.nodes());
    for (std::size_t k = 0; k < membrane.nodes(); ++k) momentum_[a][k] = membrane.mass[k] * membrane.v[a][k];
    for (std::size_t s = 0; s < membrane.segments(); ++s) {
      const std::size_t end = end_of_edge(s, membrane.nodes());
      const double mass = 0.5 * density * (cloth_.passed[s] + cloth_.passed[end]);
      const double carried = mass > 0 ? momentum_beside(membrane, membrane.v[a], s, true, mass)
                                      : -momentum_beside(membrane, membrane.v[a], end, false, -mass);
      momentum_[a][s] -= carried;
      momentum_[a][end] += carried;
    }
  }
  std::copy(cloth_.rest.begin(), cloth_.rest.end(), membrane.rest_length.begin());
  share_mass(membrane);
  if (!(density > 0)) return;
  for (int a = 0; a < 2; ++a)
    for (std::size_t k = 0; k < membrane.nodes(); ++k) membrane.v[a][k] = momentum_[a][k] / membrane.mass[k];
}

void MembraneSlide::slide(const State<2>& state, const Grid<2>& grid, Membrane<2>& membrane) {
  if (membrane.contents_friction > 0) pressure_.update(state, grid, membrane);
  gather(state, membrane);
  if (membrane.contents_friction > 0) {
    for (std::size_t k = 0; k < membrane.nodes(); ++k) {
      const double length = half_length(cloth_, k);
      cloth_.friction[k] += membrane.contents_friction * membrane.contents_pressure[k] * length;
      cloth_.drag[k] = drag_share * membrane.axial_stiffness / length;
    }
  }
  const std::vector<std::size_t> held = held_nodes(state, membrane);
  if (held.empty())
    slide(cloth_, membrane.contents_friction);
  else
    slide_between(parts_between(held, membrane), membrane.contents_friction);
  move_mass(membrane);
}

void MembraneSlide::slide(State<2>& state, const Grids<2>& grids) {
  for (Membrane<2>& membrane : state.membranes)
    if (membrane.slides() && membrane.field != waiting) slide(state, grids[membrane.field], membrane);
}

}  // namespace geodrop
