// Particles are worked on in chunks that fit the first-level cache: weights and material laws several particles
// wide, transfers one particle at a time with the lanes of a node record as components.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

#include <type_traits>

#include "base/levels.hpp"
#include "grid/bases.hpp"

// Valgrind 3.19 does not know the store form of vmovq between registers, which the assembler prefers for being a byte
// shorter, and ends the program. An instruction macro asks for the load form.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
asm(".macro vmovq operands:vararg\n\t{load} vmovq \\operands\n.endm");
#endif

namespace geodrop {

inline constexpr int chunk_size = 64;

/// Where the components of a field of particles, from particle p on, are stored.
template <std::size_t Dim>
std::array<const double*, Dim> pointers(const std::array<Array<double>, Dim>& field, std::size_t p = 0) {
  std::array<const double*, Dim> out;
  for (std::size_t a = 0; a < Dim; ++a) out[a] = field[a].data() + p;
  return out;
}

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
void compute_product_weights(const GridLayout<Dim>& layout, const std::array<const double*, Dim>& x, double half_size,
                             int count, ChunkWeights<Dim, Basis>& out) {
  constexpr int below = Basis::support - 2;  // the lowest node of the support lies that far below the base
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
      const double base = __builtin_floor(xi + Basis::to_base);
      const double r = xi - base;
      const auto n = Basis::at(r, half_size);
      w[0][k] = n.w0;
      w[1][k] = n.w1;
      g[0][k] = n.g0 * inv_h;
      g[1][k] = n.g1 * inv_h;
      if constexpr (Basis::support == 3) {
        w[2][k] = n.w2;
        g[2][k] = n.g2 * inv_h;
      }
      out.reach[a][k] = (-below - r) * h;
      out.first[k] += (static_cast<std::int32_t>(base) + GridLayout<Dim>::pad - below) * stride;
    }
  }
}

/// As the general ChunkWeights; nodes are not h apart.
template <int Dim>
struct ChunkWeights<Dim, GradedBspline2> {
  alignas(64) std::int32_t first[chunk_size];
  alignas(64) double w[Dim][3][chunk_size];    ///< N [-]
  alignas(64) double g[Dim][3][chunk_size];    ///< dN/dx [1/m]
  alignas(64) double reach[Dim][chunk_size];   ///< x_first - x_p [m]
  alignas(64) KnotSpan span[Dim][chunk_size];  ///< that holds the particle
};

/// The spans of particles at x, copied whole: compilers would otherwise gather number by number (a step in 2D: 48 ns
/// instead of 42). `first` moves on by the span of each particle.
inline void find_spans(const KnotTable& knots, const double* x, int stride, int count, std::int32_t* first,
                       KnotSpan* spans) {
  for (int k = 0; k < count; ++k) {
    const int s = knots.find_inside(x[k]);
    first[k] += (s - 1) * stride;
    spans[k] = knots[s];
  }
}

template <int Dim>
void compute_graded_weights(const GridLayout<Dim>& layout, const std::array<const double*, Dim>& x, int count,
                            ChunkWeights<Dim, GradedBspline2>& out) {
  for (int k = 0; k < count; ++k) out.first[k] = 0;
  for (int a = 0; a < Dim; ++a) {
    const double* const xa = x[a];
    find_spans(layout.knots[a], xa, layout.stride[a], count, out.first, out.span[a]);
    auto& w = out.w[a];
    auto& g = out.g[a];
#pragma omp simd
    for (int k = 0; k < count; ++k) {
      const KnotSpan& span = out.span[a][k];
      const ThreeWeights n = GradedBspline2::at(span, xa[k]);
      w[0][k] = n.w0;
      w[1][k] = n.w1;
      w[2][k] = n.w2;
      g[0][k] = n.g0;
      g[1][k] = n.g1;
      g[2][k] = n.g2;
      out.reach[a][k] = span.left + 0.5 * span.width - span.gap_below - xa[k];
    }
  }
}

