// Membrane nodes on rigid surfaces: penalty normal to the surface, Coulomb friction along it.
//
//   f_n = k l max(0, -g)          g = n . (x - x0): gap, l: length of membrane that belongs to the node
//   xi += dt v_t,  f_t = -k l xi, cut to |f_t| <= mu f_n      xi: stretch of the node's tangential spring
//
// Springs go slack when a node lets go. k = factor P / h, with P the wave modulus of the body behind the membrane: the
// step is then as stable as without contact up to factor (c dt / h)^2 = 1/2, and a pressure p sinks in by p h / P.
#pragma once

#include <geodrop/scene.hpp>
#include <geodrop/state.hpp>

namespace geodrop {

/// Contact of a membrane with a rigid body, its springs slack.
template <int Dim>
Contact<Dim> make_contact(const Scene& scene, const ContactSpec& spec, const State<Dim>& state);

/// Adds to Membrane::load; `dt` [s] stretches the tangential springs.
template <int Dim>
void add_contact_forces(State<Dim>& state, double dt);

}  // namespace geodrop
