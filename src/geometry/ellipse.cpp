#include "ellipse.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace geodrop {
namespace {

/// Arc length of an ellipse over its parameter theta, x = (a cos theta, b sin theta).
class ArcLength {
 public:
  ArcLength(double a, double b) : a_(a), b_(b), length_(kPieces + 1, 0.0) {
    for (int i = 0; i < kPieces; ++i) length_[index(i + 1)] = length_[index(i)] + integrate(i * kStep, (i + 1) * kStep);
  }

  double total() const { return length_.back(); }

  /// The parameter at an arc length, by Newton's method within one piece.
  double parameter_at(double length) const {
    const auto next = std::upper_bound(length_.begin() + 1, length_.end() - 1, length);
    const auto piece = next - length_.begin() - 1;
    const double begin = static_cast<double>(piece) * kStep;
    double theta = begin;
    for (int iteration = 0; iteration < 8; ++iteration) {
      theta += (length - length_[static_cast<std::size_t>(piece)] - integrate(begin, theta)) / speed(theta);
    }
    return theta;
  }

 private:
  static constexpr int kPieces = 1024;  // perimeter exact to rounding for axes 10 : 1
  static constexpr double kStep = 2 * std::numbers::pi / kPieces;

  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  double speed(double theta) const { return std::hypot(a_ * std::sin(theta), b_ * std::cos(theta)); }

  /// Three-point Gauss quadrature.
  double integrate(double from, double to) const {
    const double middle = (from + to) / 2, half = (to - from) / 2;
    const double node = half * std::sqrt(0.6);
    return half * (5 * speed(middle - node) + 8 * speed(middle) + 5 * speed(middle + node)) / 9;
  }

  double a_, b_;
  std::vector<double> length_;
};

/// Distance in the first quadrant of an ellipse with axes a >= b: bisection for the multiplier of the nearest point
/// (Eberly, Distance from a Point to an Ellipse, 2013). It converges for every point, Newton's method does not.
double quadrant_distance(double a, double b, double x, double y) {
  if (y <= 0) {
    const double ratio = a > b ? a * x / (a * a - b * b) : 1.0;
    return ratio < 1 ? std::hypot(a * ratio - x, b * std::sqrt(1 - ratio * ratio)) : std::abs(x - a);
  }
  if (x <= 0) return std::abs(y - b);
  const double stretch = (a / b) * (a / b);
  const double u = x / a, v = y / b;
  double lower = v - 1, upper = std::max(lower, std::hypot(stretch * u, v) - 1);
  for (int iteration = 0; iteration < 200 && lower < upper; ++iteration) {
    const double middle = (lower + upper) / 2;
    if (middle == lower || middle == upper) break;
    const double value = std::hypot(stretch * u / (middle + stretch), v / (middle + 1)) - 1;
    (value > 0 ? lower : upper) = middle;
  }
  const double t = (lower + upper) / 2;
  return std::hypot(stretch * x / (t + stretch) - x, y / (t + 1) - y);
}

Point turn(const Point& x, double angle_deg) {
  if (angle_deg == 0) return x;
  const double c = std::cos(angle_deg * std::numbers::pi / 180), s = std::sin(angle_deg * std::numbers::pi / 180);
  Point turned = x;
  turned[0] = c * x[0] - s * x[1];
  turned[1] = s * x[0] + c * x[1];
  return turned;
}

}  // namespace

Point to_local(const EllipseShape& ellipse, const Point& x) {
  Point local = x;
  for (std::size_t a = 0; a < x.size(); ++a) local[a] -= ellipse.centre[a];
  return turn(local, -ellipse.tilt_deg);
}

Point to_global(const EllipseShape& ellipse, const Point& local) {
  Point x = turn(local, ellipse.tilt_deg);
  for (std::size_t a = 0; a < x.size(); ++a) x[a] += ellipse.centre[a];
  return x;
}

double ellipse_perimeter(const EllipseShape& ellipse) {
  return ArcLength(ellipse.semi_axes[0], ellipse.semi_axes[1]).total();
}

std::vector<Point> even_points(const EllipseShape& ellipse, double spacing) {
  const double a = ellipse.semi_axes[0], b = ellipse.semi_axes[1];
  const ArcLength arc(a, b);
  const int count = std::max(3, static_cast<int>(std::lround(arc.total() / spacing)));
  std::vector<Point> points;
  for (int i = 0; i < count; ++i) {
    const double theta = arc.parameter_at(arc.total() * i / count);
    points.push_back(to_global(ellipse, {a * std::cos(theta), b * std::sin(theta)}));
  }
  return points;
}

double distance_to_ellipse(const EllipseShape& ellipse, const Point& x) {
  const Point local = to_local(ellipse, x);
  const double a = ellipse.semi_axes[0], b = ellipse.semi_axes[1];
  const double u = std::abs(local[0]), v = std::abs(local[1]);
  return a >= b ? quadrant_distance(a, b, u, v) : quadrant_distance(b, a, v, u);
}

}  // namespace geodrop
