// Rows of the step for a fluid that fills a closed membrane (PressureSupport::enclosed), in the plane.
#pragma once

#include <geodrop/grid/row.hpp>

namespace geodrop {

template <int Dim>
Row<Dim> enclosed_cells_row(const Scene& scene);
template <int Dim>
Row<Dim> enclosed_force_row(const Scene& scene);
template <int Dim>
Row<Dim> enclosed_load_row(const Scene& scene);
template <int Dim>
Row<Dim> enclosed_rate_row(const Scene& scene);

}  // namespace geodrop
