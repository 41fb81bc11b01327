// Rows of the step for bodies that meet at a sharp interface; model drag is for the plane.
#pragma once

#include <geodrop/grid/row.hpp>

namespace geodrop {

template <int Dim>
Row<Dim> cut_cells_row(const Scene& scene);
template <int Dim>
Row<Dim> interface_pressure_row(const Scene& scene);
template <int Dim>
Row<Dim> even_out_volumes_row(const Scene& scene);
template <int Dim>
Row<Dim> seep_row(const Scene& scene);
Row<2> model_drag_row(const Scene& scene);
Row<2> rigid_parts_row(const Scene& scene);
template <int Dim>
Row<Dim> interface_force_row(const Scene& scene);
template <int Dim>
Row<Dim> join_interfaces_row(const Scene& scene);
template <int Dim>
Row<Dim> fill_other_sides_row(const Scene& scene);
template <int Dim>
Row<Dim> interface_rate_row(const Scene& scene);
template <int Dim>
Row<Dim> keep_sides_row(const Scene& scene);
template <int Dim>
Row<Dim> limit_unseen_row(const Scene& scene);

}  // namespace geodrop
