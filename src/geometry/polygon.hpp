// A closed line of nodes, as a polygon.
#pragma once

#include <geodrop/base/types.hpp>

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

/// How often the polygon runs round a point, anticlockwise counted positive.
inline int winding_number(const Array<double>& x, const Array<double>& y, const Vec<2>& point) {
  int count = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const std::size_t end = end_of_edge(k, x.size());
    const bool from_above = y[k] > point[1], to_above = y[end] > point[1];
    if (from_above == to_above) continue;
    const double left = (x[end] - x[k]) * (point[1] - y[k]) - (point[0] - x[k]) * (y[end] - y[k]);
    if (to_above && left > 0) ++count;
    if (from_above && left < 0) --count;
  }
  return count;
}

}  // namespace geodrop
