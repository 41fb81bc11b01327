#include "other_sides.hpp"

#include "cell_slopes.hpp"
#include "grid/blocks.hpp"
#include "grid/momentum.hpp"
#include "uncut_cells.hpp"

namespace geodrop {
namespace {

/// Integral of a node's spline over the plane or space [m2, m3].
template <int Dim>
double spline_size(const GridLayout<Dim>& layout, int node) {
  const std::array<int, Dim> place = stored_cell(layout, node);
  double size = 1;
  for (int a = 0; a < Dim; ++a) size *= layout.spline_width(a, place[a] - layout.pad);
  for (int a = 0; a < Dim; ++a) size *= layout.h;
  return size;
}

/// Grains at the nodes of pore water beside a membrane, by their volume: grid/momentum takes 1 - n, as if the splines
/// were full there.
template <int Dim>
void fill_with_grains(Grid<Dim>& water) {
  const bool around = water.field == 0;
  for_each_active_real_row(water, [&](int begin, int count, std::array<int, Dim> node) {
    for (int flat = begin; flat < begin + count; ++flat, ++node[0]) {
      const double n = water.pore_share[flat];
      if (!(n > 0 && n < 1) || (around && !beside_cut(water, flat))) continue;
      const double grains = spline_volume(water, flat) * (1 - n) / n;
      water.velocity[flat][3] += grains / node_measure<Dim>(water, node) - (1 - n);
    }
  });
}

/// How often what a cell has counts at a node: on a wall that the cell is off, with the image beyond.
template <int Dim>
int with_images(const GridLayout<Dim>& layout, const std::array<int, Dim>& from, int flat) {
  const std::array<int, Dim> place = stored_cell(layout, flat);
  int counts = 1;
  for (int a = 0; a < Dim; ++a)
    if (on_wall(layout, a, place[a]) && from[a] != place[a]) counts *= 2;
  return counts;
}

}  // namespace

template <int Dim>
void fill_other_sides(const State<Dim>& state, Grids<Dim>& grids) {
  const GridLayout<Dim>& layout = grids.front().layout;
  bool at_walls = false;
  const auto fill = [&](Grid<Dim>& grid, int flat, const SplineVolumes<Dim>& value) {
    const std::array<int, Dim> cell = stored_cell(layout, flat);
    const bool far = far_from_walls<Dim>(layout, 1, cell);
    at_walls = at_walls || !far;
    for (int n = 0; n < nodes_around<Dim>; ++n) {
      const int node = node_around(layout, flat, n), counts = far ? 1 : with_images<Dim>(layout, cell, node);
      grid.velocity[node][3] += counts * value[n] / spline_size(layout, node);
    }
  };
  for (Grid<Dim>& grid : grids)
    for (const PartCell<Dim>& part : grid.part_cells) fill(grid, part.flat, part.elsewhere);
  if (Grid<Dim>& around = grids.front(); !around.pore_share.empty()) fill_with_grains(around);
  for (const Membrane<Dim>& membrane : state.membranes) {
    if (!acts_sharply(membrane)) continue;
    if (Grid<Dim>& pressed = pressed_field(membrane, grids); !pressed.pore_share.empty()) fill_with_grains(pressed);
    for (const bool inside : {true, false})
      for_each_uncut(layout, grids[membrane.field].outline, inside, [&](int flat) {
        fill(inside ? grids.front() : pressed_field(membrane, grids), flat, whole_value(spans_of(layout, flat)));
      });
  }
  for (Grid<Dim>& grid : grids)  // nothing shifts through a wall: the ratio beyond it is its mirror image
    if (at_walls) impose_wall_velocity(grid);
}

#define GEODROP_INSTANTIATE(D) template void fill_other_sides(const State<D>&, Grids<D>&);
GEODROP_INSTANTIATE(2)
GEODROP_INSTANTIATE(3)
#undef GEODROP_INSTANTIATE

}  // namespace geodrop
