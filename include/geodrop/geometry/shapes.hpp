// Geometry of the shapes that bodies are made of. `contains`, `bounds`, `bounds_within` and `chords` are for scenes of
// either dimension, `section` is for space, and the rest for the plane.
#pragma once

#include <geodrop/geometry/shape.hpp>
#include <optional>
#include <vector>

namespace geodrop {

/// Axis-aligned box around a shape [m]; infinite for a half-plane.
struct Bounds {
  Point lower, upper;
};

/// True inside and on the outline.
bool contains(const Shape& shape, const Point& x);

Bounds bounds(const Shape& shape);

/// Bounds of the shape itself or, for a half-plane or half-space, of what it leaves of the domain (lower above upper if
/// nothing is left).
Bounds bounds_within(const Shape& shape, const Bounds& domain);

/// Exact area [m2]; infinite for a half-plane.
double area(const Shape& shape);

/// Closed polyline, anticlockwise, first point not repeated. The points of an ellipse are evenly spaced by arc length;
/// a box or polygon keeps its corners, and each edge is divided evenly. The spacing is the one nearest to `spacing`
/// [m] that divides the outline (or the edge). A half-plane has no closed outline: clip it first.
std::vector<Point> outline(const Shape& shape, double spacing);

/// Length of the outline [m]; infinite for a half-plane.
double perimeter(const Shape& shape);

/// Distance of a point to the outline, from either side [m].
double distance_to_outline(const Shape& shape, const Point& x);

/// Unit normal, out of the shape, of a straight piece of its outline (2D); nothing if not just one of the points
/// `step` [m] beside its middle is inside.
std::optional<Point> outward_normal(const Shape& shape, const Point& from, const Point& to, double step);

/// A piece of a line along an axis, by the coordinate along that axis [m].
struct Chord {
  double from, to;
};

/// What the line through x along an axis (0: x) has in common with a shape, in ascending order: exact, but for lines
/// through a corner of a polygon. Of polygons 2D only.
std::vector<Chord> chords(const Shape& shape, const Point& x, int axis);

/// What the plane across an axis at a level [m] has in common with a shape in space, as a shape in the other two axes
/// (in ascending order); nothing if they do not meet.
std::optional<Shape> section(const Shape& shape, int axis, double level);

}  // namespace geodrop
