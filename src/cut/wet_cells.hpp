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

/// A cell and its neighbours: the cell's own part outside of a membrane may be too small to hold a particle, and a
/// neighbour alone may be full of water that a wall keeps away.
struct RoomAround {
  double whole = 0;   ///< [m2, m3]
  double room = 0;    ///< what bodies leave of it
  double filled = 0;  ///< what of that what is around fills
};

template <int Dim>
RoomAround room_around(const Grid<Dim>& around, int flat) {
  RoomAround out;
  for (int n = 0; n < nodes_around<Dim>; ++n) {
    const int other = node_around(around.layout, flat, n);
    if (!in_domain(around.layout, other)) continue;
    out.whole += size_in_domain(around.layout, other);
    out.room += (1 - taken_of(around, other)) * size_in_domain(around.layout, other);
    out.filled += around.cell_volume[other] + (around.occupied.empty() ? 0.0 : around.occupied[other]);
  }
  return out;
}

/// Whether what is around a membrane fills half of the room that bodies leave it. Where they leave less than a tenth,
/// they touch: a lone particle in such a film takes up the pressures of both sides.
inline bool is_wet(const RoomAround& at) {
  constexpr double wet_share = 0.5, least_room = 0.1;
  return at.filled >= wet_share * at.room && at.room >= least_room * at.whole;
}

template <int Dim>
bool is_wet(const Grid<Dim>& around, int flat) {
  return is_wet(room_around(around, flat));
}

/// Whether air lies beside a membrane: bodies leave a quarter or more, and next to nothing fills it. Dry gaps under
/// water, in which no particle fits, have some of it around.
template <int Dim>
bool is_in_air(const Grid<Dim>& around, int flat) {
  constexpr double least_room = 0.25, most_filled = 0.05;
  const RoomAround at = room_around(around, flat);
  return at.room >= least_room * at.whole && at.filled < most_filled * at.room;
}

}  // namespace geodrop
