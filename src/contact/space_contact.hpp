// Nodes of membranes on rigid bodies in space: the penalty of surface_contact with areas for lengths, and a tangential
// spring that is a vector.
#pragma once

#include <geodrop/scene/scene.hpp>
#include <geodrop/state/state.hpp>

namespace geodrop {

/// Stiffness and damping from the body inside or, of a membrane alone, from its own stiffness J and mass m per area:
/// J / h^2 and sqrt(J m) / h.
RigidContact<3> make_space_contact(const Scene& scene, const ContactSpec& spec, const State<3>& state);

/// Adds the forces of all contacts to the loads of the nodes.
void add_space_contacts(State<3>& state, double dt);

}  // namespace geodrop
