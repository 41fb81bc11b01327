// The nodes that a point sees, wherever it is: membrane nodes, tracers, particles that something pushes.
#pragma once

#include <geodrop/grid.hpp>

#include "../kernels/bases.hpp"

namespace geodrop {

/// Weights of the nine (27) nodes around a point, and the flat index of the lowest.
template <int Dim>
struct PointSupport {
  int first;
  std::array<std::array<double, 3>, Dim> w;

  /// `half_size`: half width of the point's domain for Basis::gimp [h]; hat functions are its limit.
  PointSupport(const GridLayout<Dim>& layout, const std::array<double, Dim>& x, double half_size) : first(0) {
    constexpr double to_the_limit = 1e-9;
    for (int a = 0; a < Dim; ++a) {
      const int base = layout.base(a, x[a]);
      const double r = (x[a] - layout.lower[a]) * layout.inv_h - base;
      const ThreeWeights n = layout.graded() ? GradedBspline2::at(layout.knots[a][base + GridLayout<Dim>::pad], x[a])
                             : layout.basis == Basis::bspline2 ? Bspline2::at(r, 0)
                             : layout.basis == Basis::gimp     ? Gimp::at(r, half_size)
                                                               : Gimp::at(r, to_the_limit);
      w[a] = {n.w0, n.w1, n.w2};
      first += (base + GridLayout<Dim>::pad - 1) * layout.stride[a];
    }
  }
  /// f(flat node, weight)
  template <class F>
  void for_each_node(const GridLayout<Dim>& layout, F&& f) const {
    for (int z = 0; z < (Dim == 3 ? 3 : 1); ++z)
      for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 3; ++x) {
          const double outer = w[1][y] * (Dim == 3 ? w[Dim - 1][z] : 1.0);
          f(first + x + y * layout.stride[1] + (Dim == 3 ? z * layout.stride[Dim - 1] : 0), w[0][x] * outer);
        }
  }
};

}  // namespace geodrop
