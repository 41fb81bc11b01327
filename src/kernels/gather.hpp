// Grid to particles: velocity, affine rate, position, volume and stress.
//
//   v_p = a (v_p + sum N (v' - v)) + (1 - a) sum N v',  a = exp(-lambda dt)   (a = 0: APIC)
//   C_p = 4/h^2 sum N v' (x_i - x_p)^T,  x_p += dt sum N v',  L = sum v' (grad N)^T
//   J  *= 1 + dt D,  D = D_c in filled cells, tr L elsewhere                  design.md section 2, steps 4 and 5
#pragma once

#include "../materials/laws.hpp"
#include "chunk.hpp"

namespace geodrop {

struct GatherOptions {
  double dt;
  double keep;     ///< a of the blend [-]
  double damping;  ///< factor on the new velocity, exp(-beta dt) [-]
};

/// Velocity gradient and volume rate of a chunk, handed from the transfer to the material law.
template <int Dim>
struct ChunkRates {
  alignas(64) double increment[Dim * Dim][chunk_size];  ///< dt L, row-major [-]
  alignas(64) double volume[chunk_size];                ///< dt D [-]
};

/// Sums over the support of one particle; lanes as in Grid::velocity.
template <int Dim>
struct GatherSums {
  Vec4 value{};          ///< sum N u
  Vec4 change{};         ///< sum N (v' - v)
  Vec4 moment[Dim]{};    ///< sum N u (x_i - x_p)_a
  Vec4 gradient[Dim]{};  ///< sum u dN/dx_a
};

template <int Dim, class Basis, bool Blend>
GatherSums<Dim> gather_sums(const Grid<Dim>& grid, const ChunkWeights<Dim, Basis>& weights, int k) {
  GatherSums<Dim> s;
  const double h = grid.layout.h;
  const Vec4* const velocity0 = grid.velocity.data() + weights.first[k];
  const Vec4* const change0 = Blend ? grid.velocity_change.data() + weights.first[k] : nullptr;
  double wx[Basis::support], gx[Basis::support], mx[Basis::support];
  for (int i = 0; i < Basis::support; ++i) {
    wx[i] = weights.w[0][i][k];
    gx[i] = weights.g[0][i][k];
    mx[i] = wx[i] * (weights.reach[0][k] + i * h);
  }
  for (int z = 0; z < (Dim == 3 ? Basis::support : 1); ++z) {
    Vec4 plane{}, plane_change{}, plane_mx{}, plane_gx{}, plane_my{}, plane_gy{};
    for (int y = 0; y < Basis::support; ++y) {
      const int offset = y * grid.layout.stride[1] + (Dim == 3 ? z * grid.layout.stride[Dim - 1] : 0);
      Vec4 row{}, row_change{}, row_mx{}, row_gx{};
      for (int i = 0; i < Basis::support; ++i) {
        const Vec4 u = velocity0[offset + i];
        row += wx[i] * u;
        row_mx += mx[i] * u;
        row_gx += gx[i] * u;
        if constexpr (Blend) row_change += wx[i] * change0[offset + i];
      }
      const double wy = weights.w[1][y][k];
      plane += wy * row;
      plane_mx += wy * row_mx;
      plane_gx += wy * row_gx;
      plane_my += wy * (weights.reach[1][k] + y * h) * row;
      plane_gy += weights.g[1][y][k] * row;
      if constexpr (Blend) plane_change += wy * row_change;
    }
    const double wz = Dim == 3 ? weights.w[Dim - 1][z][k] : 1.0;
    s.value += wz * plane;
    s.change += wz * plane_change;
    s.moment[0] += wz * plane_mx;
    s.moment[1] += wz * plane_my;
    s.gradient[0] += wz * plane_gx;
    s.gradient[1] += wz * plane_gy;
    if constexpr (Dim == 3) {
      s.moment[2] += wz * (weights.reach[2][k] + z * h) * plane;
      s.gradient[2] += weights.g[2][z][k] * plane;
    }
  }
  return s;
}

/// Step out of clumps and into voids: dx = -h dt (|v| + v0) grad(phi), v += C dx (design.md section 2, step 6).
template <int Dim>
void shift_particle(Body<Dim>& body, std::size_t p, const GatherSums<Dim>& s, double h, double dt) {
  double speed2 = 0;
  for (int a = 0; a < Dim; ++a) speed2 += body.v[a][p] * body.v[a][p];
  const double scale = -h * dt * (__builtin_sqrt(speed2) + body.shift_speed);
  double dx[Dim];
  for (int a = 0; a < Dim; ++a) {
    dx[a] = scale * s.gradient[a][3];
    body.x[a][p] += dx[a];
  }
  for (int a = 0; a < Dim; ++a)
    for (int b = 0; b < Dim; ++b) body.v[a][p] += body.affine[a * Dim + b][p] * dx[b];
}

/// Largest speed and displacement seen, for the time step and the sort.
struct Maxima {
  double speed2 = 0;
  double displacement = 0;
};

template <int Dim, class Basis, bool Blend>
void move_particle(Body<Dim>& body, const GridLayout<Dim>& layout, const GatherOptions& options,
                   const GatherSums<Dim>& s, bool shift, std::size_t p, Maxima& maxima) {
  const double inertia_inverse = Basis::inertia_inverse * layout.inv_h * layout.inv_h;
  double old_x[Dim];
  for (int a = 0; a < Dim; ++a) {
    double v = s.value[a];
    if constexpr (Blend) v = options.keep * (body.v[a][p] + s.change[a]) + (1 - options.keep) * v;
    body.v[a][p] = v * options.damping;
    old_x[a] = body.x[a][p];
    body.x[a][p] = old_x[a] + options.dt * s.value[a];
    for (int b = 0; b < Dim; ++b) body.affine[a * Dim + b][p] = inertia_inverse * options.damping * s.moment[b][a];
  }
  if (shift) shift_particle(body, p, s, layout.h, options.dt);
  double speed2 = 0;
  for (int a = 0; a < Dim; ++a) {
    // Round-off alone can carry a particle across a wall; anything larger is reported by sort_particles.
    const double round_off = 1e-9 * layout.h;
    double& x = body.x[a][p];
    if (x < layout.lower[a] && x > layout.lower[a] - round_off) x = layout.lower[a];
    if (x > layout.upper[a] && x < layout.upper[a] + round_off) x = layout.upper[a];
    speed2 += body.v[a][p] * body.v[a][p];
    maxima.displacement = std::max(maxima.displacement, __builtin_fabs(x - old_x[a]));
  }
  // Written so that NaN is kept: the time step then reports it.
  maxima.speed2 = speed2 > maxima.speed2 || speed2 != speed2 ? speed2 : maxima.speed2;
}

template <int Dim, class R>
std::array<R, Dim * Dim> load_increment(const ChunkRates<Dim>& rates, int k) {
  std::array<R, Dim * Dim> out;
  for (int c = 0; c < Dim * Dim; ++c) out[c] = load<R>(&rates.increment[c][k]);
  return out;
}

template <int Dim, class R>
void update_point(Body<Dim>& body, const Newtonian& water, const ChunkRates<Dim>& rates, double dt, std::size_t p,
                  int k) {
  store(&body.J[p], load<R>(&body.J[p]) * (1 + load<R>(&rates.volume[k])));
  if (water.viscosity <= 0) return;
  const auto s = viscous_stress<Dim, R>(water.viscosity / dt, load_increment<Dim, R>(rates, k));
  for (int c = 0; c < stress_components<Dim>; ++c) store(&body.stress[c][p], s[c]);
}

template <int Dim, class R>
std::array<R, stress_components<Dim>> load_stress(const Body<Dim>& body, std::size_t p) {
  std::array<R, stress_components<Dim>> sigma;
  for (int c = 0; c < stress_components<Dim>; ++c) sigma[c] = load<R>(&body.stress[c][p]);
  return sigma;
}

template <int Dim, class R>
void update_point(Body<Dim>& body, const LinearElastic& solid, const ChunkRates<Dim>& rates, double, std::size_t p,
                  int k) {
  const R volume = load<R>(&rates.volume[k]);
  auto sigma = load_stress<Dim, R>(body, p);
  update_stress<Dim, R>(solid, load_increment<Dim, R>(rates, k), volume, sigma);
  for (int c = 0; c < stress_components<Dim>; ++c) store(&body.stress[c][p], sigma[c]);
  store(&body.J[p], load<R>(&body.J[p]) * (1 + volume));
}

template <int Dim, class R>
void update_point(Body<Dim>& body, const MohrCoulomb& soil, const ChunkRates<Dim>& rates, double, std::size_t p,
                  int k) {
  const R volume = load<R>(&rates.volume[k]);
  auto sigma = load_stress<Dim, R>(body, p);
  const R strain = update_stress<Dim, R>(soil, load_increment<Dim, R>(rates, k), volume, sigma);
  for (int c = 0; c < stress_components<Dim>; ++c) store(&body.stress[c][p], sigma[c]);
  store(&body.deviatoric_strain[p], load<R>(&body.deviatoric_strain[p]) + strain);
  store(&body.J[p], load<R>(&body.J[p]) * (1 + volume));
  if (!body.pore_pressure.empty())
    store(&body.pore_pressure[p], load<R>(&body.pore_pressure[p]) - soil.pore_stiffness * volume);
}

template <int Dim, class Law>
void update_chunk(Body<Dim>& body, const Law& law, const ChunkRates<Dim>& rates, double dt, std::size_t p, int count) {
  int k = 0;
  for (; k + packet_width <= count; k += packet_width) update_point<Dim, Packet>(body, law, rates, dt, p + k, k);
  for (; k < count; ++k) update_point<Dim, double>(body, law, rates, dt, p + k, k);
}

template <int Dim, class Basis, bool Blend, class Law>
Maxima gather_range(Body<Dim>& body, const Law& law, const Grid<Dim>& grid, const GatherOptions& options,
                    std::size_t begin, std::size_t end) {
  ChunkWeights<Dim, Basis> weights;
  ChunkRates<Dim> rates;
  Maxima maxima;
  const bool use_cells = body.pressure == PressureSupport::cell;
  const int to_base = base_offset(grid.layout);
  for (std::size_t p = begin; p < end; p += chunk_size) {
    const int count = static_cast<int>(std::min<std::size_t>(chunk_size, end - p));
    std::array<const double*, Dim> x;
    for (int a = 0; a < Dim; ++a) x[a] = body.x[a].data() + p;
    compute_weights<Dim, Basis>(grid.layout, x, count, weights);
    for (int k = 0; k < count; ++k) {
      const auto s = gather_sums<Dim, Basis, Blend>(grid, weights, k);
      double trace = 0;
      for (int a = 0; a < Dim; ++a) {
        trace += s.gradient[a][a];
        for (int b = 0; b < Dim; ++b) rates.increment[a * Dim + b][k] = options.dt * s.gradient[b][a];
      }
      const int cell = weights.first[k] + to_base;
      const std::uint8_t flags = use_cells || body.shift ? grid.cell_flags[cell] : std::uint8_t{0};
      const bool filled = use_cells && (flags & cell_filled);
      rates.volume[k] = options.dt * (filled ? grid.volume_rate[cell] : trace);
      move_particle<Dim, Basis, Blend>(body, grid.layout, options, s, body.shift && (flags & cell_shiftable), p + k,
                                       maxima);
    }
    update_chunk(body, law, rates, options.dt, p, count);
  }
  return maxima;
}

}  // namespace geodrop
