#include "contents_pressure.hpp"

#include <geodrop/base/find_named.hpp>

#include <algorithm>
#include <cmath>

#include "outline.hpp"

namespace geodrop {
namespace {

/// The node at or below a coordinate along one axis.
int node_below(const GridLayout<2>& layout, int axis, double x) {
  const int nearest = layout.base(axis, x);
  return x < layout.node(axis, nearest) ? nearest - 1 : nearest;
}

}  // namespace

ContentsPressure::Place ContentsPressure::place(const GridLayout<2>& layout, double x, double y) const {
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

std::array<double, 4> ContentsPressure::weights(const Place& at) const {
  const auto [u, v] = at.share;
  return {(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v};
}

std::size_t ContentsPressure::corner(const Place& at, int which) const {
  const int x = at.node[0] + which % 2, y = at.node[1] + which / 2;
  return static_cast<std::size_t>(x) + static_cast<std::size_t>(y) * static_cast<std::size_t>(count_[0]);
}

void ContentsPressure::mark_box(const GridLayout<2>& layout, const Membrane<2>& membrane) {
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

/// One after the other: the order of particles is the same for any number of threads.
void ContentsPressure::sum_up(const GridLayout<2>& layout, const Body<2>& body) {
  for (std::size_t p = 0; p < body.size(); ++p) {
    const Place at = place(layout, body.x[0][p], body.x[1][p]);
    if (!at.inside) continue;
    const std::array<double, 4> weight = weights(at);
    const double volume = body.volume(p);
    for (int c = 0; c < 4; ++c) {
      const std::size_t node = corner(at, c);
      if (!wanted_[node]) continue;
      const double part = weight[c] * volume;
      sums_[node].volume += part;
      sums_[node].xx += part * body.stress[0][p];
      sums_[node].yy += part * body.stress[1][p];
      sums_[node].xy += part * body.stress[3][p];
    }
  }
}

void ContentsPressure::update(const State<2>& state, const GridLayout<2>& layout, Membrane<2>& membrane) {
  const Body<2>& body = find_named(state.bodies, membrane.body);
  if (body.stress[0].empty()) return;
  mark_box(layout, membrane);
  sum_up(layout, body);
  for (std::size_t k = 0; k < membrane.nodes(); ++k) {
    const Place at = place(layout, membrane.x[0][k], membrane.x[1][k]);
    const std::array<double, 4> weight = weights(at);
    Sums mean;
    for (int c = 0; c < 4; ++c) {
      const Sums& sum = sums_[corner(at, c)];
      mean.volume += weight[c] * sum.volume;
      mean.xx += weight[c] * sum.xx;
      mean.yy += weight[c] * sum.yy;
      mean.xy += weight[c] * sum.xy;
    }
    const auto [tx, ty] = tangent_at(membrane, k);
    const double pulled = mean.xx * ty * ty + mean.yy * tx * tx - 2 * mean.xy * tx * ty;  // n . sigma n
    membrane.contents_pressure[k] = mean.volume > 0 ? std::max(0.0, -pulled / mean.volume) : 0.0;
  }
}

}  // namespace geodrop
