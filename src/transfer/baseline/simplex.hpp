// Transfers on linear simplices, and the paper's cure of their locking.
//
// A cell is split along its main diagonal (Kuhn's triangulation): with the particle's local coordinates sorted,
// f_a >= f_b (>= f_c), its simplex has the nodes 0, e_a, e_a + e_b (, 1) and the weights 1 - f_a, f_a - f_b (, f_b -
// f_c), f_last. Along axis a the field rises from the first of these nodes to the second, along b from the second to
// the third.
//
// Cure (Stolle et al. 2014: volumetric strain and pressure averaged at nodes), with particles as quadrature points:
//   P_i = sum N_ip V_p p_p / sum N_ip V_p,        the stress of p acts with sum_i N_ip P_i for its pressure
//   D_i = sum N_ip V_p tr L_p / sum N_ip V_p,     J_p *= 1 + dt sum_i N_ip D_i
// Both use the same weights, so that the power of the forces is the rate of the stored energy.
#pragma once

#include "transfer/gather.hpp"
#include "transfer/scatter.hpp"

namespace geodrop {

/// Adds one particle to the Dim + 1 nodes of its simplex.
template <int Dim, bool Separate, class Arithmetic>
void scatter_simplex(const ScatterRecord<Dim>& r, const GridLayout<Dim>& layout,
                     const ChunkWeights<Dim, Simplex>& weights, int k, Vec4* sum, Vec4* force) {
  Vec4 value = r.value, before{};
  for (int n = 0; n <= Dim; ++n) {
    const int node = weights.node[n][k];
    const double w = weights.w[n][k];
    const Vec4 after = n < Dim ? layout.inv_h * r.traction[weights.axis[n][k]] : Vec4{};
    Vec4 f = before - after;
    if constexpr (Separate) {
      if constexpr (Dim == 3) f[3] = w * r.volume;
      Arithmetic::add_product(sum[node], w, value);
      force[node] += f;
    } else {
      Arithmetic::add_product(f, w, value);
      sum[node] += f;
    }
    if (n < Dim) value += r.step[weights.axis[n][k]];
    before = after;
  }
}

template <int Dim, bool Blend, class Arithmetic>
GatherSums<Dim> gather_simplex(const Grid<Dim>& grid, const ChunkWeights<Dim, Simplex>& weights, int k) {
  GatherSums<Dim> s;
  Vec4 below{};
  for (int n = 0; n <= Dim; ++n) {
    const int node = weights.node[n][k];
    const double w = weights.w[n][k];
    const Vec4 u = grid.velocity[node];
    Arithmetic::add_product(s.value, w, u);
    if constexpr (Blend) Arithmetic::add_product(s.change, w, grid.velocity_change[node]);
    if (n > 0) s.gradient[weights.axis[n - 1][k]] = grid.layout.inv_h * (u - below);
    below = u;
  }
  return s;
}

/// Mean of a nodal field at each particle of a chunk.
template <int Dim>
void interpolate_chunk(const Array<double>& field, const ChunkWeights<Dim, Simplex>& weights, int count, double* out) {
  for (int k = 0; k < count; ++k) {
    double sum = 0;
    for (int n = 0; n <= Dim; ++n) sum += weights.w[n][k] * field[weights.node[n][k]];
    out[k] = sum;
  }
}

/// The averaged pressure takes the place of the particles' own, which carry_stress left out.
template <int Dim>
void add_nodal_pressure(const Grid<Dim>& grid, const ChunkWeights<Dim, Simplex>& weights, int count,
                        ChunkStress<Dim>& stress) {
  alignas(64) double pressure[chunk_size];
  interpolate_chunk<Dim>(grid.node_pressure, weights, count, pressure);
  for (const int c : acting_components<Dim>)
    if (c < 3)
      for (int k = 0; k < count; ++k) stress.s[c][k] += stress.volume[k] * pressure[k];
}

template <int Dim>
void take_nodal_rates(const Grid<Dim>& grid, const ChunkWeights<Dim, Simplex>& weights, double dt, int count,
                      ChunkRates<Dim>& rates) {
  interpolate_chunk<Dim>(grid.node_rate, weights, count, rates.volume);
  for (int k = 0; k < count; ++k) rates.volume[k] *= dt;
}

/// node_volume += N V, node_pressure += N V p for particles [begin, end).
template <int Dim>
void sum_nodal_pressure_range(const Body<Dim>& body, Grid<Dim>& grid, std::size_t begin, std::size_t end) {
  ChunkWeights<Dim, Simplex> weights;
  alignas(64) double volume[chunk_size], pressure[chunk_size];
  for (std::size_t p = begin; p < end; p += chunk_size) {
    const int count = static_cast<int>(std::min<std::size_t>(chunk_size, end - p));
    compute_weights(grid.layout, pointers(body.x, p), body.half_size, count, weights);
    chunk_volumes<Dim>(body, p, count, volume, pressure);
    for (int k = 0; k < count; ++k)
      for (int n = 0; n <= Dim; ++n) {
        const double share = weights.w[n][k] * volume[k];
        grid.node_volume[weights.node[n][k]] += share;
        grid.node_pressure[weights.node[n][k]] += share * pressure[k];
      }
  }
}

/// node_rate += N V tr L for particles [begin, end).
template <int Dim, class Arithmetic>
void sum_nodal_rate_range(const Body<Dim>& body, Grid<Dim>& grid, std::size_t begin, std::size_t end) {
  ChunkWeights<Dim, Simplex> weights;
  const double inv_rho = 1 / reference_density(body.material);
  for (std::size_t p = begin; p < end; p += chunk_size) {
    const int count = static_cast<int>(std::min<std::size_t>(chunk_size, end - p));
    compute_weights(grid.layout, pointers(body.x, p), body.half_size, count, weights);
    for (int k = 0; k < count; ++k) {
      const GatherSums<Dim> s = gather_simplex<Dim, false, Arithmetic>(grid, weights, k);
      double expansion = body.mass[p + k] * inv_rho * body.J[p + k];
      double trace = 0;
      for (int a = 0; a < Dim; ++a) trace += s.gradient[a][a];
      expansion *= trace;
      for (int n = 0; n <= Dim; ++n) grid.node_rate[weights.node[n][k]] += weights.w[n][k] * expansion;
    }
  }
}

}  // namespace geodrop
