// The formulas of a container that leaves a split barge: the worked example of CUR 217, values by hand, limits, and
// what cannot be.
#include <geodrop/calculators/release.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "support/formulas.hpp"

using namespace geodrop;
using geodrop::test::check_refused;

namespace {

constexpr double pi = std::numbers::pi, degree = pi / 180;
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// To 1e-12 of the expected value: a few operations in double precision.
void check_equal(double found, double expected) {
  CAPTURE(found);
  CAPTURE(expected);
  CHECK(std::abs(found - expected) <= 1e-12 * std::abs(expected));
}

/// To half a unit of the last digit that is printed in the source.
void check_printed(double found, double printed, double last_digit) {
  CAPTURE(found);
  CHECK(std::abs(found - printed) <= last_digit / 2);
}

/// A container of 9 m2 at 18 kN/m3, walls of 35 degrees, hinges 2.8 m above the keel.
constexpr SplitBarge barge{.wall_slope = 35 * degree, .hinge_radius = 2.8, .friction = 0.3};
constexpr double weight = 162e3;

constexpr SinkingContainer example{
    .volume = 320, .frontal_area = 100, .drag_coefficient = 1, .density = 1990, .water_density = 1000};

}  // namespace

TEST_CASE("The worked example of CUR 217") {
  check_printed(smallest_perimeter(10.8, 3.0), 16.5, 0.1);
  check_printed(opening_tension({.area = 10.8, .density = 1990, .water_density = 1000}) / 1e3, 47.2, 0.1);
  check_printed(terminal_velocity(example), 7.9, 0.1);
}

TEST_CASE("Opening rule: by hand, smallest at a square, the same for an opening and for its height") {
  check_equal(smallest_perimeter(10.8, 3.0), 16.5);  // 2.5 (3.6 + 3)
  check_equal(best_opening_width(9), 3);
  check_equal(smallest_perimeter(9, best_opening_width(9)), 15);  // 5 sqrt(A)
  check_equal(smallest_perimeter(9, 2), smallest_perimeter(9, 4.5));
  CHECK(smallest_perimeter(9, 3.01) > 15);
  CHECK(smallest_perimeter(9, 2.99) > 15);
}

TEST_CASE("Share of the circle: 1 for it, a square's pi/4, the most that the opening rule lets pass 4 pi/25") {
  check_equal(circle_share(pi, 2 * pi), 1);
  check_equal(circle_share(1, 4), pi / 4);
  check_equal(circle_share(7, 5 * std::sqrt(7.0)), 4 * pi / 25);
}

TEST_CASE("Weight and tension: by hand, in air and in water") {
  check_equal(container_weight({.area = 2, .density = 1500, .water_density = 0}), 29430);  // 1500 * 9.81 * 2
  check_equal(container_weight({.area = 2, .density = 1500, .water_density = 1000}), 9810);
  check_equal(opening_tension({.area = 2, .density = 1500, .water_density = 1000}), 4414.5);  // 0.45 * 9810
}

TEST_CASE("Width and angle of the opening: by hand, one the inverse of the other") {
  check_equal(opening_width(barge, 30 * degree), 2.8);  // 2 * 2.8 / 2
  CHECK(opening_width(barge, 0) == 0);
  check_equal(opening_width(barge, 90 * degree), 5.6);
  for (const double angle : {0.01, 0.3, 1.2}) check_equal(opening_angle(barge, opening_width(barge, angle)), angle);
}

TEST_CASE("Neutral height: a point of the wall there moves along the wall when the barge begins to open") {
  check_equal(neutral_height({.wall_slope = 45 * degree, .hinge_radius = 2.8, .friction = 0.3}), 1.4);  // R/2
  const double up = neutral_height(barge), side = up / std::tan(barge.wall_slope);
  const double dx = side, dy = up - barge.hinge_radius;  // from the hinge; a turn moves it by (-dy, dx)
  const double across = -dy * std::sin(barge.wall_slope) - dx * std::cos(barge.wall_slope);
  CHECK(std::abs(across) < 1e-12);
}

