// Rows of the step for bodies that meet at a sharp interface, in the plane.
#pragma once

#include <geodrop/grid/row.hpp>

namespace geodrop {

Row<2> cut_cells_row(const Scene& scene);
Row<2> interface_pressure_row(const Scene& scene);
Row<2> even_out_volumes_row(const Scene& scene);
Row<2> seep_row(const Scene& scene);
Row<2> model_drag_row(const Scene& scene);
Row<2> interface_force_row(const Scene& scene);
Row<2> join_interfaces_row(const Scene& scene);
Row<2> fill_other_sides_row(const Scene& scene);
Row<2> interface_rate_row(const Scene& scene);
Row<2> keep_sides_row(const Scene& scene);

}  // namespace geodrop
