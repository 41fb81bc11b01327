// What contacts and rigid bodies give to the limit of the time step.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "membrane/membrane_limits.hpp"
#include "space_surface.hpp"
#include "surface_contact.hpp"

namespace geodrop {

/// Mass per area that a penalty moves [kg/m2].
template <int Dim>
double mass_on(const State<Dim>& state, const RigidContact<Dim>& contact, double h) {
  if constexpr (Dim == 2) {
    return reference_density(touching_body(state, contact).material) * h;
  } else {
    const Membrane<3>& membrane = find_named(state.membranes, contact.touching);
    return std::max(density_beside(state, membrane) * h, membrane.triangles.mass_per_area);
  }
}

/// Largest step that penalties allow: k dt^2 / (rho h) = stiffness (c dt / h)^2 <= 1/2, and of their damping
/// z dt / (rho h) = damping c dt / h <= 1/2.
template <int Dim>
double contact_dt(const State<Dim>& state, double h) {
  constexpr double most = 0.5;  // of springs on mass that moves with its cell; beyond it contact gains energy
  double dt = std::numeric_limits<double>::infinity();
  const auto limit = [&](const auto& contact, double mass) {
    dt = std::min({dt, std::sqrt(most * mass / contact.stiffness), most * mass / contact.damping});
  };
  for (const RigidContact<Dim>& contact : state.rigid_contacts) limit(contact, mass_on(state, contact, h));
  for (const MembraneContact<Dim>& contact : state.membrane_contacts) {
    double of_both = 0;  // 1 / m + 1 / m, as two bodies on one spring have it
    for (const std::string& name : contact.between)
      of_both += 1 / (density_beside(state, find_named(state.membranes, name)) * h);
    limit(contact, 1 / of_both);
  }
  return dt;
}

/// Largest speed of rigid bodies that something may touch [m/s]; a half-plane that turns has no largest one.
template <int Dim>
double surface_speed(const State<Dim>& state) {
  double speed = 0;
  using Surface = std::conditional_t<Dim == 2, RigidSurface, SpaceSurface>;
  for (const RigidBody<Dim>& body : state.rigid)
    if (body.present) speed = std::max(speed, Surface(body).speed());
  return speed;
}

}  // namespace geodrop
