// Where anchors part the line of a membrane: cloth does not slide past them (2D).
#pragma once

#include <geodrop/state/state.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace geodrop {

/// How far along the line an anchor grips the cloth to both sides [cells]: as far as the splines of the grid reach.
/// Cloth that slid up to the held node gathered there in a neck of two flanks that the grid cannot tell apart: a
/// hanging bag of water had 23 % too much tension (h = 0.125 m), with the grip 0.06 %.
inline constexpr double anchor_grip = 1.5;

/// Nodes of a membrane that anchors hold or grip, ascending.
inline std::vector<std::size_t> held_nodes(const State<2>& state, const Membrane<2>& membrane) {
  std::vector<std::size_t> held;
  const auto nodes = static_cast<std::ptrdiff_t>(membrane.nodes());
  for (const Anchor<2>& anchor : state.anchors) {
    if (anchor.membrane != membrane.name) continue;
    const std::ptrdiff_t reach = std::min(nodes / 2, std::lround(0.5 * anchor_grip / membrane.half_size));
    for (std::ptrdiff_t k = anchor.node - reach; k <= anchor.node + reach; ++k)
      if (membrane.closed || (k >= 0 && k < nodes)) held.push_back(static_cast<std::size_t>((k + nodes) % nodes));
  }
  std::sort(held.begin(), held.end());
  held.erase(std::unique(held.begin(), held.end()), held.end());
  return held;
}

/// Consecutive segments of a line, round its end if it is closed.
struct LinePart {
  std::size_t first, count;
};

/// The parts of a line between held nodes; none is empty.
inline std::vector<LinePart> parts_between(const std::vector<std::size_t>& held, const Membrane<2>& membrane) {
  std::vector<std::size_t> ends = held;
  if (!membrane.closed) {
    ends.insert(ends.begin(), 0);
    ends.push_back(membrane.segments());
  } else if (!ends.empty()) {
    ends.push_back(ends.front() + membrane.segments());
  }
  std::vector<LinePart> parts;
  for (std::size_t e = 1; e < ends.size(); ++e)
    if (ends[e] > ends[e - 1]) parts.push_back({ends[e - 1], ends[e] - ends[e - 1]});
  return parts;
}

}  // namespace geodrop
