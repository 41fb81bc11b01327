// What a polygon has in a box: of an outline of thousands of corners only the edges near the box are looked at again.
#pragma once

#include <geodrop/geometry/shapes.hpp>

#include <vector>

#include "polygon_edge.hpp"

namespace geodrop {

std::vector<PolygonEdge> edges_of(const PolygonShape& polygon);

/// Questions about a place in the box have the answers, bit for bit, of `contains` and `chords` for the whole polygon.
class PolygonInBox {
 public:
  PolygonInBox(const std::vector<PolygonEdge>& edges, const Bounds& box);

  /// Whether the outline comes as near to a point of the box as `radius`, at most half of the box's diagonal [m].
  bool comes_near(const Point& x, double radius) const;
  /// Of a point that is not on the outline.
  bool contains(const Point& x) const;
  /// What the row at height y has in common with the polygon; chords may end anywhere beyond the box.
  std::vector<Chord> row(double y) const;
  /// Heights of corners, also of those beside the box, and where the outline crosses its upright sides.
  void add_levels(std::vector<double>& levels) const;

 private:
  Bounds box_;
  std::vector<PolygonEdge> near_;
  std::vector<double> ends_on_left_;  ///< heights of both ends of edges on the left, ascending [m]
  std::vector<double> corners_;       ///< heights between those of the box [m]
};

}  // namespace geodrop
