// The cells that a closed surface of triangles cuts, exactly: how much of each lies inside, which part of each face
// does, and which pieces of the triangles lie in it.
//
// The sister of cut_cells by the divergence theorem: triangles are split at the planes of the grid; a piece adds its
// own part to its cell, and the moments of its projection to all faces that lie below it along each axis. No case of
// how a surface may cross a cell is told apart, and what it cuts twice is counted by winding number.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

namespace geodrop {

/// Renews box, shares, faces and pieces for the triangles of a membrane.
void clip_cells(const GridLayout<3>& layout, const Membrane<3>& membrane, ClippedCells& cells);

/// The local cell of the box that a point is in, -1 outside of the box.
inline int local_cell(const GridLayout<3>& layout, const ClippedCells& cells, const Vec<3>& x) {
  int cell = 0;
  for (int a = 2; a >= 0; --a) {
    const int i = layout.base(a, x[a]) + GridLayout<3>::pad - cells.first[a];
    if (i < 0 || i >= cells.count[a]) return -1;
    cell = cell * cells.count[a] + i;
  }
  return cell;
}

/// Flat index of a local cell.
inline int flat_of(const GridLayout<3>& layout, const ClippedCells& cells, int cell) {
  const int i = cell % cells.count[0], j = cell / cells.count[0] % cells.count[1];
  const int k = cell / (cells.count[0] * cells.count[1]);
  return cells.first[0] + i + (cells.first[1] + j) * layout.stride[1] + (cells.first[2] + k) * layout.stride[2];
}

/// The local cell at n of the 27 around one that the surface cuts, x fastest; all are in the box.
inline int local_around(const ClippedCells& cells, int cell, int n) {
  return cell + n % 3 - 1 + cells.count[0] * (n / 3 % 3 - 1 + cells.count[1] * (n / 9 - 1));
}

/// Coefficients of 1, z, z^2 of the splines of the nodes below, at and above a span; z from -1/2 to 1/2 of its part.
using SplinePowers = std::array<std::array<double, 3>, 3>;
inline SplinePowers spline_powers(const SpanShape& span) {
  const double below = span.below, above = span.above;
  SplinePowers powers{{{0.25 * below, -below, below},
                       {1 - 0.25 * (below + above), below - above, -(below + above)},
                       {0.25 * above, above, above}}};
  if (span.part == SpanShape::Part::whole) return powers;
  const double middle = span.part == SpanShape::Part::upper_half ? 0.25 : -0.25;
  for (auto& [constant, linear, square] : powers) {
    constant += middle * linear + middle * middle * square;
    linear = 0.5 * linear + middle * square;
    square *= 0.25;
  }
  return powers;
}

/// int N of the nodes below, at and above over a span or its part [its width].
inline std::array<double, 3> means_over(const SpanShape& span) {
  if (span.part == SpanShape::Part::whole) return span.values();
  const SplinePowers powers = spline_powers(span);
  std::array<double, 3> means;
  for (std::size_t n = 0; n < 3; ++n) means[n] = powers[n][0] + powers[n][2] / 12;
  return means;
}

/// int N over the part of a face inside, for the 3 x 3 nodes along its two axes, which follow the face's own
/// cyclically, first axis fastest [its area].
std::array<double, 9> face_integrals(const ClippedCells::FaceMoments& moments, const SpanShape& along_u = {.width = 1},
                                     const SpanShape& along_w = {.width = 1});

}  // namespace geodrop
