// Pressures on the triangles of membranes in space, as loads of their nodes.
#pragma once

#include <geodrop/state/state.hpp>

#include <vector>

#include "fluid_load.hpp"

namespace geodrop {

/// Adds int p N dA n of the gauge pressure and of the fluids at rest, N linear on each triangle: exact, also where a
/// level cuts a triangle.
void add_surface_pressure(const std::vector<StillFluid>& fluids, State<3>& state);

/// Adds int gamma (level - z) N dA n, negative above the level as well: the weight of a fluid inside.
void add_weight(double unit_weight, double level, Membrane<3>& membrane);

}  // namespace geodrop
