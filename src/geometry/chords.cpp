// Chords of shapes: what a line along an axis has in common with them.
#include <geodrop/geometry/shapes.hpp>

#include "ellipse.hpp"
#include "polygon_edge.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace geodrop {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<Chord> chords_of(const BoxShape& box, const Point& x, std::size_t axis) {
  for (std::size_t a = 0; a < x.size(); ++a) {
    if (a != axis && (x[a] < box.lower[a] || x[a] > box.upper[a])) return {};
  }
  return {{box.lower[axis], box.upper[axis]}};
}

/// With x = base + t e in axes scaled to a unit circle: |p + t q|^2 = 1.
std::vector<Chord> chords_of(const EllipseShape& ellipse, const Point& x, std::size_t axis) {
  Point base = x;
  base[axis] = ellipse.centre[axis];
  Point next = base;
  next[axis] += 1;
  const Point p = to_local(ellipse, base), end = to_local(ellipse, next);
  double qq = 0, pq = 0, pp = 0;
  for (std::size_t a = 0; a < p.size(); ++a) {
    const double scale2 = ellipse.semi_axes[a] * ellipse.semi_axes[a], q = end[a] - p[a];
    qq += q * q / scale2;
    pq += p[a] * q / scale2;
    pp += p[a] * p[a] / scale2;
  }
  const double discriminant = pq * pq - qq * (pp - 1);
  if (discriminant <= 0) return {};
  const double middle = base[axis] - pq / qq, half = std::sqrt(discriminant) / qq;
  return {{middle - half, middle + half}};
}

std::vector<Chord> chords_of(const PolygonShape& polygon, const Point& x, std::size_t axis) {
  const std::size_t other = 1 - axis;
  const std::vector<Point>& points = polygon.points;
  std::vector<double> crossings;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point& a = points[i];
    const Point& b = points[(i + 1) % points.size()];
    if ((a[other] > x[other]) == (b[other] > x[other])) continue;
    crossings.push_back(a[axis] + (x[other] - a[other]) * (b[axis] - a[axis]) / (b[other] - a[other]));
  }
  std::sort(crossings.begin(), crossings.end());
  std::vector<Chord> found;
  for (std::size_t k = 1; k < crossings.size(); k += 2) found.push_back({crossings[k - 1], crossings[k]});
  return found;
}

/// What the line has in common with the discs of both ends and with the rectangle between them: one piece, as a stadium
/// is convex.
std::vector<Chord> chords_of(const StadiumShape& stadium, const Point& x, std::size_t axis) {
  const auto [from_x, from_y, to_x, to_y] = axis_of(stadium);
  const double radius = std::min(stadium.semi_axes[0], stadium.semi_axes[1]);
  const double length = std::hypot(to_x - from_x, to_y - from_y), scale = length > 0 ? radius / length : 0;
  const double across_x = -scale * (to_y - from_y), across_y = scale * (to_x - from_x);
  std::vector<Chord> pieces = chords_of(PolygonShape{{{from_x - across_x, from_y - across_y},
                                                      {to_x - across_x, to_y - across_y},
                                                      {to_x + across_x, to_y + across_y},
                                                      {from_x + across_x, from_y + across_y}}},
                                        x, axis);
  for (const Point& end : {Point{from_x, from_y}, Point{to_x, to_y}})
    for (const Chord& chord : chords_of(EllipseShape{end, {radius, radius}, 0}, x, axis)) pieces.push_back(chord);
  if (pieces.empty()) return {};
  Chord whole = pieces.front();
  for (const Chord& piece : pieces) whole = {std::min(whole.from, piece.from), std::max(whole.to, piece.to)};
  return {whole};
}

std::vector<Chord> chords_of(const HalfPlaneShape& half, const Point& x, std::size_t axis) {
  double height = 0;  // times the length of the normal, of the point of the line at the level of half.point
  for (std::size_t a = 0; a < x.size(); ++a) {
    if (a != axis) height += (x[a] - half.point[a]) * half.normal[a];
  }
  const double slope = half.normal[axis];
  if (slope == 0) return height <= 0 ? std::vector<Chord>{{-kInfinity, kInfinity}} : std::vector<Chord>{};
  const double cut = half.point[axis] - height / slope;
  return {slope > 0 ? Chord{-kInfinity, cut} : Chord{cut, kInfinity}};
}

std::vector<Chord> chords_of(const InsideShape&, const Point&, std::size_t) {
  assert(false && "BodyRegion::share has the exact volume of these");
  return {};
}

}  // namespace

std::vector<Chord> chords(const Shape& shape, const Point& x, int axis) {
  return std::visit([&](const auto& s) { return chords_of(s, x, static_cast<std::size_t>(axis)); }, shape);
}

}  // namespace geodrop
