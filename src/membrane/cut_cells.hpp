// The cells that a closed polygon cuts, exactly: how much of each lies inside, which part of each face does, and which
// pieces of the polygon's edges lie in it.
//
// By Green's theorem a piece of an edge adds what lies to its left: a part of its own cell and whole cells further
// left, each by the height of the piece. So renderers of fonts sum up the coverage of pixels. One visit for each piece
// of an edge and for each cell; no case of how an outline may cross a cell is told apart.
#pragma once

#include <geodrop/grid.hpp>

namespace geodrop {

/// Renews box, area, faces and pieces for the polygon with corners x, y [m], in either sense.
void cut_cells(const GridLayout<2>& layout, const Array<double>& x, const Array<double>& y, CutCells& cells);

/// int N over the part of a face inside, for the three nodes along it; N of the quadratic spline [h].
inline std::array<double, 3> face_integrals(const FaceMoments& m) {
  return {0.125 * m[0] - 0.5 * m[1] + 0.5 * m[2], 0.75 * m[0] - m[2], 0.125 * m[0] + 0.5 * m[1] + 0.5 * m[2]};
}

}  // namespace geodrop
