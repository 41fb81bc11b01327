// Grid to particles: velocity, affine rate, position, volume and stress.
//
//   v_p = a (v_p + sum N (v' - v)) + (1 - a) sum N v',  a = exp(-lambda dt)   (a = 0: TPIC)
//   C_p = L,  L = sum v' (grad N)^T,  x_p += dt sum N v'       (TPIC, Nakamura et al. 2023)
//   J  *= 1 + dt D,  D = D_c in filled cells (grid/cell_pressure.hpp), tr L elsewhere; fluids: det(I + dt L) for
//   1 + dt tr L, the area that x_p += dt sum N v' makes of a particle's; elastic solids: add_stretch_of_spin
#pragma once

#include "chunk_laws.hpp"
#include "stream.hpp"

namespace geodrop {

struct GatherOptions {
  Transfer transfer;
  double dt;
  double keep;     ///< a of the blend [-]
  double damping;  ///< factor on the new velocity, exp(-beta dt) [-]
};

/// Sums over the support of one particle; lanes as in Grid::velocity.
template <int Dim>
struct GatherSums {
  Vec4 value{};          ///< sum N u
  Vec4 change{};         ///< sum N (v' - v)
  Vec4 gradient[Dim]{};  ///< sum u dN/dx_a
};

template <int Dim, class Basis, bool Blend, class Arithmetic = PlainArithmetic>
GatherSums<Dim> gather_sums(const Grid<Dim>& grid, const ChunkWeights<Dim, Basis>& weights, int k) {
  GatherSums<Dim> s;
  const Vec4* const velocity0 = grid.velocity.data() + weights.first[k];
  const Vec4* const change0 = Blend ? grid.velocity_change.data() + weights.first[k] : nullptr;
  double wx[Basis::support], gx[Basis::support];
  for (int i = 0; i < Basis::support; ++i) {
    wx[i] = weights.w[0][i][k];
    gx[i] = weights.g[0][i][k];
  }
  for (int z = 0; z < (Dim == 3 ? Basis::support : 1); ++z) {
    Vec4 plane{}, plane_change{}, plane_gx{}, plane_gy{};
    for (int y = 0; y < Basis::support; ++y) {
      const int offset = y * grid.layout.stride[1] + (Dim == 3 ? z * grid.layout.stride[Dim - 1] : 0);
      Vec4 row{}, row_change{}, row_gx{};
      for (int i = 0; i < Basis::support; ++i) {
        const Vec4 u = velocity0[offset + i];
        Arithmetic::add_product(row, wx[i], u);
        Arithmetic::add_product(row_gx, gx[i], u);
        if constexpr (Blend) Arithmetic::add_product(row_change, wx[i], change0[offset + i]);
      }
      const double wy = weights.w[1][y][k];
      Arithmetic::add_product(plane, wy, row);
      Arithmetic::add_product(plane_gx, wy, row_gx);
      Arithmetic::add_product(plane_gy, weights.g[1][y][k], row);
      if constexpr (Blend) Arithmetic::add_product(plane_change, wy, row_change);
    }
    const double wz = Dim == 3 ? weights.w[Dim - 1][z][k] : 1.0;
    Arithmetic::add_product(s.value, wz, plane);
    Arithmetic::add_product(s.gradient[0], wz, plane_gx);
    Arithmetic::add_product(s.gradient[1], wz, plane_gy);
    if constexpr (Dim == 3) Arithmetic::add_product(s.gradient[2], weights.g[2][z][k], plane);
    if constexpr (Blend) Arithmetic::add_product(s.change, wz, plane_change);
  }
  return s;
}

/// Spreads the sums of particle k of the chunk over the arrays of the chunk; whether it may `shift` counts only for
/// bodies of which some may.
template <int Dim, Transfer transfer>
void store_sums(const GatherSums<Dim>& s, double dt, bool shifting_body, bool shift, int k, ChunkRates<Dim>& rates) {
  double trace = 0;
  for (int b = 0; b < Dim; ++b) {
    const Vec4 increment = dt * s.gradient[b];
    trace += increment[b];
    for (int a = 0; a < Dim; ++a) rates.increment[a * Dim + b][k] = increment[a];
    rates.velocity[b][k] = s.value[b];
    if constexpr (transfer == Transfer::blend) rates.change[b][k] = s.change[b];
    if (shifting_body) rates.fill_slope[b][k] = shift ? s.gradient[b][3] : 0.0;
  }
  rates.volume[k] = trace;
}

/// C_p = L_p, damped.
template <int Dim>
void store_affine(Body<Dim>& body, const ChunkRates<Dim>& rates, double scale, std::size_t p, int count) {
  for (int c = 0; c < Dim * Dim; ++c) {
    const double* const increment = rates.increment[c];
    double* const affine = body.affine[c].data() + p;
#pragma omp simd
    for (int k = 0; k < count; ++k) affine[k] = scale * increment[k];
  }
}

/// The same of a whole chunk. Nothing reads it before the next step: where it would leave the cache anyway it goes
/// straight to memory, which spares reading it first (3D soil on hat functions: 15 % more particle-steps per second).
template <int Dim>
void stream_affine(Body<Dim>& body, const ChunkRates<Dim>& rates, double scale, std::size_t p) {
  for (int c = 0; c < Dim * Dim; ++c) stream_scaled(scale, rates.increment[c], chunk_size, body.affine[c].data() + p);
}

template <int Dim, Transfer transfer>
void move_chunk(Body<Dim>& body, const GatherOptions& options, const ChunkRates<Dim>& rates, std::size_t p, int count) {
  const double dt = options.dt, keep = options.keep, damping = options.damping;
  for (int a = 0; a < Dim; ++a) {
    double* const x = body.x[a].data() + p;
    double* const v = body.v[a].data() + p;
#pragma omp simd
    for (int k = 0; k < count; ++k) {
      double value = rates.velocity[a][k];
      x[k] += dt * value;
      if constexpr (transfer == Transfer::musl) continue;  // remap_velocity has moved v on
      if constexpr (transfer == Transfer::blend) value = keep * (v[k] + rates.change[a][k]) + (1 - keep) * value;
      v[k] = damping * value;
    }
  }
}

/// Step out of clumps and into voids: dx = -h dt (|v| + v0) grad(phi), v += C dx (docs/step.md, "grid_to_particles").
template <int Dim>
void shift_chunk(Body<Dim>& body, const ChunkRates<Dim>& rates, double h, double dt, std::size_t p, int count) {
  alignas(64) double scale[chunk_size] = {};
  for (int a = 0; a < Dim; ++a) {
    const double* const v = body.v[a].data() + p;
#pragma omp simd
    for (int k = 0; k < count; ++k) scale[k] += v[k] * v[k];
  }
  const double v0 = body.shift_speed;
#pragma omp simd
  for (int k = 0; k < count; ++k) scale[k] = -h * dt * (__builtin_sqrt(scale[k]) + v0);
  for (int b = 0; b < Dim; ++b) {
    double* const x = body.x[b].data() + p;
#pragma omp simd
    for (int k = 0; k < count; ++k) x[k] += scale[k] * rates.fill_slope[b][k];
    for (int a = 0; a < Dim; ++a) {
      double* const v = body.v[a].data() + p;
      const double* const affine = body.affine[a * Dim + b].data() + p;
#pragma omp simd
      for (int k = 0; k < count; ++k) v[k] += affine[k] * scale[k] * rates.fill_slope[b][k];
    }
  }
}

/// Largest speed and displacement seen, for the time step and the sort; speed2 is NaN once any speed was.
struct Maxima {
  double speed2 = 0;
  double displacement = 0;
  bool lost = false;  ///< a particle is not a point of the domain, or has no volume left
};

/// Keeps particles on the domain's side of walls that round-off carried them across and collects maxima. What is
/// farther off falls due to sort_particles, which reports it or takes it across a periodic wall, and so does what has
/// been turned inside out. `old_x` is the position before the step.
template <int Dim>
void finish_chunk(Body<Dim>& body, const GridLayout<Dim>& layout, const double (&old_x)[Dim][chunk_size], std::size_t p,
                  int count, Maxima& maxima) {
  const double round_off = 1e-9 * layout.h;
  alignas(64) double speed2[chunk_size] = {};
  double displacement = maxima.displacement;
  int lost = 0;
  const double* const J = body.J.data() + p;
#pragma omp simd reduction(| : lost)
  for (int k = 0; k < count; ++k) lost |= !(J[k] > 0);
  for (int a = 0; a < Dim; ++a) {
    double* const x = body.x[a].data() + p;
    const double* const v = body.v[a].data() + p;
    const double lower = layout.particle_lower[a], upper = layout.particle_upper[a];
#pragma omp simd reduction(max : displacement) reduction(| : lost)
    for (int k = 0; k < count; ++k) {
      double moved = x[k];
      moved = moved < lower && moved > lower - round_off ? lower : moved;
      moved = moved > upper && moved < upper + round_off ? upper : moved;
      x[k] = moved;
      lost |= !(moved >= lower && moved <= upper);
      const double distance = __builtin_fabs(moved - old_x[a][k]);
      displacement = distance > displacement ? distance : displacement;
      speed2[k] += v[k] * v[k];
    }
  }
  maxima.displacement = displacement;
  maxima.lost = maxima.lost || lost != 0;
  double largest = 0;
  int broken = 0;
#pragma omp simd reduction(max : largest) reduction(| : broken)
  for (int k = 0; k < count; ++k) {
    largest = speed2[k] > largest ? speed2[k] : largest;
    broken |= speed2[k] != speed2[k];
  }
  if (broken)
    maxima.speed2 = __builtin_nan("");
  else if (!(maxima.speed2 > largest))
    maxima.speed2 = maxima.speed2 != maxima.speed2 ? maxima.speed2 : largest;
}

}  // namespace geodrop
