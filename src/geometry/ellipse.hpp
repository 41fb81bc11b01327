// The parts of an ellipse's geometry that need numerics: arc length and distance.
#pragma once

#include <geodrop/geometry/shape.hpp>

#include <vector>

namespace geodrop {

/// Coordinates along the axes of the ellipse, from its centre [m].
Point to_local(const EllipseShape& ellipse, const Point& x);
Point to_global(const EllipseShape& ellipse, const Point& local);

double ellipse_perimeter(const EllipseShape& ellipse);

/// Points at equal arc lengths, anticlockwise from the end of the first axis; see `outline`.
std::vector<Point> even_points(const EllipseShape& ellipse, double spacing);

double distance_to_ellipse(const EllipseShape& ellipse, const Point& x);

}  // namespace geodrop
