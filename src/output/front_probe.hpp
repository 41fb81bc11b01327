// How far a heap reaches, lone particles ahead of it left out (2D).
#pragma once

#include <geodrop/scene.hpp>
#include <geodrop/scene/probes.hpp>
#include <geodrop/state.hpp>

namespace geodrop {

struct HeapFronts {
  double left = 0, right = 0;  ///< [m]
};

/// From the upright column of cells that holds most of the body, to both sides, as far as its thickness (volume over
/// width of a column, linear between their middles) stays above that of the probe; at most to the walls.
HeapFronts heap_fronts(const GridSpec& grid, const FrontProbeSpec& probe, const Body<2>& body);

}  // namespace geodrop
