// Shape functions along one axis, as compile-time policies of the kernels; a basis is their product over the axes.
//
//   r = (x - x_base) / h, base = floor(xi + to_base), xi = (x - x_lower) / h; the support is the nodes
//   base - 1, base, base + 1 (support 3) or base, base + 1 (support 2); slopes are times h
#pragma once

#include <geodrop/grid/graded_axis.hpp>
#include <geodrop/scene/numerics.hpp>

#include <type_traits>

namespace geodrop {

struct ThreeWeights {
  double w0, w1, w2;  ///< N [-]
  double g0, g1, g2;  ///< h dN/dx [-]
};
struct TwoWeights {
  double w0, w1;
  double g0, g1;
};

/// Quadratic B-spline (Steffen, Kirby & Berzins 2008): base = nearest node, r in [-1/2, 1/2].
struct Bspline2 {
  static constexpr Basis name = Basis::bspline2;
  static constexpr int support = 3;
  static constexpr double to_base = 0.5;

  static ThreeWeights at(double r, double) {
    const double left = 0.5 - r, right = 0.5 + r;
    return {0.5 * left * left, 0.75 - r * r, 0.5 * right * right, -left, -2 * r, right};
  }
};

/// The same on knots of unlike distance: base = the span that holds the particle; slopes are per metre.
struct GradedBspline2 {
  static constexpr Basis name = Basis::bspline2;
  static constexpr int support = 3;

  static ThreeWeights at(const KnotSpan& span, double x) {
    const double right = x - span.left, left = span.width - right;
    const double per_width = 1 / span.width;
    const double g0 = -left * per_width / span.gap_below, g2 = right * per_width / span.gap_above;
    const double w0 = -0.5 * left * g0, w2 = 0.5 * right * g2;
    return {w0, 1 - w0 - w2, w2, g0, -g0 - g2, g2};
  }
};

/// uGIMP (Bardenhagen & Kober 2004): the hat function averaged over a particle domain of fixed half width l <= 1/2 [h],
/// base = nearest node. l = 1/2 is the quadratic B-spline, l -> 0 the hat function.
struct Gimp {
  static constexpr Basis name = Basis::gimp;
  static constexpr int support = 3;
  static constexpr double to_base = 0.5;

  static ThreeWeights at(double r, double l) {
    const double inside = r < -l ? -l : (r > l ? l : r), beyond = r - inside;
    const double left = l - inside, right = l + inside, per_width = 0.5 / l;
    const double w0 = 0.5 * left * left * per_width - (beyond < 0 ? beyond : 0.0);
    const double w2 = 0.5 * right * right * per_width + (beyond > 0 ? beyond : 0.0);
    const double g0 = -left * per_width, g2 = right * per_width;
    return {w0, 1 - w0 - w2, w2, g0, -g0 - g2, g2};
  }
};

/// Hat functions of the cell that holds the particle: base = its lower node, r in [0, 1).
struct Linear {
  static constexpr Basis name = Basis::linear;
  static constexpr int support = 2;
  static constexpr double to_base = 0;

  static TwoWeights at(double r, double) { return {1 - r, r, -1, 1}; }
};

/// Linear simplices, the paper's element: cells split regularly along their main diagonal into two triangles (tri3) or
/// six tetrahedra (tet4). Not a product over the axes: see simplex.hpp.
struct Simplex {};

template <class Policy>
inline constexpr bool is_graded = std::is_same_v<Policy, GradedBspline2>;

/// Simplices have no affine transfer: a particle would repeat the velocity of its element exactly, and nothing would
/// damp nearly empty nodes (the jittered column blew up after 139 steps). They have MUSL only.
template <class Policy>
inline constexpr bool has_affine = !std::is_same_v<Policy, Simplex>;

}  // namespace geodrop
