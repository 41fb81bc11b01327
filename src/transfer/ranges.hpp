// Ranges of particles to the grid and back, chunk by chunk: weights, then one particle at a time, then the laws.
#pragma once

#include "transfer/baseline/simplex.hpp"

namespace geodrop {

/// Sums over the support of one particle, of the velocity change too where the transfer asks for it.
template <int Dim, class Basis, Transfer transfer, class Arithmetic = PlainArithmetic>
GatherSums<Dim> sums_of(const Grid<Dim>& grid, const ChunkWeights<Dim, Basis>& weights, int k) {
  constexpr bool change = transfer == Transfer::blend;
  if constexpr (std::is_same_v<Basis, Simplex>)
    return gather_simplex<Dim, change, Arithmetic>(grid, weights, k);
  else
    return gather_sums<Dim, Basis, change, Arithmetic>(grid, weights, k);
}

/// Adds the record of one particle to the nodes of its support; `force` is used with Separate only.
template <int Dim, class Basis, bool Separate, class Arithmetic>
void add_particle(const ScatterRecord<Dim>& record, const GridLayout<Dim>& layout,
                  const ChunkWeights<Dim, Basis>& weights, int k, Vec4* sum, Vec4* force) {
  if constexpr (std::is_same_v<Basis, Simplex>)
    scatter_simplex<Dim, Separate, Arithmetic>(record, layout, weights, k, sum, force);
  else
    scatter_particle<Dim, Basis, Separate, Arithmetic>(record, layout, weights, k, sum, force);
}

/// Scatters particles [begin, end) of a body. `dt` multiplies the force if it shares a record with the momentum.
template <int Dim, class Basis, bool Separate, class Arithmetic>
void scatter_range(const Body<Dim>& body, Grid<Dim>& grid, double dt, std::size_t begin, std::size_t end) {
  ChunkWeights<Dim, Basis> weights;
  ChunkStress<Dim> stress;
  alignas(64) double own[chunk_size];
  const NextChunk<Dim> next = next_to<particle_role::scattered>(body);
  for (std::size_t p = begin; p < end; p += chunk_size) {
    const int count = static_cast<int>(std::min<std::size_t>(chunk_size, end - p));
    compute_weights(grid.layout, pointers(body.x, p), body.half_size, count, weights);
    own_pressure<Dim, Basis>(body, grid, weights, count, own);
    carry_stress<Dim>(body, p, count, own, stress);
    if constexpr (std::is_same_v<Basis, Simplex>)
      if (body.pressure == PressureSupport::nodal) add_nodal_pressure<Dim>(grid, weights, count, stress);
    if constexpr (!Separate)
      for (const int c : acting_components<Dim>)
        for (int k = 0; k < count; ++k) stress.s[c][k] *= dt;
    for (int k = 0; k < count; ++k) {
      next.fetch(p, k);
      add_particle<Dim, Basis, Separate, Arithmetic>(
          make_record<Dim, Basis, Arithmetic>(body, weights, stress, p + k, k, grid.layout.h), grid.layout, weights, k,
          grid.sum.data(), grid.force.data());
    }
  }
}

/// Volume rates of filled cells (or averaged nodal ones) take the place of the particles' own.
template <int Dim, class Basis>
void take_averaged_rates(const Body<Dim>& body, const Grid<Dim>& grid, const ChunkWeights<Dim, Basis>& weights,
                         double dt, int count, ChunkRates<Dim>& rates) {
  if constexpr (std::is_same_v<Basis, Simplex>)
    if (body.pressure == PressureSupport::nodal) return take_nodal_rates<Dim>(grid, weights, dt, count, rates);
  if (body.pressure == PressureSupport::enclosed) {
    const double* const rate = grid.enclosed[body.enclosed].rate.data();
    for (int k = 0; k < count; ++k) rates.volume[k] = dt * rate[pressure_cell(grid.layout, weights, k)];
  }
  if (body.pressure != PressureSupport::cell) return;
  for (int k = 0; k < count; ++k) {
    const int cell = pressure_cell(grid.layout, weights, k);
    if (grid.cell_flags[cell] & cell_filled) rates.volume[k] = dt * grid.volume_rate[cell];
  }
}

/// D_p -= 10 v0^2 / (h c) crowding of the cell: what is squeezed pushes its surroundings away, what has more room than
/// volume draws them in. A cell evens its pressure out within h / c: that of 1 % is of 0.1 rho v0^2 or less.
template <int Dim, class Basis>
void make_room(const Grid<Dim>& grid, const ChunkWeights<Dim, Basis>& weights, double share, int count,
               ChunkRates<Dim>& rates) {
  for (int k = 0; k < count; ++k) rates.volume[k] -= share * grid.crowding[pressure_cell(grid.layout, weights, k)];
}

/// 10 dt v0^2 / (h c), 0 for a body that makes no room [-].
template <int Dim>
double share_of_crowding(const Body<Dim>& body, double h, double dt) {
  const double v0 = body.shift ? body.shift_speed : 0.0;
  return v0 > 0 ? 10 * dt * v0 * v0 / (h * wave_speed(body.material)) : 0.0;
}

/// What det(I + dt L) has beyond 1 + dt tr L.
template <int Dim>
void add_higher_terms(int count, ChunkRates<Dim>& rates) {
  const auto& a = rates.increment;
  const auto minor = [&a](int i, int j, int k) {
    return a[i * Dim + i][k] * a[j * Dim + j][k] - a[i * Dim + j][k] * a[j * Dim + i][k];
  };
#pragma omp simd
  for (int k = 0; k < count; ++k) {
    if constexpr (Dim == 2)
      rates.volume[k] += minor(0, 1, k);
    else
      rates.volume[k] += minor(0, 1, k) + minor(1, 2, k) + minor(2, 0, k) + a[0][k] * minor(1, 2, k) +
                         a[1][k] * (a[5][k] * a[6][k] - a[3][k] * a[8][k]) +
                         a[2][k] * (a[3][k] * a[7][k] - a[4][k] * a[6][k]);
  }
}

/// Whether the volume of a body follows det(I + dt L). In pores the grains rule what room there is, an enclosed fluid
/// takes its rate from the area of its membrane.
template <int Dim>
bool moves_as_fluid(const Body<Dim>& body, const Grid<Dim>& grid) {
  return std::holds_alternative<Newtonian>(body.material) && body.pressure != PressureSupport::enclosed &&
         grid.pore_share.empty();
}

/// Particles shift by a share of the width of their own span, not of h.
template <int Dim>
void scale_to_spans(const ChunkWeights<Dim, GradedBspline2>& weights, double inv_h, int count, ChunkRates<Dim>& rates) {
  for (int a = 0; a < Dim; ++a)
    for (int k = 0; k < count; ++k) rates.fill_slope[a][k] *= weights.span[a][k].width * inv_h;
}

template <int Dim, class Basis, Transfer transfer, class Arithmetic>
Maxima gather_range(Body<Dim>& body, const Grid<Dim>& grid, const GatherOptions& options, std::size_t begin,
                    std::size_t end) {
  ChunkWeights<Dim, Basis> weights;
  ChunkRates<Dim> rates;
  alignas(64) double old_x[Dim][chunk_size];
  Maxima maxima;
  const NextChunk<Dim> next = next_to<particle_role::gathered>(body);
  const bool fluid = moves_as_fluid(body, grid);
  const double share = share_of_crowding(body, grid.layout.h, options.dt);
  for (std::size_t p = begin; p < end; p += chunk_size) {
    const int count = static_cast<int>(std::min<std::size_t>(chunk_size, end - p));
    for (int a = 0; a < Dim; ++a) std::copy_n(body.x[a].data() + p, count, old_x[a]);
    compute_weights(grid.layout, pointers(body.x, p), body.half_size, count, weights);
    for (int k = 0; k < count; ++k) {
      next.fetch(p, k);
      const bool shift = body.shift && (grid.cell_flags[pressure_cell(grid.layout, weights, k)] & cell_shiftable);
      store_sums<Dim, transfer>(sums_of<Dim, Basis, transfer, Arithmetic>(grid, weights, k), options.dt, body.shift,
                                shift, k, rates);
    }
    if constexpr (transfer != Transfer::musl) {
      const double scale = options.damping / options.dt;
      if (next.from_memory() && count == chunk_size && p % chunk_size == 0)
        stream_affine(body, rates, scale, p);
      else
        store_affine(body, rates, scale, p, count);
    }
    take_averaged_rates<Dim, Basis>(body, grid, weights, options.dt, count, rates);
    if (fluid) add_higher_terms<Dim>(count, rates);
    if (share > 0) make_room<Dim, Basis>(grid, weights, share, count, rates);
    move_chunk<Dim, transfer>(body, options, rates, p, count);
    if constexpr (is_graded<Basis>)
      if (body.shift) scale_to_spans<Dim>(weights, grid.layout.inv_h, count, rates);
    if (body.shift) shift_chunk(body, rates, grid.layout.h, options.dt, p, count);
    strain_chunk<Dim>(body, rates, options.dt, p, count);
    finish_chunk(body, grid.layout, old_x, p, count, maxima);
  }
  finish_streaming();
  return maxima;
}

}  // namespace geodrop
