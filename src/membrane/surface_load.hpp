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

}  // namespace geodrop
