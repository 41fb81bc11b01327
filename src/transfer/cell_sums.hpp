// Sums over the particles of each pressure cell: volume, volume times pressure and, if asked, volume times modulus.
#pragma once

#include "chunk_laws.hpp"
#include "grid/checkerboard.hpp"

namespace geodrop {

/// The weight of water with a still level is that of its cell's middle, wherever particles are in it.
template <int Dim>
void take_weight_at_middle(const Newtonian& water, const GridLayout<Dim>& layout, const double* y,
                           const std::int32_t* row, int count, double* pressure) {
  const double* const middle = layout.middle_of_row.data();
  for (int k = 0; k < count; ++k) pressure[k] += water.unit_weight * (y[k] - middle[row[k]]);
}

/// Cells of `count` particles from p on, and their rows along the last axis.
template <int Dim>
[[gnu::always_inline]] inline void cells_of_chunk(const GridLayout<Dim>& layout, const Body<Dim>& body, std::size_t p,
                                                  int count, std::int32_t* cell, std::int32_t* row) {
  for (int k = 0; k < count; ++k) cell[k] = 0;
  for (int a = 0; a < Dim; ++a) {
    const double* const x = body.x[a].data() + p;
    const int stride = layout.stride[a];
    if (layout.graded()) {
      for (int k = 0; k < count; ++k) cell[k] += (row[k] = layout.knots[a].find_inside(x[k])) * stride;
      continue;
    }
    const double lower = layout.lower[a], inv_h = layout.inv_h;
    for (int k = 0; k < count; ++k) {
      row[k] = static_cast<std::int32_t>(__builtin_floor((x[k] - lower) * inv_h + 0.5)) + GridLayout<Dim>::pad;
      cell[k] += row[k] * stride;
    }
  }
}

template <int Dim>
void sum_cells_range(const Body<Dim>& body, Grid<Dim>& grid, std::size_t begin, std::size_t end) {
  alignas(64) double volume[chunk_size], pressure[chunk_size];
  alignas(64) std::int32_t cell[chunk_size], row[chunk_size];
  const double carried = body.pressure == PressureSupport::cell ? 1.0 : 0.0;
  const auto* const water = std::get_if<Newtonian>(&body.material);
  const double implicit = !body.implicit_pores.empty() ? implicit_modulus(body.material) : 0.0;
  const bool undrained = !grid.pore_volume.empty() && has_checkerboard(body);
  const double modulus = grid.cell_modulus.empty() ? 0.0 : carried * explicit_moduli(body).of_waves();
  double* const cell_volume = grid.cell_volume.data();
  double* const cell_pressure = grid.cell_pressure.data();
  const GridLayout<Dim>& layout = grid.layout;
  for (std::size_t p = begin; p < end; p += chunk_size) {
    const int count = static_cast<int>(std::min<std::size_t>(chunk_size, end - p));
    chunk_volumes<Dim>(body, p, count, volume, pressure);
    cells_of_chunk(layout, body, p, count, cell, row);
    if (water && water->has_still_level())  // rows are those along the last axis here
      take_weight_at_middle(*water, layout, body.x[Dim - 1].data() + p, row, count, pressure);
    for (int k = 0; k < count; ++k) {
      cell_volume[cell[k]] += volume[k];
      cell_pressure[cell[k]] += carried * volume[k] * pressure[k];
    }
    if (modulus > 0)
      for (int k = 0; k < count; ++k) grid.cell_modulus[cell[k]] += modulus * volume[k];
    if (undrained)
      for (int k = 0; k < count; ++k) grid.pore_volume[cell[k]] += volume[k];
    if (implicit > 0 && body.gas.empty())
      for (int k = 0; k < count; ++k) grid.pore_modulus[cell[k]] += implicit * volume[k];
    else if (implicit > 0)
      for (int k = 0; k < count; ++k)
        grid.pore_modulus[cell[k]] += fluid_stiffness(*water, pressure[k], body.gas[p + k]) * volume[k];
  }
}

}  // namespace geodrop
