#include "means_beside.hpp"

#include <algorithm>

#include "grid/neighbourhood.hpp"

namespace geodrop {
namespace {

/// The node at or below a coordinate along one axis.
int node_below(const GridLayout<2>& layout, int axis, double x) {
  const int nearest = layout.base(axis, x);
  return x < layout.node(axis, nearest) ? nearest - 1 : nearest;
}

std::array<double, 4> weights(const std::array<double, 2>& share) {
  const auto [u, v] = share;
  return {(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v};
}

/// Integral of the linear function of a node over the room of its field [m2].
double room_of(const Grid<2>& grid, const std::array<int, 2>& node) {
  constexpr double share[] = {0.125, 0.75, 0.125};  // of cells of a width, whose middles the nodes are
  double room = 0;
  for_neighbourhood(grid.layout, grid.layout.index(node), [&](int cell, const std::array<int, 2>& side) {
    double size = 1 - grid.taken[cell];
    for (std::size_t a = 0; a < 2; ++a)
      size *= share[side[a]] *
              grid.layout.span_shape(static_cast<int>(a), node[a] + side[a] - 1 + GridLayout<2>::pad).width;
    room += size;
  });
  return room;
}

}  // namespace

MeansBeside::Place MeansBeside::place(const GridLayout<2>& layout, double x, double y) const {
  Place at{};
  const double coordinate[] = {x, y};
  at.inside = true;
  for (int a = 0; a < 2; ++a) {
    const int below = node_below(layout, a, coordinate[a]);
    at.node[a] = below - first_[a];
    at.inside = at.inside && at.node[a] >= 0 && at.node[a] + 1 < count_[a];
    const double left = layout.node(a, below);
    at.share[a] = (coordinate[a] - left) / (layout.node(a, below + 1) - left);
  }
  return at;
}

std::size_t MeansBeside::corner(const Place& at, int which) const {
  const int x = at.node[0] + which % 2, y = at.node[1] + which / 2;
  return static_cast<std::size_t>(x) + static_cast<std::size_t>(y) * static_cast<std::size_t>(count_[0]);
}

void MeansBeside::begin(const GridLayout<2>& layout, const Membrane<2>& membrane) {
  for (int a = 0; a < 2; ++a) {
    const auto [low, high] = std::minmax_element(membrane.x[a].begin(), membrane.x[a].end());
    first_[a] = node_below(layout, a, *low) - 1;  // particles beside the outermost nodes
    count_[a] = node_below(layout, a, *high) + 3 - first_[a];
  }
  const std::size_t nodes = static_cast<std::size_t>(count_[0]) * static_cast<std::size_t>(count_[1]);
  sums_.assign(nodes, {});
  wanted_.assign(nodes, 0);
  for (std::size_t k = 0; k < membrane.nodes(); ++k) {
    const Place at = place(layout, membrane.x[0][k], membrane.x[1][k]);
    for (int c = 0; c < 4; ++c) wanted_[corner(at, c)] = 1;
  }
}

void MeansBeside::add(const Place& at, double volume, const std::array<double, 3>& value) {
  const std::array<double, 4> weight = weights(at.share);
  for (int c = 0; c < 4; ++c) {
    const std::size_t node = corner(at, c);
    if (!wanted_[node]) continue;
    const double part = weight[c] * volume;
    sums_[node].volume += part;
    for (int i = 0; i < 3; ++i) sums_[node].value[i] += part * value[i];
  }
}

MeansBeside::Sums MeansBeside::at(const GridLayout<2>& layout, const Membrane<2>& membrane, std::size_t k) const {
  const Place at = place(layout, membrane.x[0][k], membrane.x[1][k]);
  const std::array<double, 4> weight = weights(at.share);
  Sums mean;
  for (int c = 0; c < 4; ++c) {
    const Sums& sum = sums_[corner(at, c)];
    mean.volume += weight[c] * sum.volume;
    for (int i = 0; i < 3; ++i) mean.value[i] += weight[c] * sum.value[i];
  }
  return mean;
}

double MeansBeside::room(const Grid<2>& grid, const Membrane<2>& membrane, std::size_t k) const {
  const Place at = place(grid.layout, membrane.x[0][k], membrane.x[1][k]);
  const std::array<double, 4> weight = weights(at.share);
  double room = 0;
  for (int c = 0; c < 4; ++c)
    room += weight[c] * room_of(grid, {first_[0] + at.node[0] + c % 2, first_[1] + at.node[1] + c / 2});
  return room;
}

}  // namespace geodrop
