// Membrane nodes and bare particles on rigid surfaces (2D): penalty normal to the surface, Coulomb friction along it.
//
// The law is that of penalty.hpp where the depth is positive, of a particle with half its width. Springs are slack
// where there was no contact in the step before. k = stiffness P / h, z = damping rho c, with P = rho c^2 the wave
// modulus of the body that touches: a pressure p sinks in by p h / (stiffness P), and a wave that arrives meets the
// impedance of more of the same body. Stable up to stiffness (c dt / h)^2 = 1/2, see stable_dt.
#pragma once

#include <geodrop/base/find_named.hpp>
#include <geodrop/grid/grid.hpp>
#include <geodrop/scene/scene.hpp>
#include <geodrop/state/state.hpp>

#include <limits>
#include <vector>

#include "rigid_surface.hpp"

namespace geodrop {

/// Contact of a membrane or a body with a rigid body, nothing touching yet.
RigidContact<2> make_rigid_contact(const Scene& scene, const ContactSpec& spec, const State<2>& state);

/// The body that touches, or that is behind the membrane that does.
template <int Dim>
const Body<Dim>& touching_body(const State<Dim>& state, const RigidContact<Dim>& contact) {
  return find_named(state.bodies, contact.bare ? contact.touching : find_named(state.membranes, contact.touching).body);
}

/// A membrane node or particle that is about to be looked at.
struct ContactPoint {
  std::uint32_t id;                                          ///< node, or id of the particle
  Vec<2> x, v;                                               ///< [m], [m/s]
  double length;                                             ///< of surface that belongs to it [m]
  double reach;                                              ///< half width: how far its surface is from it [m]
  double rubbing = std::numeric_limits<double>::infinity();  ///< pressure that can rub, see penalty.hpp [Pa]
};

/// What a point gets, and where: on the surface, no farther than its reach; at the point where nothing touches.
struct SurfaceForce {
  Vec<2> force;  ///< [N]
  Vec<2> on;     ///< [m]
  std::size_t point = 0;
};

/// Forces on points in ascending order of their ids, one for each point, then those of second faces that points in a
/// corner touch; those that touch become the contact's.
std::vector<SurfaceForce> contact_forces(const RigidSurface& surface, const std::vector<ContactPoint>& points,
                                         double dt, RigidContact<2>& contact);

/// Contacts of membranes: adds to Membrane::load; `dt` [s] stretches the tangential springs.
void add_contact_forces(State<2>& state, double dt);

/// Contacts of bare particles: adds to the nodal sums, or to the force where it is kept apart.
void contact_to_grid(State<2>& state, Grid<2>& grid, double dt);

}  // namespace geodrop
