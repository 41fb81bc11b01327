#include "means_beside.hpp"

#include <algorithm>

#include "grid/neighbourhood.hpp"

namespace geodrop {
namespace {

/// The node at or below a coordinate along one axis.
template <int Dim>
int node_below(const GridLayout<Dim>& layout, int axis, double x) {
  const int nearest = layout.base(axis, x);
  return x < layout.node(axis, nearest) ? nearest - 1 : nearest;
}

/// Of a corner: bit a of its number says whether it is the upper one along axis a.
template <std::size_t Dim>
double weight_of(const std::array<double, Dim>& share, int corner) {
  double weight = 1;
  for (std::size_t a = 0; a < Dim; ++a) weight *= (corner >> a) % 2 == 1 ? share[a] : 1 - share[a];
  return weight;
}

/// Integral of the linear function of a node over the room of its field [m2, m3].
template <int Dim>
double room_of(const Grid<Dim>& grid, const std::array<int, Dim>& node) {
  constexpr double share[] = {0.125, 0.75, 0.125};  // of cells of a width, whose middles the nodes are
  double room = 0;
  for_neighbourhood(grid.layout, grid.layout.index(node), [&](int cell, const std::array<int, Dim>& side) {
    double size = 1 - grid.taken[cell];
    for (int a = 0; a < Dim; ++a)
      size *= share[side[a]] * grid.layout.span_shape(a, node[a] + side[a] - 1 + GridLayout<Dim>::pad).width;
    room += size;
  });
  return room;
}

}  // namespace

template <int Dim, std::size_t Count>
typename MeansBeside<Dim, Count>::Place MeansBeside<Dim, Count>::place(const GridLayout<Dim>& layout,
                                                                       const Vec<Dim>& x) const {
  Place at{};
  at.inside = true;
  for (int a = 0; a < Dim; ++a) {
    const int below = node_below(layout, a, x[a]);
    at.node[a] = below - first_[a];
    at.inside = at.inside && at.node[a] >= 0 && at.node[a] + 1 < count_[a];
    const double left = layout.node(a, below);
    at.share[a] = (x[a] - left) / (layout.node(a, below + 1) - left);
  }
  return at;
}

template <int Dim, std::size_t Count>
std::size_t MeansBeside<Dim, Count>::corner(const Place& at, int which) const {
  std::size_t flat = 0;
  for (int a = Dim - 1; a >= 0; --a)
    flat = flat * static_cast<std::size_t>(count_[a]) + static_cast<std::size_t>(at.node[a] + (which >> a) % 2);
  return flat;
}

template <int Dim, std::size_t Count>
void MeansBeside<Dim, Count>::begin(const GridLayout<Dim>& layout, const Membrane<Dim>& membrane) {
  std::size_t nodes = 1;
  for (int a = 0; a < Dim; ++a) {
    const auto [low, high] = std::minmax_element(membrane.x[a].begin(), membrane.x[a].end());
    first_[a] = node_below(layout, a, *low) - 1;  // particles beside the outermost nodes
    count_[a] = node_below(layout, a, *high) + 3 - first_[a];
    nodes *= static_cast<std::size_t>(count_[a]);
  }
  sums_.assign(nodes, {});
  wanted_.assign(nodes, 0);
  for (std::size_t k = 0; k < membrane.nodes(); ++k) {
    const Place at = place(layout, vector_at(membrane.x, k));
    for (int c = 0; c < corners; ++c) wanted_[corner(at, c)] = 1;
  }
}

template <int Dim, std::size_t Count>
void MeansBeside<Dim, Count>::add(const Place& at, double volume, const Values& value) {
  for (int c = 0; c < corners; ++c) {
    const std::size_t node = corner(at, c);
    if (!wanted_[node]) continue;
    const double part = weight_of(at.share, c) * volume;
    sums_[node].volume += part;
    for (std::size_t i = 0; i < Count; ++i) sums_[node].value[i] += part * value[i];
  }
}

template <int Dim, std::size_t Count>
typename MeansBeside<Dim, Count>::Sums MeansBeside<Dim, Count>::at(const GridLayout<Dim>& layout,
                                                                   const Membrane<Dim>& membrane, std::size_t k) const {
  const Place at = place(layout, vector_at(membrane.x, k));
  Sums mean;
  for (int c = 0; c < corners; ++c) {
    const double weight = weight_of(at.share, c);
    const Sums& sum = sums_[corner(at, c)];
    mean.volume += weight * sum.volume;
    for (std::size_t i = 0; i < Count; ++i) mean.value[i] += weight * sum.value[i];
  }
  return mean;
}

template <int Dim, std::size_t Count>
double MeansBeside<Dim, Count>::room(const Grid<Dim>& grid, const Membrane<Dim>& membrane, std::size_t k) const {
  const Place at = place(grid.layout, vector_at(membrane.x, k));
  double room = 0;
  for (int c = 0; c < corners; ++c) {
    std::array<int, Dim> node;
    for (int a = 0; a < Dim; ++a) node[a] = first_[a] + at.node[a] + (c >> a) % 2;
    room += weight_of(at.share, c) * room_of<Dim>(grid, node);
  }
  return room;
}

template class MeansBeside<2, 3>;
template class MeansBeside<2, 4>;
template class MeansBeside<3, 4>;
template class MeansBeside<3, 6>;

}  // namespace geodrop
