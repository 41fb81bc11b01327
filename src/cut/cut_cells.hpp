// The cells that a closed polygon cuts, exactly: how much of each lies inside, which part of each face does, and which
// pieces of the polygon's edges lie in it.
//
// By Green's theorem a piece of an edge adds what lies to its left: a part of its own cell and whole cells further
// left, each by the height of the piece. So renderers of fonts sum up the coverage of pixels. One visit for each piece
// of an edge and for each cell; no case of how an outline may cross a cell is told apart.
#pragma once

#include <geodrop/grid/grid.hpp>

namespace geodrop {

/// Renews box, area, faces and pieces for the polygon with corners x, y [m], in either sense.
void cut_cells(const GridLayout<2>& layout, const Array<double>& x, const Array<double>& y, CutCells& cells);

/// The local cell of the box that a point is in, -1 outside of the box.
inline int local_cell(const GridLayout<2>& layout, const CutCells& cells, double x, double y) {
  const int i = layout.base(0, x) + GridLayout<2>::pad - cells.first[0];
  const int j = layout.base(1, y) + GridLayout<2>::pad - cells.first[1];
  return i >= 0 && j >= 0 && i < cells.count[0] && j < cells.count[1] ? i + j * cells.count[0] : -1;
}

inline int local_cell(const GridLayout<2>& layout, const CutCells& cells, const Vec<2>& x) {
  return local_cell(layout, cells, x[0], x[1]);
}

/// The local cell at n of the 3 x 3 around one that the outline cuts, x fastest; all are in the box.
inline int local_around(const CutCells& cells, int cell, int n) {
  return cell + n % 3 - 1 + (n / 3 - 1) * cells.count[0];
}

/// Flat index of a local cell.
inline int flat_of(const GridLayout<2>& layout, const CutCells& cells, int cell) {
  return cells.first[0] + cell % cells.count[0] + (cells.first[1] + cell / cells.count[0]) * layout.stride[1];
}

/// int N over the part of a face inside, for the three nodes along it; N of the quadratic spline on the span that the
/// face is [its length].
inline std::array<double, 3> face_integrals(const FaceMoments& m, double below = 0.5, double above = 0.5) {
  return {below * (0.25 * m[0] - m[1] + m[2]),
          (1 - (below + above) / 4) * m[0] + (below - above) * m[1] - (below + above) * m[2],
          above * (0.25 * m[0] + m[1] + m[2])};
}

}  // namespace geodrop
