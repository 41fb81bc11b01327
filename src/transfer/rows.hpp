// Rows of the step that carry quantities from particles to the grid and back.
#pragma once

#include <geodrop/grid/row.hpp>

namespace geodrop {

template <int Dim>
Row<Dim> clear_grid_row(const Scene& scene);
template <int Dim>
Row<Dim> cell_pressure_row(const Scene& scene);
template <int Dim>
Row<Dim> nodal_pressure_row(const Scene& scene);
template <int Dim>
Row<Dim> particles_to_grid_row(const Scene& scene);
template <int Dim>
Row<Dim> remap_velocity_row(const Scene& scene);
template <int Dim>
Row<Dim> nodal_rate_row(const Scene& scene);
template <int Dim>
Row<Dim> grid_to_particles_row(const Scene& scene);

}  // namespace geodrop
