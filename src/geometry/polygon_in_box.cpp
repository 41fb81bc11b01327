#include "polygon_in_box.hpp"

#include <limits>

namespace geodrop {

std::vector<PolygonEdge> edges_of(const PolygonShape& polygon) {
  const std::vector<Point>& points = polygon.points;
  std::vector<PolygonEdge> edges;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point &a = points[i], &b = points[(i + 1) % points.size()];
    edges.push_back({a[0], a[1], b[0], b[1]});
  }
  return edges;
}

PolygonInBox::PolygonInBox(const std::vector<PolygonEdge>& edges, const Bounds& box) : box_(box) {
  // More than half of the diagonal, and than what rounding moves a crossing beyond the ends of its edge.
  const double reach = box.upper[0] - box.lower[0] + box.upper[1] - box.lower[1];
  for (const PolygonEdge& e : edges) {
    if (e.from_y > box.lower[1] && e.from_y < box.upper[1]) corners_.push_back(e.from_y);
    const double below = std::min(e.from_y, e.to_y), above = std::max(e.from_y, e.to_y);
    if (above < box.lower[1] - reach || below > box.upper[1] + reach) continue;
    if (std::min(e.from_x, e.to_x) > box.upper[0] + reach) continue;
    if (std::max(e.from_x, e.to_x) < box.lower[0] - reach)
      ends_on_left_.insert(ends_on_left_.end(), {below, above});
    else
      near_.push_back(e);
  }
  std::sort(ends_on_left_.begin(), ends_on_left_.end());
}

bool PolygonInBox::comes_near(const Point& x, double radius) const {
  return std::any_of(near_.begin(), near_.end(), [&](const PolygonEdge& e) { return distance_to(e, x) <= radius; });
}

bool PolygonInBox::contains(const Point& x) const {
  const std::vector<Chord> chords = row(x[1]);
  return std::any_of(chords.begin(), chords.end(), [&](const Chord& c) { return c.from <= x[0] && x[0] < c.to; });
}

std::vector<Chord> PolygonInBox::row(double y) const {
  std::vector<double> crossings;
  for (const PolygonEdge& e : near_)
    if ((e.from_y > y) != (e.to_y > y))
      crossings.push_back(e.from_x + (y - e.from_y) * (e.to_x - e.from_x) / (e.to_y - e.from_y));
  std::sort(crossings.begin(), crossings.end());
  // An edge on the left crosses the row if one of its ends is above: an odd number of ends, an odd number of crossings.
  const auto above = ends_on_left_.end() - std::upper_bound(ends_on_left_.begin(), ends_on_left_.end(), y);
  bool inside = above % 2 != 0;
  constexpr double beyond = std::numeric_limits<double>::infinity();
  double from = -beyond;
  std::vector<Chord> chords;
  for (const double crossing : crossings) {
    if (inside) chords.push_back({from, crossing});
    inside = !inside;
    from = crossing;
  }
  if (inside) chords.push_back({from, beyond});
  return chords;
}

void PolygonInBox::add_levels(std::vector<double>& levels) const {
  levels.insert(levels.end(), corners_.begin(), corners_.end());
  for (const double x : {box_.lower[0], box_.upper[0]})
    for (const PolygonEdge& e : near_)
      if ((e.from_x > x) != (e.to_x > x))
        levels.push_back(e.from_y + (x - e.from_x) * (e.to_y - e.from_y) / (e.to_x - e.from_x));
}

}  // namespace geodrop
