// Where a sharp membrane has something beside it.
#pragma once

#include <geodrop/grid/grid.hpp>

#include "cells_around.hpp"

namespace geodrop {

/// Whether a cell is one of the domain, no image of one.
template <int Dim>
bool in_domain(const GridLayout<Dim>& layout, int cell) {
  const std::array<int, Dim> place = stored_cell(layout, cell);
  for (int a = 0; a < Dim; ++a)
    if (place[a] < layout.pad || place[a] > layout.pad + layout.cells[a]) return false;
  return true;
}

/// Whether what is around a membrane fills half of the room that bodies leave in a cell and its neighbours. The cell's
/// own part may be too small to hold a particle, and a neighbour alone may be full of water that a wall keeps away.
/// Where bodies leave less than a tenth of all of them, they touch: a lone particle in such a film takes up the
/// pressures of both sides.
template <int Dim>
bool is_wet(const Grid<Dim>& around, int flat) {
  constexpr double wet_share = 0.5, least_room = 0.1;
  double room = 0, filled = 0, whole = 0;
  for (int n = 0; n < nodes_around<Dim>; ++n) {
    const int other = node_around(around.layout, flat, n);
    if (!in_domain(around.layout, other)) continue;
    whole += size_in_domain(around.layout, other);
    room += (1 - taken_of(around, other)) * size_in_domain(around.layout, other);
    filled += around.cell_volume[other];
  }
  return filled >= wet_share * room && room >= least_room * whole;
}

}  // namespace geodrop
