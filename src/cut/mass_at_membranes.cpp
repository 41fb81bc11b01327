#include "mass_at_membranes.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "cells_around.hpp"
#include "grid/blocks.hpp"
#include "grid/momentum.hpp"
#include "grid/point_support.hpp"
#include "transfer/slabs.hpp"
#include "uncut_cells.hpp"

namespace geodrop {
namespace {

/// By stored cell.
template <int Dim>
std::vector<std::uint8_t> cells_beside_membranes(const Grids<Dim>& grids) {
  const GridLayout<Dim>& layout = grids.front().layout;
  std::vector<std::uint8_t> beside(static_cast<std::size_t>(layout.nodes()), 0);
  for (const Grid<Dim>& grid : grids)
    for_each_cut_cell(grid.outline, [&](int cell) {
      const int flat = flat_of(layout, grid.outline, cell);
      if (!in_domain(layout, flat)) return;
      for (int n = 0; n < nodes_around<Dim>; ++n) beside[node_around(layout, flat, n)] = 1;
    });
  return beside;
}

template <int Dim>
void scatter_difference(const Body<Dim>& body, std::size_t p, const std::vector<std::uint8_t>& beside,
                        Grid<Dim>& grid) {
  const GridLayout<Dim>& layout = grid.layout;
  const std::array<double, Dim> x = place_at(body.x, p);
  std::array<int, Dim> cell;
  for (int a = 0; a < Dim; ++a) cell[a] = layout.base(a, x[a]);
  if (!beside[layout.index(cell)]) return;
  const PointSupport<Dim> nodes(layout, x, body.half_size);
  const Vec4 here = interpolate(layout, nodes, grid.velocity_change);
  nodes.for_each_node(layout, [&](int node, double weight) {
    grid.mass_correction[node] += weight * body.mass[p] * (grid.velocity_change[node] - here);
  });
}

template <int Dim>
void correct_field(const State<Dim>& state, const std::vector<std::uint8_t>& beside, Grid<Dim>& grid) {
  impose_wall_velocity(grid);
  std::fill(grid.mass_correction.begin(), grid.mass_correction.end(), Vec4{});
  for_each_slab_by_colour(state, grid, [&](const Body<Dim>& body, std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) scatter_difference(body, p, beside, grid);
  });
  fold_walls(grid, grid.mass_correction);
  for_each_active_real_row(grid, [&](int begin, int count, const auto&) {
    for (int node = begin; node < begin + count; ++node) {
      const double mass = grid.sum[node][3];
      if (mass <= 0) continue;
      for (int a = 0; a < Dim; ++a) {
        const double correction = grid.mass_correction[node][a] / mass;
        grid.velocity[node][a] += correction;
        grid.velocity_change[node][a] += correction;
      }
    }
  });
}

}  // namespace

template <int Dim>
void correct_mass_at_membranes(const State<Dim>& state, Grids<Dim>& grids) {
  const std::vector<std::uint8_t> beside = cells_beside_membranes(grids);
  for (Grid<Dim>& grid : grids)
    if (grid.grain_volume.empty() && grid.pore_share.empty()) correct_field(state, beside, grid);
}

template void correct_mass_at_membranes(const State<2>&, Grids<2>&);
template void correct_mass_at_membranes(const State<3>&, Grids<3>&);

}  // namespace geodrop
