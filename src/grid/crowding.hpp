// Where fluids that shift have more volume than room, or less.
#pragma once

#include <geodrop/grid/grid.hpp>

namespace geodrop {

/// By so much the fill ratio of a cell scatters in smooth flow and at rest [-].
inline constexpr double smooth_scatter = 0.03;

/// Grid::crowding of shiftable cells, 0 elsewhere: what the binomial mean of the fill ratios of the nodes around passes
/// 1 + smooth_scatter by, or, below zero, falls short of 1 - smooth_scatter by. The latter only where all cells around
/// are shiftable, too: nearer to a surface the mean is less than 1 at rest.
template <int Dim>
void find_crowding(Grid<Dim>& grid);

}  // namespace geodrop