TEST_CASE("Wall force: by hand, without friction, at the start of sliding, and rising with the angle") {
  const SplitBarge smooth{.wall_slope = 30 * degree, .hinge_radius = 1, .friction = 0};
  check_equal(wall_force(smooth, weight, 15 * degree), weight / 2);  // tan 45
  const SplitBarge rough{.wall_slope = 30 * degree, .hinge_radius = 1, .friction = std::tan(20 * degree)};
  check_equal(wall_force(rough, weight, 35 * degree), weight / 2);  // 30 + 35 - 20
  const SplitBarge sticking{.wall_slope = 35 * degree, .hinge_radius = 1, .friction = 1};
  CHECK(std::abs(wall_force(sticking, weight, 10 * degree)) < 1e-9 * weight);  // 45 degrees of slope, 45 of friction
  // Wall in equilibrium: normal N and friction mu N along it bear W/2 and push sideways.
  const double slope = barge.wall_slope + 0.2, mu = barge.friction;
  const double normal = weight / 2 / (std::cos(slope) + mu * std::sin(slope));
  check_equal(wall_force(barge, weight, 0.2), normal * (std::sin(slope) - mu * std::cos(slope)));
  // 35 + 10.5 - 16.6992 degrees: 81 kN/m * 0.5498.
  check_printed(wall_force(barge, weight, 10.5 * degree) / 1e3, 44.5, 0.1);
  CHECK(wall_force(barge, weight, 0.3) > wall_force(barge, weight, 0.2));
}

TEST_CASE("Falls: by hand") {
  check_equal(free_fall(4.905).speed, 9.81);  // a second's fall
  check_equal(free_fall(4.905).time, 1);
  check_printed(free_fall(8).speed, 12.53, 0.01);
  check_printed(free_fall(8).time, 1.277, 0.001);
  SinkingContainer heavier = example;
  heavier.density = 1000 + 4 * 990;
  check_equal(terminal_velocity(heavier), 2 * terminal_velocity(example));
}

TEST_CASE("What cannot be is refused by the name of its key") {
  const double inf = std::numeric_limits<double>::infinity();
  check_refused([] { return smallest_perimeter(0, 3); }, "area: found 0; allowed: an area > 0 [m2]");
  check_refused([] { return smallest_perimeter(no_number, 3); }, "area: found nan");
  check_refused([=] { return best_opening_width(inf); }, "area: found inf");
  check_refused([] { return best_opening_width(-1); }, "area: found -1");
  check_refused([] { return smallest_perimeter(9, 0); }, "opening-width: found 0; allowed: a width > 0 [m]");
  check_refused([] { return circle_share(9, 0); }, "perimeter: found 0");
  check_refused([] { return circle_share(9, 10); }, "area: found 9; allowed: at most 7.95774715 m2");
  check_refused([] { return container_weight({9, 1000, 1000}); }, "density: found 1000; allowed: more than");
  check_refused([] { return container_weight({9, 1990, -1}); }, "water-density: found -1");
  check_refused([] { return opening_tension({-9, 1990, 1000}); }, "area: found -9");
  check_refused([] { return neutral_height({90 * degree, 2.8, 0.3}); }, "wall-slope: found 1.57");
  check_refused([] { return opening_width({0.6, 0, 0.3}, 0.1); }, "hinge-radius: found 0");
  check_refused([] { return opening_angle({0.6, 1, -0.3}, 0.1); }, "friction: found -0.3");
  check_refused([] { return opening_width(barge, -0.1); }, "angle: found -0.1");
  check_refused([] { return opening_angle(barge, 6); }, "opening-width: found 6; allowed: from 0 to 5.6 m");
  check_refused([] { return wall_force(barge, 0, 0.1); }, "weight: found 0");
  check_refused([] { return wall_force(barge, weight, 1); }, "angle: found 1; allowed: from 0 to 0.959931089 rad");
  check_refused(
      [] {
        return wall_force({0.6, 1, 1}, weight, 0.1);
      },
      "angle: found 0.1; allowed: at least 0.185398163 rad");
  check_refused([] { return wall_force({pi / 4, 1, 0}, weight, pi / 4); }, "less than upright walls");
  check_refused([] { return free_fall(0).speed; }, "fall-height: found 0");
  const auto sink = [](double SinkingContainer::*value, double wrong) {
    SinkingContainer container = example;
    container.*value = wrong;
    return [container] { return terminal_velocity(container); };
  };
  check_refused(sink(&SinkingContainer::volume, 0), "volume: found 0");
  check_refused(sink(&SinkingContainer::frontal_area, 0), "frontal-area: found 0");
  check_refused(sink(&SinkingContainer::drag_coefficient, 0), "drag-coefficient: found 0");
  check_refused(sink(&SinkingContainer::water_density, 0), "water-density: found 0");
  check_refused(sink(&SinkingContainer::density, 1000), "density: found 1000; allowed: more than that of the water");
}
