// Sections of shapes in space: what a plane across an axis has in common with them.
#include <geodrop/geometry/shapes.hpp>

#include <cassert>
#include <cmath>
#include <limits>

namespace geodrop {
namespace {

Point without(Point x, std::size_t axis) {
  x.erase(x.begin() + static_cast<std::ptrdiff_t>(axis));
  return x;
}

std::optional<Shape> section_of(const BoxShape& box, std::size_t axis, double level) {
  if (level < box.lower[axis] || level > box.upper[axis]) return std::nullopt;
  return BoxShape{without(box.lower, axis), without(box.upper, axis)};
}

std::optional<Shape> section_of(const EllipseShape& ellipsoid, std::size_t axis, double level) {
  const double off = (level - ellipsoid.centre[axis]) / ellipsoid.semi_axes[axis];
  if (std::abs(off) >= 1) return std::nullopt;
  Point semi_axes = without(ellipsoid.semi_axes, axis);
  for (double& half : semi_axes) half *= std::sqrt((1 - off) * (1 + off));
  return EllipseShape{without(ellipsoid.centre, axis), semi_axes, 0.0};
}

std::optional<Shape> section_of(const HalfPlaneShape& half, std::size_t axis, double level) {
  const Point normal = without(half.normal, axis);
  const double height = half.normal[axis] * (level - half.point[axis]);
  const double norm2 = normal[0] * normal[0] + normal[1] * normal[1];
  constexpr double everywhere = std::numeric_limits<double>::infinity();
  if (norm2 == 0) {
    if (height > 0) return std::nullopt;
    return BoxShape{Point(2, -everywhere), Point(2, everywhere)};
  }
  Point point = without(half.point, axis);
  for (std::size_t a = 0; a < 2; ++a) point[a] -= normal[a] * height / norm2;
  return HalfPlaneShape{point, normal};
}

std::optional<Shape> section_of(const PolygonShape&, std::size_t, double) {
  assert(false && "polygons lie in the plane");
  return std::nullopt;
}

std::optional<Shape> section_of(const StadiumShape&, std::size_t, double) {
  assert(false && "stadiums lie in the plane");
  return std::nullopt;
}

std::optional<Shape> section_of(const InsideShape&, std::size_t, double) {
  assert(false && "BodyRegion::share has the exact volume of these");
  return std::nullopt;
}

}  // namespace

std::optional<Shape> section(const Shape& shape, int axis, double level) {
  return std::visit([&](const auto& s) { return section_of(s, static_cast<std::size_t>(axis), level); }, shape);
}

}  // namespace geodrop
