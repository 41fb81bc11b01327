// Rows of the step for edges that let waves out, in the plane.
#pragma once

#include <geodrop/grid/row.hpp>

namespace geodrop {

Row<2> boundaries_to_grid_row(const Scene& scene);
Row<2> silent_sides_row(const Scene& scene);
Row<2> grid_to_boundaries_row(const Scene& scene);

}  // namespace geodrop
