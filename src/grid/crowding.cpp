#include "crowding.hpp"

#include "neighbourhood.hpp"
#include "seams.hpp"

#include <algorithm>

namespace geodrop {

template <int Dim>
void find_crowding(Grid<Dim>& grid) {
  const auto shiftable = [&](int cell) { return (grid.cell_flags[cell] & cell_shiftable) != 0; };
  const auto fill_ratio = [&](int node) { return grid.velocity[node][3]; };
  for_each_active_real_row(grid, [&](int begin, int count, const std::array<int, Dim>& cell) {
    double* const crowding = grid.crowding.data() + begin;
    std::fill_n(crowding, count, 0.0);
    const auto mean = binomial_means<Dim>(grid.layout, begin, count, cell, fill_ratio);
    for (int k = 0; k < count; ++k)
      if (mean[k] > 1 + smooth_scatter && shiftable(begin + k)) crowding[k] = mean[k] - 1 - smooth_scatter;
    if (std::none_of(mean.begin(), mean.begin() + count, [](double m) { return m < 1 - smooth_scatter; })) return;
    const auto inside = all_around<Dim>(grid.layout, begin, count, cell, shiftable);
    for (int k = 0; k < count; ++k)
      if (inside[k] && mean[k] < 1 - smooth_scatter) crowding[k] = mean[k] - 1 + smooth_scatter;
  });
  for_each_seam(grid.layout, [&](int axis) { copy_over_seam(grid.layout, axis, grid.crowding); });
}

template void find_crowding<2>(Grid<2>&);
template void find_crowding<3>(Grid<3>&);

}  // namespace geodrop
