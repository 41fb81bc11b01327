// Rows of the step that belong to the grid.
#pragma once

#include <geodrop/grid/row.hpp>

namespace geodrop {

template <int Dim>
Row<Dim> sort_particles_row(const Scene& scene);
template <int Dim>
Row<Dim> fold_walls_row(const Scene& scene);
template <int Dim>
Row<Dim> momentum_row(const Scene& scene);
template <int Dim>
Row<Dim> mass_correction_row(const Scene& scene);
template <int Dim>
Row<Dim> filter_checkerboard_row(const Scene& scene);
template <int Dim>
Row<Dim> volume_rate_row(const Scene& scene);
template <int Dim>
Row<Dim> crowding_row(const Scene& scene);
template <int Dim>
Row<Dim> spread_particles_row(const Scene& scene);

}  // namespace geodrop
