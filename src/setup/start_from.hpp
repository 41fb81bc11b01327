// Bodies and membranes that begin as another run left them.
#pragma once

#include <geodrop/state/state.hpp>

namespace geodrop {

/// The particles of a body of the same name, as they are. Throws SceneError if its law has other state variables.
template <int Dim>
void take_particles(const Body<Dim>& from, Body<Dim>& body);

/// The nodes of a membrane of the same name, with their mass, and segments or triangles with their length or area at
/// rest. Throws SceneError if one is closed and the other is not.
template <int Dim>
void take_cloth(const Membrane<Dim>& from, Membrane<Dim>& membrane);

}  // namespace geodrop
