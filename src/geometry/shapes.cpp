#include <geodrop/geometry/shapes.hpp>
#include <geodrop/geometry/triangle_surface.hpp>

#include "ellipse.hpp"
#include "polygon_edge.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

namespace geodrop {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double cross(const Point& o, const Point& a, const Point& b) {
  return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
}

double distance(const Point& a, const Point& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

double signed_area(const std::vector<Point>& points) {
  double twice = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point& a = points[i];
    const Point& b = points[(i + 1) % points.size()];
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return twice / 2;
}

bool on_segment(const Point& a, const Point& b, const Point& x) {
  if (cross(a, b, x) != 0) return false;
  return std::min(a[0], b[0]) <= x[0] && x[0] <= std::max(a[0], b[0]) && std::min(a[1], b[1]) <= x[1] &&
         x[1] <= std::max(a[1], b[1]);
}

/// Corners anticlockwise.
std::vector<Point> corners(const BoxShape& box) {
  return {box.lower, {box.upper[0], box.lower[1]}, box.upper, {box.lower[0], box.upper[1]}};
}
std::vector<Point> corners(const PolygonShape& polygon) {
  std::vector<Point> points = polygon.points;
  if (signed_area(points) < 0) std::reverse(points.begin(), points.end());
  return points;
}

std::vector<Point> divide_edges(const std::vector<Point>& points, double spacing) {
  std::vector<Point> divided;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point& a = points[i];
    const Point& b = points[(i + 1) % points.size()];
    const int pieces = std::max(1, static_cast<int>(std::lround(distance(a, b) / spacing)));
    for (int k = 0; k < pieces; ++k) {
      const double s = static_cast<double>(k) / pieces;
      divided.push_back({a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])});
    }
  }
  return divided;
}

double length_around(const std::vector<Point>& points) {
  double length = 0;
  for (std::size_t i = 0; i < points.size(); ++i) length += distance(points[i], points[(i + 1) % points.size()]);
  return length;
}

double distance_around(const std::vector<Point>& points, const Point& x) {
  double nearest = kInfinity;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point &a = points[i], &b = points[(i + 1) % points.size()];
    nearest = std::min(nearest, distance_to({a[0], a[1], b[0], b[1]}, x));
  }
  return nearest;
}

/// Signed height over the boundary of a half-plane, positive outside [m].
double height_over(const HalfPlaneShape& half, const Point& x) {
  double dot = 0, norm2 = 0;
  for (std::size_t a = 0; a < x.size(); ++a) {
    dot += (x[a] - half.point[a]) * half.normal[a];
    norm2 += half.normal[a] * half.normal[a];
  }
  return dot / std::sqrt(norm2);
}

double radius_of(const StadiumShape& stadium) { return std::min(stadium.semi_axes[0], stadium.semi_axes[1]); }

double length_of(const PolygonEdge& axis) { return std::hypot(axis.to_x - axis.from_x, axis.to_y - axis.from_y); }

/// Points at equal distances along the outline, anticlockwise from the start of an end's semicircle.
std::vector<Point> even_points(const StadiumShape& stadium, double spacing) {
  const PolygonEdge axis = axis_of(stadium);
  const double radius = radius_of(stadium), arc = std::numbers::pi * radius, half = arc + length_of(axis);
  const double heading = std::atan2(axis.to_y - axis.from_y, axis.to_x - axis.from_x);
  const auto count = std::max<std::size_t>(3, static_cast<std::size_t>(std::lround(2 * half / spacing)));
  std::vector<Point> points;
  for (std::size_t k = 0; k < count; ++k) {
    // One half is the semicircle about `to` with the side back to `from`, the other the same turned about the centre.
    const double s = 2 * half * static_cast<double>(k) / static_cast<double>(count);
    const double turned = s < half ? heading : heading + std::numbers::pi, along = s < half ? s : s - half;
    const double angle = turned - std::numbers::pi / 2 + std::min(along, arc) / radius,
                 back = std::max(0.0, along - arc);
    points.push_back({(s < half ? axis.to_x : axis.from_x) + radius * std::cos(angle) - back * std::cos(turned),
                      (s < half ? axis.to_y : axis.from_y) + radius * std::sin(angle) - back * std::sin(turned)});
  }
  return points;
}

