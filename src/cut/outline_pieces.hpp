// Integrals over the pieces of an outline, each within one cell.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

#include <array>
#include <cmath>

#include "cells_around.hpp"
#include "cut_cells.hpp"
#include "geometry/polygon.hpp"
#include "grid/bases.hpp"

namespace geodrop {

/// int N of the nodes below, at and above a span, from its lower end to z [its width]; z from -1/2 to 1/2.
inline std::array<double, 3> integrals_to(const SpanShape& span, double z) {
  const double to_end = 0.5 - z, from_start = 0.5 + z;
  const double first = span.below * (1 - to_end * to_end * to_end) / 3;
  const double last = span.above * from_start * from_start * from_start / 3;
  return {first, from_start - first - last, last};  // the three N add up to one
}

struct PieceIntegral {
  std::array<double, 9> mean{};    ///< of N of the 3 x 3 nodes around the cell, x fastest [-]
  std::array<double, 9> beside{};  ///< of the integral of N along x from the cell's left face to the piece [m]
  std::array<double, 2> normal{};  ///< outward, as long as the piece [m]
};

/// The splines of an axis on the knot span of a stored node, at a place in it.
inline ThreeWeights weights_in(const GridLayout<2>& layout, int axis, int stored_node, double x) {
  if (layout.graded()) return GradedBspline2::at(layout.knots[axis][stored_node], x);
  return Bspline2::at((x - layout.node(axis, stored_node - GridLayout<2>::pad)) * layout.inv_h, 0);
}

/// A place in the knot span of a stored node, from -1/2 to 1/2.
inline double place_in(const GridLayout<2>& layout, int axis, int stored_node, double x) {
  if (!layout.graded()) return (x - layout.node(axis, stored_node - GridLayout<2>::pad)) * layout.inv_h;
  const KnotSpan& span = layout.knots[axis][stored_node];
  return (x - span.left) / span.width - 0.5;
}

/// Three Gauss points are exact: N is of degree four along a straight line, its integral along x of degree five.
inline PieceIntegral integrate_piece(const GridLayout<2>& layout, const Membrane<2>& membrane, const CutCells& cells,
                                     const CutCells::Piece& piece) {
  const auto& [x, y] = membrane.x;
  const std::size_t from = piece.edge, to = end_of_edge(from, membrane.nodes());
  const double dx = x[to] - x[from], dy = y[to] - y[from], part = piece.to - piece.from;
  const int column = cells.first[0] + piece.cell % cells.count[0];
  const int row = cells.first[1] + piece.cell / cells.count[0];
  const SpanShape across = layout.span_shape(0, column);
  PieceIntegral out;
  out.normal = {cells.sense * part * dy, -cells.sense * part * dx};
  constexpr double offset[] = {-0.7745966692414834, 0, 0.7745966692414834}, weight[] = {5.0 / 18, 4.0 / 9, 5.0 / 18};
  for (int g = 0; g < 3; ++g) {
    const double share = piece.from + 0.5 * (1 + offset[g]) * part;
    const ThreeWeights u = weights_in(layout, 0, column, x[from] + share * dx);
    const ThreeWeights v = weights_in(layout, 1, row, y[from] + share * dy);
    const std::array<double, 3> left = integrals_to(across, place_in(layout, 0, column, x[from] + share * dx));
    const double along_x[] = {u.w0, u.w1, u.w2}, along_y[] = {v.w0, v.w1, v.w2};
    for (int n = 0; n < 9; ++n) {
      out.mean[n] += weight[g] * along_x[n % 3] * along_y[n / 3];
      out.beside[n] += weight[g] * across.width * left[n % 3] * along_y[n / 3];
    }
  }
  return out;
}

}  // namespace geodrop
