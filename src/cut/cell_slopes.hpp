// int grad N and int N over a cell and over the part of it that an outline cuts off, on knot spans of any width.
#pragma once

#include <geodrop/grid/grid.hpp>

#include <array>

#include "cut_cells.hpp"
#include "outline_pieces.hpp"

namespace geodrop {

/// Of the 3 x 3 nodes around a cell, x fastest [m].
using Slope = std::array<std::array<double, 2>, 9>;

/// The knot spans of a cell along x and y.
using CellSpans = std::array<SpanShape, 2>;

inline CellSpans spans_of(const GridLayout<2>& layout, int flat) {
  return {span_of(layout, 0, flat), span_of(layout, 1, flat)};
}

inline Slope whole_cell(const CellSpans& cell) {
  const auto [x_span, y_span] = cell;
  const std::array<double, 3> value_x = x_span.values(), slope_x = x_span.slopes();
  const std::array<double, 3> value_y = y_span.values(), slope_y = y_span.slopes();
  Slope whole;
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 3; ++x)
      whole[x + 3 * y] = {y_span.width * slope_x[x] * value_y[y], x_span.width * value_x[x] * slope_y[y]};
  return whole;
}

/// Adds int N n over the part of a face inside; the face is on the side `side` (0 below, 1 above) of the cell.
inline void add_face(const FaceMoments& moments, int axis, int side, const CellSpans& cell, Slope& slope) {
  const SpanShape &across = cell[axis], &face = cell[1 - axis];
  const std::array<double, 3> along = face_integrals(moments, face.below, face.above);
  const double sign = side == 1 ? 1 : -1, beyond = side == 1 ? across.above : across.below;
  for (int n = 0; n < 3; ++n)
    for (const int k : {side, side + 1}) {
      const int node = axis == 0 ? k + 3 * n : n + 3 * k;
      slope[node][axis] += sign * (k == 1 ? 1 - beyond : beyond) * face.width * along[n];
    }
}

/// a_ic of a cut cell without what the membrane adds.
inline Slope faces_of(const CutCells& cells, int c, const CellSpans& cell) {
  Slope slope{};
  add_face(cells.right_face[c], 0, 1, cell, slope);
  add_face(cells.right_face[c - 1], 0, 0, cell, slope);
  add_face(cells.top_face[c], 1, 1, cell, slope);
  add_face(cells.top_face[c - cells.count[0]], 1, 0, cell, slope);
  return slope;
}

/// int N over a cell [m2].
inline std::array<double, 9> whole_value(const CellSpans& cell) {
  const std::array<double, 3> x = cell[0].values(), y = cell[1].values();
  std::array<double, 9> value;
  for (int n = 0; n < 9; ++n) value[n] = cell[0].width * x[n % 3] * cell[1].width * y[n / 3];
  return value;
}

/// int N over the part of a cell inside without what the membrane adds, by Green's theorem [m2].
inline std::array<double, 9> beside_right_face(const CutCells& cells, int c, const CellSpans& cell) {
  const std::array<double, 3> x = cell[0].values();
  const std::array<double, 3> along = face_integrals(cells.right_face[c], cell[1].below, cell[1].above);
  std::array<double, 9> value;
  for (int n = 0; n < 9; ++n) value[n] = cell[0].width * x[n % 3] * cell[1].width * along[n / 3];
  return value;
}

}  // namespace geodrop
