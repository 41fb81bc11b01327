#include "crowding.hpp"

#include "neighbourhood.hpp"
#include "seams.hpp"

#include <algorithm>

namespace geodrop {
namespace {

/// Mean over the cell; at walls without slip, where integrals are those of odd fields, the node inside counts a fourth
/// less.
template <int Dim>
double mean_fill(const Grid<Dim>& grid, const std::array<int, Dim>& cell, int flat) {
  double sum = 0, measure = 0;
  for_neighbourhood(grid.layout, flat, [&](int node, const std::array<int, Dim>& a) {
    double integral = 1;
    for (int axis = 0; axis < Dim; ++axis) integral *= grid.integrals[axis].value[cell[axis]][a[axis]];
    sum += integral * grid.velocity[node][3];
    measure += integral;
  });
  return sum / measure;
}

}  // namespace

template <int Dim>
void find_crowding(Grid<Dim>& grid) {
  const auto shiftable = [&](int cell) { return (grid.cell_flags[cell] & cell_shiftable) != 0; };
  for_each_active_real_row(grid, [&](int begin, int count, std::array<int, Dim> cell) {
    const auto inside = all_around<Dim>(grid.layout, begin, count, cell, shiftable);
    for (int k = 0; k < count; ++k, ++cell[0]) {
      const double excess = inside[k] ? mean_fill<Dim>(grid, cell, begin + k) - 1 : 0.0;
      grid.crowding[begin + k] = excess - std::clamp(excess, -smooth_scatter, smooth_scatter);
    }
  });
  for_each_seam(grid.layout, [&](int axis) { copy_over_seam(grid.layout, axis, grid.crowding); });
}

template void find_crowding<2>(Grid<2>&);
template void find_crowding<3>(Grid<3>&);

}  // namespace geodrop
