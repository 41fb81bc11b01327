#include "crowding.hpp"

#include "neighbourhood.hpp"
#include "seams.hpp"

#include <algorithm>

namespace geodrop {

template <int Dim>
void find_crowding(Grid<Dim>& grid) {
  const auto shiftable = [&](int cell) { return (grid.cell_flags[cell] & cell_shiftable) != 0; };
  const auto fill_ratio = [&](int node) { return grid.velocity[node][3]; };
  for_each_active_real_row(grid, [&](int begin, int count, std::array<int, Dim> cell) {
    const auto inside = all_around<Dim>(grid.layout, begin, count, cell, shiftable);
    for (int k = 0; k < count; ++k, ++cell[0]) {
      if (!shiftable(begin + k)) {
        grid.crowding[begin + k] = 0;
        continue;
      }
      const double excess = binomial_mean<Dim>(grid.layout, cell, fill_ratio) - 1;
      grid.crowding[begin + k] = std::max(excess - smooth_scatter, inside[k] ? std::min(excess + smooth_scatter, 0.0) : 0.0);
    }
  });
  for_each_seam(grid.layout, [&](int axis) { copy_over_seam(grid.layout, axis, grid.crowding); });
}

template void find_crowding<2>(Grid<2>&);
template void find_crowding<3>(Grid<3>&);

}  // namespace geodrop
