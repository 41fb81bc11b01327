#include "triangle.hpp"

#include <Eigen/Geometry>

namespace geodrop {

Vec<3> nearest_point(const std::array<Vec<3>, 3>& corner, const Vec<3>& x) {
  const auto& [a, b, c] = corner;
  const Vec<3> ab = b - a, ac = c - a, ax = x - a, bx = x - b, cx = x - c;
  const double d1 = ab.dot(ax), d2 = ac.dot(ax);
  if (d1 <= 0 && d2 <= 0) return a;
  const double d3 = ab.dot(bx), d4 = ac.dot(bx);
  if (d3 >= 0 && d4 <= d3) return b;
  const double of_c = d1 * d4 - d3 * d2;
  if (of_c <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
  const double d5 = ab.dot(cx), d6 = ac.dot(cx);
  if (d6 >= 0 && d5 <= d6) return c;
  const double of_b = d5 * d2 - d1 * d6;
  if (of_b <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
  const double of_a = d3 * d6 - d5 * d4;
  if (of_a <= 0 && d4 >= d3 && d5 >= d6) return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  const double all = of_a + of_b + of_c;
  return a + of_b / all * ab + of_c / all * ac;
}

std::array<double, 3> corner_shares(const std::array<Vec<3>, 3>& corner, const Vec<3>& point) {
  const auto& [a, b, c] = corner;
  const Vec<3> of_a = (b - point).cross(c - point), of_b = (c - point).cross(a - point);
  const double whole = (b - a).cross(c - a).norm();
  if (!(whole > 0)) return {1, 0, 0};  // a line or a point
  const double at_a = of_a.norm() / whole, at_b = of_b.norm() / whole;
  return {at_a, at_b, 1 - at_a - at_b};
}

}  // namespace geodrop
