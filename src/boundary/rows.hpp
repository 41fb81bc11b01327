// Rows of the step for edges that let waves out, in the plane, and for eddies beside walls.
#pragma once

#include <geodrop/grid/row.hpp>

namespace geodrop {

Row<2> boundaries_to_grid_row(const Scene& scene);
template <int Dim>
Row<Dim> eddy_length_row(const Scene& scene);
Row<2> silent_sides_row(const Scene& scene);
Row<2> grid_to_boundaries_row(const Scene& scene);

}  // namespace geodrop
