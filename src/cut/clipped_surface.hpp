// The cells that the triangles of a sharp membrane cut: what clipped_cells finds, and the integrals of splines over the
// surface in each cell.
//
// The surface in a cell is parted into flanks, which face one way: a thin body has two in a cell. A flank smaller than
// a quarter of a face joins the one around that is large enough and faces most nearly the same way: a corner of a cell
// pins no pressure down. Such a patch has one multiplier.
//
// All integrals are moments int u^a v^b w^c n dA of the pieces, a to 3, b and c to 2, from one quadrature that is exact
// for them: faces, shares and splines fit together to round-off. Pieces are made in parallel, triangle by triangle, and
// added up in parallel, cell by cell in the order of the triangles: same bits for any number of threads.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

namespace geodrop {

/// Renews box, shares, faces, pieces, flanks and patches.
void clip_surface(const GridLayout<3>& layout, const Membrane<3>& membrane, ClippedSurface& cells);

}  // namespace geodrop
