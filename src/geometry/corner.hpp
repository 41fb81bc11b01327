// Vectors of three numbers.
#pragma once

#include <geodrop/geometry/triangle_surface.hpp>

namespace geodrop {

inline Corner to_corner(const Point& x) { return {x[0], x[1], x[2]}; }
inline Corner difference(const Corner& a, const Corner& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Corner cross(const Corner& a, const Corner& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double dot(const Corner& a, const Corner& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

}  // namespace geodrop
