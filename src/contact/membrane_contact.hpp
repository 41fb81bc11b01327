// Membranes on membranes, and on themselves where they fold: penalty normal to the surface, Coulomb friction along it.
//
// Each node of one membrane meets the nearest segment of the other, and in a second pass the other way round; both
// count half. The law is that of penalty.hpp with half the length of membrane that belongs to the node, the outward
// normal n of the other surface between its nodes a and b at the foot of the node, and depth n . (x_foot - x) where
// that is positive. The reaction goes to a and b by the lever rule: momentum is kept to round-off, angular momentum but
// for the depth. Surfaces touch only if their normals oppose each other: a thin bag does not meet its own other flank
// from inside.
//
// In space nodes meet triangles, with the areas of nodes for lengths and a tangential spring that is a vector; the
// normal is that of the corners at the foot, by their shares. Own folds do not meet there.
#pragma once

#include <geodrop/scene/scene.hpp>
#include <geodrop/state/state.hpp>

namespace geodrop {

/// Contact between two membranes of the state, its springs slack. Stiffness times P / h of the softer body
/// behind; damping times the impedances rho c of both in series.
template <int Dim>
MembraneContact<Dim> make_membrane_contact(const Scene& scene, const ContactSpec& spec, const State<Dim>& state);

/// Adds to Membrane::load of both; `dt` [s] stretches the tangential springs.
void add_membrane_contacts(State<2>& state, double dt);
void add_membrane_contacts(State<3>& state, double dt);

}  // namespace geodrop
