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

namespace {

/// Adds what the half of a cell beyond a wall mirrors.
void add_images(const GridLayout<3>& layout, int flat, SplineVolumes<3>& value) {
  const std::array<int, 3> place = stored_cell(layout, flat);
  if (far_from_walls<3>(layout, 1, place)) return;
  constexpr std::array<int, 3> step{1, 3, 9};
  for (std::size_t a = 0; a < 3; ++a) {
    if (!on_wall(layout, static_cast<int>(a), place[a])) continue;
    const SplineVolumes<3> half = value;
    for (int n = 0; n < 27; ++n) value[n] += half[n + step[a] * (2 - 2 * (n / step[a] % 3))];
  }
}

}  // namespace

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
      const CellSpans<3> spans = spans_in_domain(grid.layout, flat);
      cut.push_back({flat, faces_of(cells, flank.cell, spans), beside_right_face(cells, flank.cell, spans), {}});
    }
    CutCell<3>& cell = cut[place[flank.cell]];
    for (int n = 0; n < 27; ++n) {
      cell.value[n] += h3 * flank.beside[n];
      for (int a = 0; a < 3; ++a) cell.inside[n][a] += h2 * flank.spline[n][a];
    }
    for (int a = 0; a < 3; ++a) cell.normal[a] += h2 * flank.normal[a];
  }
  for (CutCell<3>& cell : cut) {
    fold_at_walls(grid.layout, cell.flat, cell.inside);
    add_images(grid.layout, cell.flat, cell.value);
  }
  return cut;
}

}  // namespace geodrop
