// A closed line of nodes, as a polygon.
#pragma once

#include <geodrop/state.hpp>

namespace geodrop {

/// The node that an edge (a segment of a membrane) ends at; the last edge of a closed line ends at node 0.
inline std::size_t end_of_edge(std::size_t edge, std::size_t nodes) { return edge + 1 == nodes ? 0 : edge + 1; }

/// Area of the polygon with corners x, y, positive if they run anticlockwise [m2].
inline double signed_area(const Array<double>& x, const Array<double>& y) {
  double twice = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const std::size_t end = end_of_edge(k, x.size());
    twice += x[k] * y[end] - x[end] * y[k];
  }
  return twice / 2;
}

}  // namespace geodrop
