#include "membrane_nodes.hpp"

#include <geodrop/geometry/shapes.hpp>
#include <geodrop/grid/graded_axis.hpp>

#include <algorithm>
#include <cmath>

namespace geodrop {
namespace {

/// Points along an open polyline, corners kept, each leg divided evenly into steps of about `spacing`.
std::vector<Point> divide_polyline(const std::vector<Point>& corners, double spacing) {
  std::vector<Point> out{corners.front()};
  for (std::size_t c = 1; c < corners.size(); ++c) {
    const Point &from = corners[c - 1], &to = corners[c];
    double length2 = 0;
    for (std::size_t a = 0; a < from.size(); ++a) length2 += std::pow(to[a] - from[a], 2);
    const int steps = std::max(1, static_cast<int>(std::lround(std::sqrt(length2) / spacing)));
    for (int k = 1; k <= steps; ++k) {
      Point x = from;
      for (std::size_t a = 0; a < x.size(); ++a) x[a] += (to[a] - from[a]) * k / steps;
      out.push_back(x);
    }
  }
  return out;
}

}  // namespace

std::vector<Point> membrane_nodes(const Scene& scene, const MembraneSpec& spec) {
  const double spacing = finest_spacing(scene.grid) / spec.segments_per_cell;
  if (spec.points.empty()) return outline(find_body(scene, spec.body)->shape, spacing);
  return spec.closed ? outline(PolygonShape{spec.points}, spacing) : divide_polyline(spec.points, spacing);
}

}  // namespace geodrop
