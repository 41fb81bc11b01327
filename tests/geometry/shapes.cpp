// Geometry of shapes against values worked by hand.
#include <geodrop/geometry/shapes.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "support/near.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double pi = std::numbers::pi;

double signed_area(const std::vector<Point>& points) {
  double twice = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point &a = points[i], &b = points[(i + 1) % points.size()];
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return twice / 2;
}

/// The container of the field test, upright (cases/dump_kekerdom.toml).
const EllipseShape container{{1.0, 2.0}, {0.507698, 3.326767}, 0.0};

}  // namespace

TEST_CASE("ellipse: perimeter and area of the field test's container") {
  // By the trapezoidal rule with 2e6 points in the ellipse's parameter, and pi a b.
  CHECK(perimeter(container) == near(13.738707230456, 1e-13));
  CHECK(area(container) == near(5.306127851118, 1e-13));
  // The field test's figures; the semi-axes are rounded to 1e-6 m, which moves both by some 1e-6.
  CHECK(std::abs(perimeter(container) - 13.738705) < 3e-6);
  CHECK(std::abs(area(container) - 5.306122) < 7e-6);
  CHECK(perimeter(EllipseShape{{0, 0}, {2, 2}, 30}) == near(4 * pi, 1e-14));
}

TEST_CASE("stadium: area, perimeter and outline of a rectangle with semicircular ends") {
  const double tilt = std::atan2(4, 3) * 180 / pi;
  const StadiumShape stadium{{2.5, 4}, {3, 0.5}, tilt};  // 5 m between (1, 2) and (4, 6), the centres of its ends
  const StadiumShape upright{{2.5, 4}, {0.5, 3}, tilt - 90};
  for (const StadiumShape& shape : {stadium, upright}) {
    CHECK(area(shape) == near(5 + pi / 4, 1e-14));
    CHECK(perimeter(shape) == near(10 + pi, 1e-14));
    CHECK(contains(shape, {2.5 - 0.39, 4 + 0.29}));
    CHECK_FALSE(contains(shape, {2.5 - 0.41, 4 + 0.31}));
    for (std::size_t a = 0; a < 2; ++a) {
      CHECK(bounds(shape).lower[a] == near(Point{0.5, 1.5}[a], 1e-13));
      CHECK(bounds(shape).upper[a] == near(Point{4.5, 6.5}[a], 1e-13));
    }
    const std::vector<Point> points = outline(shape, 0.05);
    REQUIRE(points.size() == 263);  // 13.1416 / 0.05 = 262.8
    CHECK(signed_area(points) == near(area(shape), 1e-3));
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Point &point = points[i], &next = points[(i + 1) % points.size()];
      CHECK(distance_to_outline(shape, point) < 1e-12);
      CHECK(std::hypot(next[0] - point[0], next[1] - point[1]) == near(perimeter(shape) / 263, 1e-3));
    }
  }
  CHECK(area(StadiumShape{{0, 0}, {2, 2}, 30}) == near(4 * pi, 1e-14));
}

TEST_CASE("stadium: chords cross both straight sides, or one end, or both ends") {
  const StadiumShape stadium{{2, 1.5}, {3, 0.5}, std::atan2(3, 4) * 180 / pi};  // ends about (0, 0) and (4, 3)
  const auto chord = [&](double y) { return chords(stadium, {0, y}, 0); };
  REQUIRE(chord(1.5).size() == 1);
  CHECK(chord(1.5)[0].from == near(2 - 0.5 * 5 / 3, 1e-13));
  CHECK(chord(1.5)[0].to == near(2 + 0.5 * 5 / 3, 1e-13));
  REQUIRE(chord(-0.45).size() == 1);  // below the foot (0.3, -0.4) of the straight side: the disc alone
  CHECK(chord(-0.45)[0].to == near(std::sqrt(0.25 - 0.45 * 0.45), 1e-12));
  CHECK(chord(-0.51).empty());
  const std::vector<Chord> along = chords(StadiumShape{{2, 0}, {2.5, 0.5}, 0}, {0, 0.3}, 0);
  REQUIRE(along.size() == 1);
  CHECK(along[0].from == near(-0.4, 1e-13));
  CHECK(along[0].to == near(4.4, 1e-13));
}

