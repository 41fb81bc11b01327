// Rows of the step for water that flows through pores.
#pragma once

#include <geodrop/grid/row.hpp>

namespace geodrop {

template <int Dim>
Row<Dim> pore_space_row(const Scene& scene);
template <int Dim>
Row<Dim> pore_pressure_row(const Scene& scene);
template <int Dim>
Row<Dim> pore_drag_row(const Scene& scene);
template <int Dim>
Row<Dim> implicit_pressure_row(const Scene& scene);
template <int Dim>
Row<Dim> pore_rate_row(const Scene& scene);

}  // namespace geodrop
