// An edge of a polygon, and the axis of a stadium.
#pragma once

#include <geodrop/geometry/shape.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace geodrop {

/// In the sense of the outline [m].
struct PolygonEdge {
  double from_x, from_y, to_x, to_y;
};

/// Of a stadium: the segment within whose distance of the radius it lies.
inline PolygonEdge axis_of(const StadiumShape& stadium) {
  const double reach = std::abs(stadium.semi_axes[0] - stadium.semi_axes[1]);
  const double turn =
      (stadium.tilt_deg + (stadium.semi_axes[1] > stadium.semi_axes[0] ? 90 : 0)) * std::numbers::pi / 180;
  const double x = reach * std::cos(turn), y = reach * std::sin(turn);
  return {stadium.centre[0] - x, stadium.centre[1] - y, stadium.centre[0] + x, stadium.centre[1] + y};
}

inline double distance_to(const PolygonEdge& edge, const Point& x) {
  const double dx = edge.to_x - edge.from_x, dy = edge.to_y - edge.from_y, length2 = dx * dx + dy * dy;
  const double along = (x[0] - edge.from_x) * dx + (x[1] - edge.from_y) * dy;
  const double s = length2 > 0 ? std::clamp(along / length2, 0.0, 1.0) : 0.0;
  return std::hypot(x[0] - (edge.from_x + s * dx), x[1] - (edge.from_y + s * dy));
}

}  // namespace geodrop
