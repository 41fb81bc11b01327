// Where fluids that shift have more volume than room, or less.
#pragma once

#include <geodrop/grid/grid.hpp>

namespace geodrop {

/// By so much the fill ratio of a cell scatters in smooth flow and at rest [-].
inline constexpr double smooth_scatter = 0.05;

/// Grid::crowding of cells whose neighbours are all shiftable, 0 elsewhere: what the fill ratio, the mean of that of
/// the nodes over the cell, passes 1 + smooth_scatter by, or, below zero, falls short of 1 - smooth_scatter by.
template <int Dim>
void find_crowding(Grid<Dim>& grid);

}  // namespace geodrop