// One overload per shape; the public functions visit.
bool contains_point(const BoxShape& box, const Point& x) {
  for (std::size_t a = 0; a < x.size(); ++a) {
    if (x[a] < box.lower[a] || x[a] > box.upper[a]) return false;
  }
  return true;
}
bool contains_point(const EllipseShape& ellipse, const Point& x) {
  const Point local = to_local(ellipse, x);
  double sum = 0;
  for (std::size_t a = 0; a < local.size(); ++a)
    sum += local[a] * local[a] / (ellipse.semi_axes[a] * ellipse.semi_axes[a]);
  return sum <= 1;
}
bool contains_point(const StadiumShape& stadium, const Point& x) {
  return distance_to(axis_of(stadium), x) <= radius_of(stadium);
}
bool contains_point(const PolygonShape& polygon, const Point& x) {
  bool inside = false;
  const std::vector<Point>& points = polygon.points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point& a = points[i];
    const Point& b = points[(i + 1) % points.size()];
    if (on_segment(a, b, x)) return true;
    const bool straddles = (a[1] > x[1]) != (b[1] > x[1]);
    if (straddles && x[0] < a[0] + (x[1] - a[1]) * (b[0] - a[0]) / (b[1] - a[1])) inside = !inside;
  }
  return inside;
}
bool contains_point(const HalfPlaneShape& half, const Point& x) { return height_over(half, x) <= 0; }
bool contains_point(const InsideShape& inside, const Point& x) {
  return inside.region && x.size() == 3 && inside.region->contains({x[0], x[1], x[2]});
}

Bounds bounds_of(const BoxShape& box) { return {box.lower, box.upper}; }
Bounds bounds_of(const EllipseShape& ellipse) {
  const double c = std::cos(ellipse.tilt_deg * std::numbers::pi / 180);
  const double s = std::sin(ellipse.tilt_deg * std::numbers::pi / 180);
  Point half = ellipse.semi_axes;
  half[0] = std::hypot(ellipse.semi_axes[0] * c, ellipse.semi_axes[1] * s);
  half[1] = std::hypot(ellipse.semi_axes[0] * s, ellipse.semi_axes[1] * c);
  Bounds box{ellipse.centre, ellipse.centre};
  for (std::size_t a = 0; a < half.size(); ++a) {
    box.lower[a] -= half[a];
    box.upper[a] += half[a];
  }
  return box;
}
Bounds bounds_of(const StadiumShape& stadium) {
  const auto [from_x, from_y, to_x, to_y] = axis_of(stadium);
  const double radius = radius_of(stadium);
  return {{std::min(from_x, to_x) - radius, std::min(from_y, to_y) - radius},
          {std::max(from_x, to_x) + radius, std::max(from_y, to_y) + radius}};
}
Bounds bounds_of(const PolygonShape& polygon) {
  Bounds box{polygon.points.at(0), polygon.points.at(0)};
  for (const Point& point : polygon.points) {
    for (std::size_t a = 0; a < point.size(); ++a) {
      box.lower[a] = std::min(box.lower[a], point[a]);
      box.upper[a] = std::max(box.upper[a], point[a]);
    }
  }
  return box;
}
Bounds bounds_of(const HalfPlaneShape& half) {
  return {Point(half.point.size(), -kInfinity), Point(half.point.size(), kInfinity)};
}

Bounds bounds_of(const InsideShape& inside) {
  if (!inside.region) return {Point(3, kInfinity), Point(3, -kInfinity)};
  const Corner &lower = inside.region->lower(), &upper = inside.region->upper();
  return {Point(lower.begin(), lower.end()), Point(upper.begin(), upper.end())};
}

double area_of(const BoxShape& box) { return (box.upper[0] - box.lower[0]) * (box.upper[1] - box.lower[1]); }
double area_of(const EllipseShape& ellipse) { return std::numbers::pi * ellipse.semi_axes[0] * ellipse.semi_axes[1]; }
double area_of(const StadiumShape& stadium) {
  const double radius = radius_of(stadium);
  return radius * (2 * length_of(axis_of(stadium)) + std::numbers::pi * radius);
}
double area_of(const PolygonShape& polygon) { return std::abs(signed_area(polygon.points)); }
double area_of(const HalfPlaneShape&) { return kInfinity; }
double area_of(const InsideShape&) { return assert(false && "for the plane"), 0; }

std::vector<Point> outline_of(const BoxShape& box, double spacing) { return divide_edges(corners(box), spacing); }
std::vector<Point> outline_of(const PolygonShape& polygon, double spacing) {
  return divide_edges(corners(polygon), spacing);
}
std::vector<Point> outline_of(const EllipseShape& ellipse, double spacing) { return even_points(ellipse, spacing); }
std::vector<Point> outline_of(const StadiumShape& stadium, double spacing) { return even_points(stadium, spacing); }
std::vector<Point> outline_of(const HalfPlaneShape&, double) {
  assert(false && "a half-plane has no closed outline; clip it first");
  return {};
}

