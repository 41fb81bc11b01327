#include "crowding.hpp"

#include "neighbourhood.hpp"
#include "seams.hpp"

#include <algorithm>

namespace geodrop {
namespace {

/// Binomial means of the fill ratios of the nodes around `count` cells along x.
template <int Dim>
std::array<double, GridLayout<Dim>::block_width[0]> mean_fill(const Grid<Dim>& grid, int begin, int count,
                                                              std::array<int, Dim> cell) {
  const auto fill_ratio = [&](int node) { return grid.velocity[node][3]; };
  std::array<double, GridLayout<Dim>::block_width[0]> mean{};
  if (!far_from_walls<Dim>(grid.layout, count, cell)) {
    for (int k = 0; k < count; ++k, ++cell[0]) mean[k] = binomial_mean<Dim>(grid.layout, cell, fill_ratio);
    return mean;
  }
  for_rows_around<Dim>(grid.layout, [&](int offset, int y, int z) {
    const double weight = binomial[y] * (Dim == 3 ? binomial[z] : 1.0);
    for (int x = 0; x < 3; ++x)
      for (int k = 0; k < count; ++k) mean[k] += weight * binomial[x] * fill_ratio(begin + offset + k + x - 1);
  });
  return mean;
}

}  // namespace

template <int Dim>
void find_crowding(Grid<Dim>& grid) {
  const auto shiftable = [&](int cell) { return (grid.cell_flags[cell] & cell_shiftable) != 0; };
  for_each_active_real_row(grid, [&](int begin, int count, const std::array<int, Dim>& cell) {
    double* const crowding = grid.crowding.data() + begin;
    std::fill_n(crowding, count, 0.0);
    const auto mean = mean_fill<Dim>(grid, begin, count, cell);
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
