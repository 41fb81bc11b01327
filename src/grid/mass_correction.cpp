#include "mass_correction.hpp"

#include <algorithm>

#include "blocks.hpp"
#include "momentum.hpp"

namespace geodrop {
namespace {

double lumped_share(Basis basis) { return basis == Basis::linear ? 1.0 / 6 : 1.0 / 4; }

/// What one neighbour adds: the difference of the changes times the smaller mass over the node's own. Only whole nodes
/// compare: one on a wall has half its mass behind the wall, and its neighbour behind the wall mirrors the one before.
template <int Dim>
Vec4 neighbours_share(const Grid<Dim>& grid, int flat, int axis, int coordinate, int side) {
  const GridLayout<Dim>& layout = grid.layout;
  const int stride = layout.stride[axis], last = layout.cells[axis];
  const auto at_wall = [&](int c) { return !layout.periodic(axis) && (c == 0 || c == last); };
  const bool behind = at_wall(coordinate) && (side < 0) == (coordinate == 0);
  const int neighbour = flat + side * stride, mirrored = behind ? flat - side * stride : neighbour;
  const double own = grid.sum[flat][3] * (at_wall(coordinate) ? 2 : 1);
  const double other = grid.sum[mirrored][3] * (at_wall(coordinate + side) ? 2 : 1);
  return std::min(own, other) / own * (grid.velocity_change[flat] - grid.velocity_change[neighbour]);
}

template <int Dim>
Vec4 correction(const Grid<Dim>& grid, int flat, const std::array<int, Dim>& node) {
  Vec4 sum{};
  if (grid.sum[flat][3] <= 0) return sum;
  for (int a = 0; a < Dim; ++a)
    for (const int side : {-1, 1}) sum += neighbours_share<Dim>(grid, flat, a, node[a] - GridLayout<Dim>::pad, side);
  for (int lane = Dim; lane < 4; ++lane) sum[lane] = 0;
  return lumped_share(grid.layout.basis) * sum;
}

}  // namespace

template <int Dim>
void correct_mass(Grid<Dim>& grid) {
  for_each_active_real_row(grid, [&](int begin, int count, std::array<int, Dim> node) {
    for (int k = 0; k < count; ++k, ++node[0]) grid.mass_correction[begin + k] = correction<Dim>(grid, begin + k, node);
  });
  for_each_active_real_row(grid, [&](int begin, int count, const auto&) {
    for (int k = begin; k < begin + count; ++k) {
      grid.velocity[k] += grid.mass_correction[k];
      grid.velocity_change[k] += grid.mass_correction[k];
    }
  });
  impose_wall_velocity(grid);
}

template void correct_mass<2>(Grid<2>&);
template void correct_mass<3>(Grid<3>&);

}  // namespace geodrop
