// Particles are worked on in chunks that fit the first-level cache: weights and material laws several particles
// wide, transfers one particle at a time with the lanes of a node record as components.
#pragma once

#include <geodrop/grid.hpp>
#include <geodrop/state.hpp>

// Kernel entries are compiled for x86-64-v4 (32 vector registers: no spills), x86-64-v3 (AVX2, FMA) and the baseline,
// chosen at load time; `flatten` inlines the templates below into each. Sanitizers do not get along with that choice.
#ifdef GEODROP_NO_CLONES
#define GEODROP_KERNEL
#else
#define GEODROP_KERNEL [[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default"), gnu::flatten]]
#endif

namespace geodrop {

inline constexpr int chunk_size = 64;

/// Quadratic B-spline: three nodes per axis, r = (x - x_base) / h in [-1/2, 1/2], base = nearest node.
struct Bspline2 {
  static constexpr int support = 3;
  /// C = inertia_inverse / h^2 sum N v (x_i - x_p)^T: the inertia of the weights is h^2 / 4 at every r.
  static constexpr double inertia_inverse = 4;

  static void weights(double r, double* w) {
    w[0] = 0.5 * (0.5 - r) * (0.5 - r);
    w[1] = 0.75 - r * r;
    w[2] = 0.5 * (0.5 + r) * (0.5 + r);
  }
  /// Times h: dN/dx.
  static void slopes(double r, double* g) {
    g[0] = r - 0.5;
    g[1] = -2 * r;
    g[2] = r + 0.5;
  }
};

/// Weights of a chunk. `first` is the flat index of the lowest node of the support, `reach` its distance from the
/// particle.
template <int Dim, class Basis>
struct ChunkWeights {
  alignas(64) std::int32_t first[chunk_size];
  alignas(64) double w[Dim][Basis::support][chunk_size];  ///< N [-]
  alignas(64) double g[Dim][Basis::support][chunk_size];  ///< dN/dx [1/m]
  alignas(64) double reach[Dim][chunk_size];              ///< x_first - x_p [m]
};

template <int Dim, class Basis>
void compute_weights(const GridLayout<Dim>& layout, const std::array<const double*, Dim>& x, int count,
                     ChunkWeights<Dim, Basis>& out) {
  constexpr double half = 0.5;
  for (int k = 0; k < count; ++k) out.first[k] = 0;
  for (int a = 0; a < Dim; ++a) {
    const double lower = layout.lower[a], inv_h = layout.inv_h, h = layout.h;
    const int stride = layout.stride[a];
    const double* const xa = x[a];
    auto& w = out.w[a];
    auto& g = out.g[a];
#pragma omp simd
    for (int k = 0; k < count; ++k) {
      const double xi = (xa[k] - lower) * inv_h;
      const double base = __builtin_floor(xi + half);
      const double r = xi - base;
      const double left = half - r, right = half + r;
      w[0][k] = half * left * left;
      w[1][k] = 0.75 - r * r;
      w[2][k] = half * right * right;
      g[0][k] = -left * inv_h;
      g[1][k] = -2 * r * inv_h;
      g[2][k] = right * inv_h;
      out.reach[a][k] = (-1 - r) * h;
      out.first[k] += (static_cast<std::int32_t>(base) + GridLayout<Dim>::pad - 1) * stride;
    }
  }
}

/// Offset from the lowest node of the support to the base node.
template <int Dim>
int base_offset(const GridLayout<Dim>& layout) {
  int offset = 0;
  for (int a = 0; a < Dim; ++a) offset += layout.stride[a];
  return offset;
}

/// Index of tensor component (a, b) in the stress order of types.hpp.
template <int Dim>
constexpr int stress_index(int a, int b) {
  if (a == b) return a;
  if constexpr (Dim == 2) return 3;
  return a + b == 1 ? 3 : a + b == 3 ? 4 : 5;
}

}  // namespace geodrop
