#include "cell_parts.hpp"

#include "cell_slopes.hpp"
#include "clipped_cells.hpp"
#include "clipped_surface.hpp"
#include "cut_cells.hpp"
#include "outline_pieces.hpp"

namespace geodrop {

void cut(const GridLayout<2>& layout, const Membrane<2>& membrane, CutCells& cells) {
  cut_cells(layout, membrane.x[0], membrane.x[1], cells);
}
void cut(const GridLayout<3>& layout, const Membrane<3>& membrane, ClippedSurface& cells) {
  clip_surface(layout, membrane, cells);
}

std::vector<CutCell<2>> cut_cells_of(const Grid<2>& grid, const Membrane<2>& membrane) {
  const CutCells& cells = grid.outline;
  std::vector<int> place(cells.size(), -1);
  std::vector<CutCell<2>> cut;
  for (const CutCells::Piece& piece : cells.pieces) {
    if (place[piece.cell] < 0) {
      place[piece.cell] = static_cast<int>(cut.size());
      const int flat = flat_of(grid.layout, cells, piece.cell);
      const CellSpans<2> spans = spans_of(grid.layout, flat);
      cut.push_back({flat, faces_of(cells, piece.cell, spans), beside_right_face(cells, piece.cell, spans), {}});
    }
    CutCell<2>& cell = cut[place[piece.cell]];
    const PieceIntegral integral = integrate_piece(grid.layout, membrane, cells, piece);
    for (int n = 0; n < 9; ++n) cell.value[n] += integral.beside[n] * integral.normal[0];
    for (int a = 0; a < 2; ++a) {
      cell.normal[a] += integral.normal[a];
      for (int n = 0; n < 9; ++n) cell.inside[n][a] += integral.mean[n] * integral.normal[a];
    }
  }
  return cut;
}

std::vector<CutCell<3>> cut_cells_of(const Grid<3>& grid, const Membrane<3>&) {
  const ClippedSurface& cells = grid.outline;
  const double h = grid.layout.h, h2 = h * h, h3 = h2 * h;
  std::vector<int> place(cells.size(), -1);
  std::vector<CutCell<3>> cut;
  for (const ClippedSurface::Flank& flank : cells.flanks) {
    if (place[flank.cell] < 0) {
      place[flank.cell] = static_cast<int>(cut.size());
      const int flat = flat_of(grid.layout, cells, flank.cell);
      const CellSpans<3> spans = spans_of(grid.layout, flat);
      cut.push_back({flat, faces_of(cells, flank.cell, spans), beside_right_face(cells, flank.cell, spans), {}});
    }
    CutCell<3>& cell = cut[place[flank.cell]];
    for (int n = 0; n < 27; ++n) {
      cell.value[n] += h3 * flank.beside[n];
      for (int a = 0; a < 3; ++a) cell.inside[n][a] += h2 * flank.spline[n][a];
    }
    for (int a = 0; a < 3; ++a) cell.normal[a] += h2 * flank.normal[a];
  }
  return cut;
}

}  // namespace geodrop
