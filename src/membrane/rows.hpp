// Rows of the step for membranes, and for tracers, which ride with the grid as their nodes do.
#pragma once

#include <geodrop/grid/row.hpp>

namespace geodrop {

template <int Dim>
Row<Dim> clear_loads_row(const Scene& scene);
Row<3> surface_pressure_row(const Scene& scene);
Row<2> still_fluids_row(const Scene& scene);
Row<2> even_out_nodes_row(const Scene& scene);
Row<2> slide_membranes_row(const Scene& scene);
template <int Dim>
Row<Dim> membranes_to_grid_row(const Scene& scene);
template <int Dim>
Row<Dim> anchors_row(const Scene& scene);
template <int Dim>
Row<Dim> hold_remapped_row(const Scene& scene);
template <int Dim>
Row<Dim> grid_to_membranes_row(const Scene& scene);
Row<2> move_skins_row(const Scene& scene);
template <int Dim>
Row<Dim> grid_to_tracers_row(const Scene& scene);

}  // namespace geodrop