/// Node i of the support along an axis, seen from the lowest one [h; graded: m].
template <int Dim, class Basis>
double node_offset(const ChunkWeights<Dim, Basis>& weights, int axis, int i, int k) {
  if constexpr (is_graded<Basis>)
    return i == 0 ? 0.0 : weights.span[axis][k].gap_below + (i == 2 ? weights.span[axis][k].gap_above : 0.0);
  else
    return i;
}

/// Nodes along the path from the lowest corner of the cell to the highest, with one axis at a time.
template <int Dim>
struct ChunkWeights<Dim, Simplex> {
  alignas(64) std::int32_t node[Dim + 1][chunk_size];
  alignas(64) std::int32_t axis[Dim][chunk_size];  ///< from node n to node n + 1
  alignas(64) double w[Dim + 1][chunk_size];       ///< N [-]
  alignas(64) double reach[Dim][chunk_size];       ///< x of node 0 - x_p [m]
};

template <int Dim>
void compute_simplex_weights(const GridLayout<Dim>& layout, const std::array<const double*, Dim>& x, int count,
                             ChunkWeights<Dim, Simplex>& out) {
  for (int k = 0; k < count; ++k) {
    double f[Dim];
    int axis[Dim], node = 0;
    for (int a = 0; a < Dim; ++a) {
      const double xi = (x[a][k] - layout.lower[a]) * layout.inv_h, base = __builtin_floor(xi);
      node += (static_cast<std::int32_t>(base) + GridLayout<Dim>::pad) * layout.stride[a];
      f[a] = xi - base;
      axis[a] = a;
      out.reach[a][k] = -f[a] * layout.h;
    }
    const auto order = [&](int i, int j) {
      const bool swap = f[j] > f[i];
      const double high = swap ? f[j] : f[i], low = swap ? f[i] : f[j];
      const int first = swap ? axis[j] : axis[i], second = swap ? axis[i] : axis[j];
      f[i] = high, f[j] = low, axis[i] = first, axis[j] = second;
    };
    order(0, 1);
    if constexpr (Dim == 3) {
      order(1, 2);
      order(0, 1);
    }
    for (int n = 0; n <= Dim; ++n) {
      out.node[n][k] = node;
      out.w[n][k] = (n == 0 ? 1 : f[n - 1]) - (n == Dim ? 0 : f[n]);
      if (n == Dim) break;
      out.axis[n][k] = axis[n];
      node += layout.stride[axis[n]];
    }
  }
}

/// Weights of `count` particles at x; `half_size` is half the width of a particle's domain (only GIMP asks) [h].
template <int Dim, class Basis>
void compute_weights(const GridLayout<Dim>& layout, const std::type_identity_t<std::array<const double*, Dim>>& x,
                     double half_size, int count, ChunkWeights<Dim, Basis>& out) {
  if constexpr (std::is_same_v<Basis, Simplex>)
    compute_simplex_weights<Dim>(layout, x, count, out);
  else if constexpr (is_graded<Basis>)
    compute_graded_weights<Dim>(layout, x, count, out);
  else
    compute_product_weights<Dim, Basis>(layout, x, half_size, count, out);
}

/// Pressure cell (nearest node) of particle k of a chunk.
template <int Dim, class Basis>
int pressure_cell(const GridLayout<Dim>& layout, const ChunkWeights<Dim, Basis>& weights, int k) {
  if constexpr (std::is_same_v<Basis, Simplex>) {
    int cell = weights.node[0][k];
    for (int a = 0; a < Dim; ++a) cell += weights.reach[a][k] <= -0.5 * layout.h ? layout.stride[a] : 0;
    return cell;
  } else {
    int cell = weights.first[k];
    for (int a = 0; a < Dim; ++a) cell += layout.stride[a] * (Basis::support == 3 || weights.w[a][1][k] >= 0.5 ? 1 : 0);
    return cell;
  }
}

/// Index of tensor component (a, b) in the stress order of types.hpp.
template <int Dim>
constexpr int stress_index(int a, int b) {
  if (a == b) return a;
  if constexpr (Dim == 2) return 3;
  return a + b == 1 ? 3 : a + b == 3 ? 4 : 5;
}

}  // namespace geodrop
