// Particles to grid: mass, affine momentum and the force of particle stresses.
//
//   sum_i   += N_ip (m v + m C (x_i - x_p)),  N_ip m           affine, as APIC (Jiang et al. 2015, eq. 8-9)
//   force_i -= V_p sigma_p grad N_ip                           Hamad & Moormann eq. 8
//
// Where the body's pressure acts from a filled cell, sigma_p is the deviator only; grid/momentum adds P_c.
#pragma once

#include "chunk_laws.hpp"

namespace geodrop {

/// 1 where the particle's own pressure acts, 0 where its cell carries the pressure.
template <int Dim, class Basis>
void own_pressure(const Body<Dim>& body, const Grid<Dim>& grid, const ChunkWeights<Dim, Basis>& weights, int count,
                  double* own) {
  if (body.pressure != PressureSupport::cell) {
    std::fill_n(own, count, body.pressure == PressureSupport::particle ? 1.0 : 0.0);
    return;
  }
  for (int k = 0; k < count; ++k)
    own[k] = grid.cell_flags[pressure_cell(grid.layout, weights, k)] & cell_filled ? 0.0 : 1.0;
}

/// One particle's contribution: vectors of a node record.
template <int Dim>
struct ScatterRecord {
  Vec4 value;          ///< momentum and mass (2D: and volume) at the lowest node of the support
  Vec4 step[Dim];      ///< change of `value` per node (graded: per metre) along an axis
  Vec4 traction[Dim];  ///< -V sigma e_a
  double volume;       ///< [m3]
};

template <int Dim, class Basis, class Arithmetic>
ScatterRecord<Dim> make_record(const Body<Dim>& body, const ChunkWeights<Dim, Basis>& weights,
                               const ChunkStress<Dim>& stress, std::size_t p, int k, double h) {
  ScatterRecord<Dim> r;
  const double m = body.mass[p];
  r.value = Vec4{};
  for (int a = 0; a < Dim; ++a) r.value[a] = m * body.v[a][p];
  r.value[3] = m;
  r.volume = stress.volume[k];
  if constexpr (Dim == 2) r.value[2] = r.volume;
  for (int b = 0; b < Dim; ++b) {
    Vec4 column{}, traction{};
    for (int a = 0; a < Dim; ++a) {
      column[a] = m * body.affine[a * Dim + b][p];
      traction[a] = stress.s[stress_index<Dim>(a, b)][k];
    }
    Arithmetic::add_product(r.value, weights.reach[b][k], column);
    r.step[b] = is_graded<Basis> ? column : h * column;
    r.traction[b] = traction;
  }
  return r;
}

/// Adds one particle to a row of nodes; `outer_w` is the product of the other axes' weights.
/// With Separate, force has its own record; without, `traction` comes times dt and joins the momentum.
template <bool Separate, class Arithmetic, int Dim, class Basis>
void add_row(Vec4* sum, Vec4* force, const ChunkWeights<Dim, Basis>& weights, int k, double outer_w, Vec4 value,
             Vec4 step, Vec4 traction_x, Vec4 traction_rest) {
  const auto& w = weights.w[0];
  const auto& g = weights.g[0];
  value *= outer_w;
  step *= outer_w;
  traction_x *= outer_w;
  if constexpr (!Separate) value += traction_rest;  // one multiply-add less for each node
  const Vec4 lowest = value;
  for (int i = 0; i < Basis::support; ++i) {
    if constexpr (is_graded<Basis>) {
      value = lowest;
      Arithmetic::add_product(value, node_offset(weights, 0, i, k), step);
    }
    if constexpr (Separate) {
      Arithmetic::add_product(sum[i], w[i][k], value);
      Arithmetic::add_product(force[i], g[i][k], traction_x);
      Arithmetic::add_product(force[i], w[i][k], traction_rest);
    } else {
      Arithmetic::add_product(sum[i], g[i][k], traction_x);
      Arithmetic::add_product(sum[i], w[i][k], value);
    }
    if constexpr (!is_graded<Basis>) value += step;
  }
}

template <int Dim, class Basis, bool Separate, class Arithmetic>
void scatter_particle(const ScatterRecord<Dim>& r, const GridLayout<Dim>& layout,
                      const ChunkWeights<Dim, Basis>& weights, int k, Vec4* sum, Vec4* force) {
  Vec4* const sum0 = sum + weights.first[k];
  Vec4* const force0 = Separate ? force + weights.first[k] : nullptr;
  for (int z = 0; z < (Dim == 3 ? Basis::support : 1); ++z) {
    const double wz = Dim == 3 ? weights.w[Dim - 1][z][k] : 1.0;
    for (int y = 0; y < Basis::support; ++y) {
      const double wy = weights.w[1][y][k];
      Vec4 value = r.value;
      Arithmetic::add_product(value, node_offset(weights, 1, y, k), r.step[1]);
      Vec4 rest = weights.g[1][y][k] * wz * r.traction[1];
      int offset = y * layout.stride[1];
      if constexpr (Dim == 3) {
        Arithmetic::add_product(value, node_offset(weights, 2, z, k), r.step[2]);
        Arithmetic::add_product(rest, wy * weights.g[2][z][k], r.traction[2]);
        if constexpr (Separate) rest[3] = wy * wz * r.volume;
        offset += z * layout.stride[2];
      }
      add_row<Separate, Arithmetic>(sum0 + offset, Separate ? force0 + offset : nullptr, weights, k, wy * wz, value,
                                    r.step[0], r.traction[0], rest);
    }
  }
}

}  // namespace geodrop