std::vector<Point> outline_of(const InsideShape&, double) {
  return assert(false && "for the plane"), std::vector<Point>{};
}

double perimeter_of(const BoxShape& box) { return length_around(corners(box)); }
double perimeter_of(const PolygonShape& polygon) { return length_around(polygon.points); }
double perimeter_of(const EllipseShape& ellipse) { return ellipse_perimeter(ellipse); }
double perimeter_of(const StadiumShape& stadium) {
  return 2 * (length_of(axis_of(stadium)) + std::numbers::pi * radius_of(stadium));
}
double perimeter_of(const HalfPlaneShape&) { return kInfinity; }
double perimeter_of(const InsideShape&) { return assert(false && "for the plane"), 0; }

double distance_of(const BoxShape& box, const Point& x) { return distance_around(corners(box), x); }
double distance_of(const PolygonShape& polygon, const Point& x) { return distance_around(polygon.points, x); }
double distance_of(const EllipseShape& ellipse, const Point& x) { return distance_to_ellipse(ellipse, x); }
double distance_of(const StadiumShape& stadium, const Point& x) {
  return std::abs(distance_to(axis_of(stadium), x) - radius_of(stadium));
}
double distance_of(const HalfPlaneShape& half, const Point& x) { return std::abs(height_over(half, x)); }
double distance_of(const InsideShape&, const Point&) { return assert(false && "for the plane"), 0; }

}  // namespace

bool contains(const Shape& shape, const Point& x) {
  return std::visit([&](const auto& s) { return contains_point(s, x); }, shape);
}
Bounds bounds(const Shape& shape) {
  return std::visit([](const auto& s) { return bounds_of(s); }, shape);
}
double area(const Shape& shape) {
  return std::visit([](const auto& s) { return area_of(s); }, shape);
}
std::vector<Point> outline(const Shape& shape, double spacing) {
  return std::visit([&](const auto& s) { return outline_of(s, spacing); }, shape);
}
double perimeter(const Shape& shape) {
  return std::visit([](const auto& s) { return perimeter_of(s); }, shape);
}
double distance_to_outline(const Shape& shape, const Point& x) {
  return std::visit([&](const auto& s) { return distance_of(s, x); }, shape);
}

Bounds bounds_within(const Shape& shape, const Bounds& domain) {
  const auto* half = std::get_if<HalfPlaneShape>(&shape);
  if (!half) return bounds(shape);
  const std::size_t dimension = domain.lower.size();
  Bounds box{Point(dimension, kInfinity), Point(dimension, -kInfinity)};
  const auto include = [&](const Point& x) {
    for (std::size_t a = 0; a < dimension; ++a) {
      box.lower[a] = std::min(box.lower[a], x[a]);
      box.upper[a] = std::max(box.upper[a], x[a]);
    }
  };
  // Its corners are those of the domain that lie inside, and the points where edges of the domain cross the boundary.
  for (unsigned k = 0; k < 1u << dimension; ++k) {
    Point corner = domain.lower;
    for (std::size_t a = 0; a < dimension; ++a)
      if ((k >> a & 1u) != 0) corner[a] = domain.upper[a];
    if (height_over(*half, corner) <= 0) include(corner);
    for (std::size_t a = 0; a < dimension; ++a) {
      if ((k >> a & 1u) != 0) continue;
      Point end = corner;
      end[a] = domain.upper[a];
      const double from = height_over(*half, corner), to = height_over(*half, end);
      if ((from > 0) == (to > 0)) continue;
      end[a] = corner[a] + (end[a] - corner[a]) * from / (from - to);
      include(end);
    }
  }
  return box;
}

std::optional<Point> outward_normal(const Shape& shape, const Point& from, const Point& to, double step) {
  const double length = std::hypot(to[0] - from[0], to[1] - from[1]);
  const Point right{(to[1] - from[1]) / length, (from[0] - to[0]) / length};
  const auto inside = [&](double off) {
    return contains(shape, {0.5 * (from[0] + to[0]) + off * right[0], 0.5 * (from[1] + to[1]) + off * right[1]});
  };
  const bool on_right = inside(step), on_left = inside(-step);
  if (on_right == on_left) return std::nullopt;
  return on_left ? right : Point{-right[0], -right[1]};
}

}  // namespace geodrop
