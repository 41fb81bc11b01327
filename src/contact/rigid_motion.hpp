// How rigid bodies move: turned about their centre, in space about the axis along x through it, and moved on.
#pragma once

#include <geodrop/scene/scene.hpp>
#include <geodrop/state/state.hpp>

namespace geodrop {

/// About which a body turns; the origin if it does not [m].
template <int Dim>
std::array<double, Dim> centre_of(const RigidMotion& motion);

/// Moves the bodies whose motion goes on by one step; their rates are means over it, zero for those at rest.
template <int Dim>
void move_rigid_bodies(const std::vector<RigidSpec>& specs, double dt, State<Dim>& state);

}  // namespace geodrop