TEST_CASE("ellipse: outline is anticlockwise, on the ellipse, evenly spaced by arc length") {
  const double spacing = 0.0625;
  for (const double tilt : {0.0, 35.0}) {
    EllipseShape ellipse = container;
    ellipse.tilt_deg = tilt;
    const std::vector<Point> points = outline(ellipse, spacing);
    REQUIRE(points.size() == 220);  // 13.738705 / 0.0625 = 219.8
    CHECK(signed_area(points) > 0);
    CHECK(signed_area(points) == near(area(ellipse), 1e-3));
    for (const Point& point : points) CHECK(distance_to_outline(ellipse, point) < 1e-12);
  }
  // Arc length from one point to the next by the trapezoidal rule in the ellipse's parameter, apart from the code's
  // own.
  const std::vector<Point> points = outline(container, spacing);
  const double a = container.semi_axes[0], b = container.semi_axes[1];
  const auto parameter = [&](const Point& x) { return std::atan2((x[1] - 2.0) / b, (x[0] - 1.0) / a); };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double begin = parameter(points[i]);
    double end = parameter(points[(i + 1) % points.size()]);
    if (end < begin) end += 2 * pi;
    constexpr int pieces = 2000;
    double arc = 0;
    for (int k = 0; k < pieces; ++k) {
      const double theta = begin + (end - begin) * (k + 0.5) / pieces;
      arc += std::hypot(a * std::sin(theta), b * std::cos(theta)) * (end - begin) / pieces;
    }
    CHECK(arc == near(13.738707230456 / 220, 1e-8));
  }
}

TEST_CASE("ellipse: distance of points at a known offset along the normal") {
  for (const double tilt : {0.0, 20.0, 90.0}) {
    const EllipseShape ellipse{{-1, 0.5}, {3, 0.5}, tilt};
    const double c = std::cos(tilt * pi / 180), s = std::sin(tilt * pi / 180);
    for (const double theta : {0.0, 0.3, 1.2, pi / 2, 2.5, 4.0, 5.9}) {
      // The radius of curvature at the tip is 0.0833 m: an offset inwards must stay below it.
      for (const double offset : {-0.08, -0.01, 0.0, 0.2, 5.0}) {
        const double nx = std::cos(theta) / 3, ny = std::sin(theta) / 0.5, n = std::hypot(nx, ny);
        const double u = 3 * std::cos(theta) + offset * nx / n, v = 0.5 * std::sin(theta) + offset * ny / n;
        const Point x{-1 + c * u - s * v, 0.5 + s * u + c * v};
        CHECK(distance_to_outline(ellipse, x) == within(std::abs(offset), 3e-15));
        if (offset != 0) CHECK(contains(ellipse, x) == (offset < 0));
      }
    }
    CHECK(distance_to_outline(ellipse, {-1, 0.5}) == near(0.5, 1e-12));
  }
  CHECK(distance_to_outline(EllipseShape{{0, 0}, {2, 2}, 0}, {0, 0}) == near(2, 1e-12));
}

TEST_CASE("ellipse: bounds of a tilted one") {
  const Bounds upright = bounds(container);
  CHECK(upright.lower[1] == near(2.0 - 3.326767, 1e-12));
  const Bounds turned = bounds(EllipseShape{{0, 0}, {3, 1}, 90});
  CHECK(turned.upper[0] == near(1, 1e-12));
  CHECK(turned.upper[1] == near(3, 1e-12));
  const Bounds diagonal = bounds(EllipseShape{{0, 0}, {3, 1}, 45});
  CHECK(diagonal.upper[0] == near(std::sqrt(5.0), 1e-12));  // sqrt((9 + 1) / 2)
  CHECK(diagonal.upper[1] == near(std::sqrt(5.0), 1e-12));
}

TEST_CASE("box: contains its edges, keeps its corners") {
  const BoxShape box{{1, 2}, {4, 3}};
  CHECK(area(box) == 3);
  CHECK(perimeter(box) == 8);
  CHECK(contains(box, {1, 2}));
  CHECK(contains(box, {4, 2.5}));
  CHECK_FALSE(contains(box, {4.0001, 2.5}));
  const std::vector<Point> points =
      outline(box, 0.4);  // 8 pieces of 0.375 m along 3 m, 3 of 0.333 m (2.5 rounds up) along 1 m
  CHECK(points.size() == 22);
  CHECK(points[0] == Point{1, 2});
  CHECK(points[8] == Point{4, 2});
  CHECK(points[11] == Point{4, 3});
  CHECK(signed_area(points) == near(3, 1e-12));
  CHECK(distance_to_outline(box, {2, 2.25}) == near(0.25, 1e-12));
  CHECK(distance_to_outline(box, {7, 7}) == near(5, 1e-12));
  const BoxShape cube{{0, 0, 0}, {1, 1, 1}};
  CHECK(contains(cube, {0.5, 0.5, 1.0}));
  CHECK_FALSE(contains(cube, {0.5, 0.5, 1.1}));
}

