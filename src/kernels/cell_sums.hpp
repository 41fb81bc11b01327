// Sums over the particles of each pressure cell: volume, and volume times pressure.
#pragma once

#include "chunk.hpp"

namespace geodrop {

/// Volume [m3] and pressure [Pa] of a chunk of particles.
template <int Dim>
void volumes_and_pressures(const Body<Dim>& body, const Newtonian& water, std::size_t begin, int count, double* volume,
                           double* pressure) {
  const double* const J = body.J.data() + begin;
  const double* const mass = body.mass.data() + begin;
  const double inv_rho = 1 / water.density, K = water.bulk_modulus;
  for (int k = 0; k < count; ++k) {
    volume[k] = mass[k] * inv_rho * J[k];
    pressure[k] = K * (1 / J[k] - 1);
  }
}

template <int Dim>
void solid_volumes_and_pressures(const Body<Dim>& body, double density, std::size_t begin, int count, double* volume,
                                 double* pressure) {
  const double* const pore = body.pore_pressure.empty() ? nullptr : body.pore_pressure.data() + begin;
  for (int k = 0; k < count; ++k) {
    const std::size_t p = begin + k;
    volume[k] = body.mass[p] * body.J[p] / density;
    pressure[k] = (pore ? pore[k] : 0.0) - (body.stress[0][p] + body.stress[1][p] + body.stress[2][p]) / 3;
  }
}

template <int Dim>
void volumes_and_pressures(const Body<Dim>& body, const LinearElastic& solid, std::size_t begin, int count,
                           double* volume, double* pressure) {
  solid_volumes_and_pressures(body, solid.density, begin, count, volume, pressure);
}

template <int Dim>
void volumes_and_pressures(const Body<Dim>& body, const MohrCoulomb& soil, std::size_t begin, int count, double* volume,
                           double* pressure) {
  solid_volumes_and_pressures(body, soil.density, begin, count, volume, pressure);
}

template <int Dim>
void volumes_and_pressures(const Body<Dim>& body, const NeoHookean& solid, std::size_t begin, int count, double* volume,
                           double* pressure) {
  solid_volumes_and_pressures(body, solid.density, begin, count, volume, pressure);
}

template <int Dim, class Law>
void sum_cells_range(const Body<Dim>& body, const Law& law, Grid<Dim>& grid, std::size_t begin, std::size_t end) {
  alignas(64) double volume[chunk_size], pressure[chunk_size];
  alignas(64) std::int32_t cell[chunk_size];
  const double carried = body.pressure == PressureSupport::cell ? 1.0 : 0.0;
  double* const cell_volume = grid.cell_volume.data();
  double* const cell_pressure = grid.cell_pressure.data();
  const GridLayout<Dim>& layout = grid.layout;
  for (std::size_t p = begin; p < end; p += chunk_size) {
    const int count = static_cast<int>(std::min<std::size_t>(chunk_size, end - p));
    volumes_and_pressures(body, law, p, count, volume, pressure);
    for (int k = 0; k < count; ++k) cell[k] = 0;
    for (int a = 0; a < Dim; ++a) {
      const double* const x = body.x[a].data() + p;
      const double lower = layout.lower[a], inv_h = layout.inv_h;
      for (int k = 0; k < count; ++k)
        cell[k] += (static_cast<std::int32_t>(__builtin_floor((x[k] - lower) * inv_h + 0.5)) + GridLayout<Dim>::pad) *
                   layout.stride[a];
    }
    for (int k = 0; k < count; ++k) {
      cell_volume[cell[k]] += volume[k];
      cell_pressure[cell[k]] += carried * volume[k] * pressure[k];
    }
  }
}

}  // namespace geodrop
