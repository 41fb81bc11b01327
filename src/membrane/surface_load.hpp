// Pressures on the triangles of membranes in space, as loads of their nodes.
#pragma once

#include <geodrop/scene/scene.hpp>
#include <geodrop/state/state.hpp>

#include <string>
#include <vector>

namespace geodrop {

/// Fluid at rest on one side of a membrane: p = gamma (level - z) below its level, outwards if it is inside.
struct StillColumn {
  std::string membrane;
  double unit_weight;  ///< gamma [N/m3]; negative: from outside
  double level;        ///< [m]
};
std::vector<StillColumn> still_columns(const Scene& scene);

/// Adds int p N dA n of the gauge pressure and of the fluids at rest, N linear on each triangle: exact, also where a
/// level cuts a triangle.
void add_surface_pressure(const std::vector<StillColumn>& columns, State<3>& state);

/// Adds int gamma (level - z) N dA n, negative above the level as well: the weight of a fluid inside.
void add_weight(double unit_weight, double level, Membrane<3>& membrane);

}  // namespace geodrop