TEST_CASE("polygon: either sense of corners, edges belong to it") {
  const std::vector<Point> corners{{0, 0}, {4, 0}, {4, 3}};
  const PolygonShape forward{corners}, backward{{corners.rbegin(), corners.rend()}};
  for (const PolygonShape& polygon : {forward, backward}) {
    CHECK(area(polygon) == near(6, 1e-12));
    CHECK(perimeter(polygon) == near(12, 1e-12));
    CHECK(contains(polygon, {3, 1}));
    CHECK(contains(polygon, {2, 1.5}));  // on the slanted edge
    CHECK(contains(polygon, {0, 0}));
    CHECK(contains(polygon, {4, 1.5}));  // on the right edge, which a crossing count alone leaves out
    CHECK(contains(polygon, {4, 3}));
    CHECK_FALSE(contains(polygon, {1, 1}));
    CHECK_FALSE(contains(polygon, {-1, 0}));
    CHECK(signed_area(outline(polygon, 0.5)) == near(6, 1e-12));
    CHECK(outline(polygon, 1.0).size() == 12);
    CHECK(distance_to_outline(polygon, {0, 3}) == near(2.4, 1e-12));  // 3 * 4 / 5
    CHECK(bounds(polygon).upper == Point{4, 3});
  }
  const PolygonShape notched{{{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}}};
  CHECK(area(notched) == near(10, 1e-12));
  CHECK_FALSE(contains(notched, {2, 2}));
  CHECK(contains(notched, {0.5, 2}));
}

TEST_CASE("half-plane: the side away from its normal, cut off by the domain") {
  const HalfPlaneShape half{{0, 1}, {0, 5}};
  CHECK(contains(half, {100, 1}));
  CHECK_FALSE(contains(half, {0, 1.001}));
  CHECK(distance_to_outline(half, {3, 3}) == near(2, 1e-12));
  CHECK(area(half) == std::numeric_limits<double>::infinity());
  const Bounds unit{{0, 0}, {1, 1}};
  const Bounds slope = bounds_within(HalfPlaneShape{{0.5, 0.25}, {1, 2}}, unit);  // y <= 0.5 - x / 2
  CHECK(slope.lower == Point{0, 0});
  CHECK(slope.upper[0] == near(1, 1e-12));
  CHECK(slope.upper[1] == near(0.5, 1e-12));
  const Bounds over = bounds_within(HalfPlaneShape{{0, 0.25}, {0, -1}}, unit);
  CHECK(over.lower[1] == near(0.25, 1e-12));
  CHECK(over.upper == Point{1, 1});
  CHECK(bounds_within(HalfPlaneShape{{0, 2}, {0, 1}}, unit).upper == Point{1, 1});
  const Bounds none = bounds_within(HalfPlaneShape{{0, -1}, {0, 1}}, unit);
  CHECK(none.lower[0] > none.upper[0]);
}

TEST_CASE("half-space: the part of the domain that it leaves") {
  // x + y + z <= 1 in a box of 2 m x 3 m x 0.5 m.
  const HalfPlaneShape half{{1, 0, 0}, {3, 3, 3}};
  CHECK(contains(half, {0.2, 0.3, 0.5}));
  CHECK_FALSE(contains(half, {0.2, 0.3, 0.51}));
  const Bounds box = bounds_within(half, {{0, 0, 0}, {2, 3, 0.5}});
  CHECK(box.lower == Point{0, 0, 0});
  CHECK(box.upper[0] == near(1, 1e-12));
  CHECK(box.upper[1] == near(1, 1e-12));
  CHECK(box.upper[2] == 0.5);
}

TEST_CASE("sections of a box, an ellipsoid and half-spaces") {
  const BoxShape box{{0, 1, 2}, {3, 4, 6}};
  CHECK(section(box, 1, 2.5) == Shape{BoxShape{{0, 2}, {3, 6}}});
  CHECK_FALSE(section(box, 1, 4.5));
  // 0.6 of the semi-axis off the centre the others shrink to 0.8.
  const EllipseShape ellipsoid{{1, 2, 3}, {5, 10, 20}, 0};
  const std::optional<Shape> cut = section(ellipsoid, 2, 15);
  REQUIRE(cut);
  const auto& ellipse = std::get<EllipseShape>(*cut);
  CHECK(ellipse.centre == Point{1, 2});
  CHECK(ellipse.semi_axes[0] == near(4, 1e-12));
  CHECK(ellipse.semi_axes[1] == near(8, 1e-12));
  CHECK_FALSE(section(ellipsoid, 0, -4.1));
  // x + 2 z <= 4 at y = 7 and at z = 1 (x <= 2); level ones are there or not.
  const HalfPlaneShape slope{{0, 0, 2}, {1, 0, 2}};
  const std::optional<Shape> upright = section(slope, 1, 7), level = section(slope, 2, 1);
  REQUIRE((upright && level));
  CHECK(contains(*upright, {2, 0.99}));
  CHECK_FALSE(contains(*upright, {2, 1.01}));
  CHECK(contains(*level, {1.99, 100}));
  CHECK_FALSE(contains(*level, {2.01, -100}));
  const HalfPlaneShape floor{{0, 0, 2}, {0, 0, 1}};
  REQUIRE(section(floor, 2, 1.9));
  CHECK(contains(*section(floor, 2, 1.9), {1e9, -1e9}));
  CHECK_FALSE(section(floor, 2, 2.1));
}
