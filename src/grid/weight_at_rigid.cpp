#include "weight_at_rigid.hpp"

#include <numeric>
#include <vector>

#include "momentum.hpp"

namespace geodrop {
namespace {

/// Room that the filled cells around a node leave to the fluid, as the spline sees it [m2]; negative where a surface or
/// a sharp interface is near, too.
double room_around(const Grid<2>& grid, int flat, const std::array<int, 2>& node) {
  constexpr double none = 0.02, little = 0.5;  // of a cell
  const auto room_of = [&](int cell) { return 1 - grid.rigid_cells[cell]; };
  const bool in_rigid = room_of(flat) < none;
  double room = 0;
  bool known = true;
  for_neighbourhood(grid.layout, flat, [&](int, const std::array<int, 2>& a) {
    const int cell = mirrored<2>(grid.layout, node, a);
    const bool filled = (grid.cell_flags[cell] & cell_filled) != 0;
    if (filled && (grid.cell_volume[cell] > 0 || grid.rigid_cells[cell] > 0)) {
      const auto value = [&](int axis) { return grid.integrals[axis].value[node[axis] + a[axis] - 1][2 - a[axis]]; };
      room += value(0) * value(1);
    } else if (grid.cell_volume[cell] > 0 || !(in_rigid || room_of(cell) < little)) {
      known = false;
    }
    if (!grid.taken.empty() && grid.taken[cell] > 0) known = false;
  });
  return known ? room * grid.layout.h * grid.layout.h - grid.rigid_filled[flat] : -1;
}

}  // namespace

double weigh_by_room(Grid<2>& grid) {
  const auto blocks = static_cast<std::ptrdiff_t>(grid.active_blocks.size());
  std::vector<double> mass(blocks), lacking(blocks);
#pragma omp parallel for schedule(static) if (blocks >= blocks_worth_threads)
  for (std::ptrdiff_t b = 0; b < blocks; ++b)
    for_each_real_row_of_block(grid.layout, grid.active_blocks[b], [&](int begin, int count, std::array<int, 2> node) {
      for (int flat = begin; flat < begin + count; ++flat, ++node[0]) {
        grid.room_mass[flat] = 0;
        mass[b] += grid.sum[flat][3];
        const double volume = spline_volume(grid, flat);
        if (!(grid.rigid_splines[flat] > 0 && volume > 0)) continue;
        const double room = room_around(grid, flat, node);
        if (!(room > 0)) continue;
        grid.room_mass[flat] = room / volume * grid.sum[flat][3];
        lacking[b] += grid.room_mass[flat] - grid.sum[flat][3];
      }
    });
  const auto sum = [](const std::vector<double>& of) { return std::accumulate(of.begin(), of.end(), 0.0); };
  const double all = sum(mass);
  return all > 0 ? all / (all + sum(lacking)) : 1.0;
}

}  // namespace geodrop
