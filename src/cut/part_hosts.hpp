// Which parts of cells stand by themselves, and whose pressure the others share.
#pragma once

#include <geodrop/grid/grid.hpp>

#include <array>
#include <cmath>
#include <type_traits>
#include <vector>

#include "cells_around.hpp"
#include "grid/cell_pressure.hpp"
#include "grid/nearby_cells.hpp"

namespace geodrop {

/// A part stands by itself if it is this share of its cell, and particles fill this share.
inline constexpr double least_part = 0.5, least_filled = 0.3;
inline constexpr double round_off = 1e-9;  // of a share: cells along a wall that all have a half are alike

/// Whether the field's part of a cell stands by itself. Water in pores has to fill its share of what the grains leave,
/// too: a flow into the cell over the little volume of one particle squeezes that to nothing.
template <int Dim>
bool stands(const Grid<Dim>& grid, int flat) {
  const double whole = size_in_domain(grid.layout, flat), part = 1 - taken_of(grid, flat);
  const double filled = grid.cell_volume[flat], grains = grid.occupied.empty() ? 0.0 : grid.occupied[flat];
  return part >= least_part - round_off && carries_pressure(grid, flat) && filled + grains >= least_filled * whole &&
         filled >= least_filled * (part * whole - grains);
}

/// The nearest cell that stands by itself, rather one to the side that `towards` points to: a thin body has water on
/// both sides. -1 if there is none nearby.
template <int Dim>
int find_host(const Grid<Dim>& grid, int flat, const std::type_identity_t<std::array<double, Dim>>& towards) {
  static const std::vector<std::array<int, Dim>> nearby = offsets_by_distance<Dim>();
  if (stands(grid, flat)) return flat;
  for (const bool same_side : {true, false})
    for (const auto& offset : nearby) {
      double along = 0;
      int other = flat;
      for (int a = 0; a < Dim; ++a) {
        along += offset[a] * towards[a];
        other += offset[a] * grid.layout.stride[a];
      }
      if ((along > 0) == same_side && stands(grid, other)) return other;
    }
  return -1;
}

/// The cell whose pressure acts in what a rigid body leaves of a cell: its own, or for a small part that of the
/// neighbour in the direction `outward`, so that the mean of both is of one depth beside an upright wall. -1 where
/// particles act by themselves, as in other cells that are not filled.
template <int Dim>
int host_beside_rigid(const Grid<Dim>& grid, int flat, const std::type_identity_t<std::array<double, Dim>>& outward) {
  if (stands(grid, flat)) return flat;
  if (1 - taken_of(grid, flat) >= least_part) return -1;
  int best = -1;
  double most = 0;  // cosine between the way to the neighbour and `outward`
  for_neighbourhood(grid.layout, flat, [&](int other, const std::array<int, Dim>& at) {
    double along = 0, square = 0;
    for (int a = 0; a < Dim; ++a) {
      along += (at[a] - 1) * outward[a];
      square += (at[a] - 1) * (at[a] - 1);
    }
    if (square == 0 || !(along / std::sqrt(square) > most)) return;
    best = other;
    most = along / std::sqrt(square);
  });
  return best >= 0 && stands(grid, best) ? best : -1;
}

}  // namespace geodrop
