// The nodes that a point sees, wherever it is: membrane nodes, tracers, points of boundaries, particles that something
// pushes.
#pragma once

#include <geodrop/base/error.hpp>
#include <geodrop/grid/grid.hpp>

#include <fmt/core.h>

#include <string>

#include "bases.hpp"

namespace geodrop {

/// Along one axis: the node (on a graded grid: the knot span) that a coordinate belongs to, weights and slopes of that
/// node and its neighbours. On a graded grid slopes are per metre.
struct AxisSupport {
  int base;
  ThreeWeights n;
};

/// `half_size`: half width of the point's domain for Basis::gimp [h]; hat functions are its limit.
template <int Dim>
AxisSupport support_along(const GridLayout<Dim>& layout, int axis, double x, double half_size) {
  constexpr double to_the_limit = 1e-9;
  const int base = layout.base(axis, x);
  if (layout.graded()) return {base, GradedBspline2::at(layout.knots[axis][base + GridLayout<Dim>::pad], x)};
  const double r = (x - layout.lower[axis]) * layout.inv_h - base;
  if (layout.basis == Basis::bspline2) return {base, Bspline2::at(r, 0)};
  return {base, Gimp::at(r, layout.basis == Basis::gimp ? half_size : to_the_limit)};
}

/// Weights of the nine (27) nodes around a point, and the flat index of the lowest.
template <int Dim>
struct PointSupport {
  int first;
  std::array<std::array<double, 3>, Dim> w;

  PointSupport(const GridLayout<Dim>& layout, const std::array<double, Dim>& x, double half_size) : first(0) {
    for (int a = 0; a < Dim; ++a) {
      const auto [base, n] = support_along(layout, a, x[a], half_size);
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

/// Of a nodal field, at the point.
template <int Dim>
Vec4 interpolate(const GridLayout<Dim>& layout, const PointSupport<Dim>& support, const Array<Vec4>& field) {
  Vec4 sum{};
  support.for_each_node(layout, [&](int node, double weight) { sum += weight * field[node]; });
  return sum;
}

/// Entry k of positions that have an array for each coordinate.
template <std::size_t Dim>
std::array<double, Dim> place_at(const std::array<Array<double>, Dim>& x, std::size_t k) {
  std::array<double, Dim> place;
  for (std::size_t a = 0; a < Dim; ++a) place[a] = x[a][k];
  return place;
}

/// What moves with the grid must stay on it; throws RunError with its `kind` and `name`.
template <int Dim>
void check_on_grid(const GridLayout<Dim>& layout, const std::array<double, Dim>& x, const char* kind,
                   const std::string& name) {
  for (int a = 0; a < Dim; ++a) {
    if (x[a] >= layout.lower[a] && x[a] <= layout.upper[a]) continue;
    throw RunError(fmt::format("{} '{}' left the domain or is not finite (coordinate {} = {:g})", kind, name, a, x[a]));
  }
}

}  // namespace geodrop
