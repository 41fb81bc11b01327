// The stretches of sharp membranes: parts about a cell long or large, with something beside them, and their normals.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "grid/node_vectors.hpp"

namespace geodrop {

/// A part of an outline with one traction: consecutive pieces, [first, last) in CutCells::pieces, round its end; in
/// space consecutive flanks, [first, last) in ClippedSurface::flanks.
struct Stretch {
  std::size_t first = 0, count = 0;
  double size = 0;  ///< length or area [m, m2]
  bool wet = true;  ///< see wet_cells; else other bodies touch the membrane there, or nothing
};

/// The stretches of an outline: the wet ones, and the dry ones where water in the pores inside has to be held. Two
/// flanks in one cell are two stretches.
std::vector<Stretch> stretches_of(const Grid<2>& around, const Membrane<2>& membrane, const CutCells& cells);
std::vector<Stretch> stretches_of(const Grid<3>& around, const Membrane<3>& membrane, const ClippedSurface& cells);

/// f(piece) for the pieces of a stretch.
template <class F>
void for_each_piece(const CutCells& cells, const Stretch& stretch, F&& f) {
  for (std::size_t k = 0; k < stretch.count; ++k) f(cells.pieces[(stretch.first + k) % cells.pieces.size()]);
}
template <class F>
void for_each_piece(const ClippedSurface& cells, const Stretch& stretch, F&& f) {
  for (std::size_t k = stretch.first; k < stretch.first + stretch.count; ++k) {
    const ClippedSurface::Flank& flank = cells.flanks[k];
    for (std::uint32_t p = 0; p < flank.pieces; ++p) f(cells.pieces[flank.first_piece + p]);
  }
}

/// The segment or triangle that a piece is of, and which share of it that is [-].
inline std::pair<std::size_t, double> share_of(const CutCells::Piece& piece) {
  return {piece.edge, piece.to - piece.from};
}
inline std::pair<std::size_t, double> share_of(const ClippedCells::Piece& piece) {
  return {piece.triangle, piece.share[0] + piece.share[1] + piece.share[2]};
}

/// f(segment or triangle, share of it) for the pieces of a stretch.
template <class Cells, class F>
void for_each_share(const Cells& cells, const Stretch& stretch, F&& f) {
  for_each_piece(cells, stretch, [&](const auto& piece) {
    const auto [part, share] = share_of(piece);
    f(part, share);
  });
}

/// f(local cell) for each piece of a stretch; in space for each flank.
template <class F>
void for_each_cell_of(const CutCells& cells, const Stretch& stretch, F&& f) {
  for_each_piece(cells, stretch, [&](const CutCells::Piece& piece) { f(piece.cell); });
}
template <class F>
void for_each_cell_of(const ClippedSurface& cells, const Stretch& stretch, F&& f) {
  for (std::size_t k = stretch.first; k < stretch.first + stretch.count; ++k) f(cells.flanks[k].cell);
}

/// Length of a piece [m].
double length_of(const Membrane<2>& membrane, const CutCells::Piece& piece);

/// The same over the width of its cell; where that is not the same along both axes, in grid coordinates [cells].
double cells_along(const GridLayout<2>& layout, const Membrane<2>& membrane, const CutCells& cells,
                   const CutCells::Piece& piece);

/// int N n dl over a stretch, n the outward normal.
std::vector<NodeVector<2>> normals_over(const GridLayout<2>& layout, const Membrane<2>& membrane, const CutCells& cells,
                                        const Stretch& stretch);
/// int N n dA over a stretch.
std::vector<NodeVector<3>> normals_over(const GridLayout<3>& layout, const ClippedSurface& cells,
                                        const Stretch& stretch);

}  // namespace geodrop
