// Velocities at t = 0 of a body and of the geotextile on it, from `initial_velocity` of the body.
#pragma once

#include <geodrop/scene/scene.hpp>
#include <geodrop/state/state.hpp>

namespace geodrop {

/// v [m/s] and the affine rates dv_a/dx_b [1/s] of particles.
template <int Dim>
void set_velocity(const Scene& scene, const BodySpec& spec, Body<Dim>& body);

/// v [m/s] of the nodes of a membrane on that body: they move with it from the start.
template <int Dim>
void set_velocity(const Scene& scene, const BodySpec& spec, Membrane<Dim>& membrane);

}  // namespace geodrop
