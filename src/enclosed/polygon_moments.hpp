// Exact moments of a closed polygon over the knot-span cells that it covers: how much of each cell lies inside, and the
// integrals of the splines over that part. A cell centred on node i has the local coordinates xi = (x - x_i) / h and
// eta, both from -1/2 to 1/2; its moments are
//
//   m_ab = int xi^a eta^b d(xi) d(eta) over the part inside,   a, b = 0..2
//
// By Green's theorem a piece of an edge adds, per unit of height, all that lies to its left: part of its own cell and
// whole cells further left (as scanline renderers of fonts sum up the coverage of pixels). Cost: one visit for each
// piece of an edge and one for each cell.
#pragma once

#include <geodrop/grid.hpp>

namespace geodrop {

/// Renews the box of cells and their moments for the polygon with corners x, y [m], in either sense; the box has a
/// margin of one cell.
void cover_polygon(const GridLayout<2>& layout, const Array<double>& x, const Array<double>& y, EnclosedCells& cells);

/// int grad N over the part of a cell inside, for the nodes around it [m]: entry 3 j + i is that of the node at offset
/// (i - 1, j - 1).
using CellGradients = std::array<std::array<double, 2>, 9>;
CellGradients gradient_integrals(const CellMoments& moments, double h);

}  // namespace geodrop
