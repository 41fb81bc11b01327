// Cells of the domain that a sharp membrane does not cut, on one side of it.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

#include <vector>

#include "cells_around.hpp"
#include "clipped_cells.hpp"
#include "cut_cells.hpp"
#include "wet_cells.hpp"

namespace geodrop {

/// The local cell of each piece of an outline, or of each flank of a surface.
template <class F>
void for_each_cut_cell(const CutCells& cells, F&& f) {
  for (const CutCells::Piece& piece : cells.pieces) f(piece.cell);
}
template <class F>
void for_each_cut_cell(const ClippedSurface& cells, F&& f) {
  for (const ClippedSurface::Flank& flank : cells.flanks) f(flank.cell);
}

/// Whether all cells of a box are cells of the domain.
template <int Dim>
bool within_domain(const GridLayout<Dim>& layout, const Outline<Dim>& cells) {
  bool within = true;
  for (int a = 0; a < Dim; ++a)
    within =
        within && cells.first[a] >= layout.pad && cells.first[a] + cells.count[a] <= layout.pad + layout.cells[a] + 1;
  return within;
}

/// f(flat) for the cells of the domain that an outline does not cut and that lie inside, or else outside.
template <int Dim, class F>
void for_each_uncut(const GridLayout<Dim>& layout, const Outline<Dim>& cells, bool inside, F&& f) {
  const bool within = within_domain<Dim>(layout, cells);
  std::vector<bool> cut(cells.size(), false);
  for_each_cut_cell(cells, [&](int cell) { cut[cell] = true; });
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (cut[c] || (inside_of(cells)[c] > 0.5) != inside) continue;
    const int flat = flat_of(layout, cells, static_cast<int>(c));
    if (within || in_domain(layout, flat)) f(flat);
  }
}

/// The field inside a sharp membrane whose cells have its pressure: that of the water, if water flows in the pores.
template <int Dim>
Grid<Dim>& pressed_field(const Membrane<Dim>& membrane, Grids<Dim>& grids) {
  const int water = grids[membrane.field].pore_water;
  return grids[water < 0 ? membrane.field : water];
}

}  // namespace geodrop
