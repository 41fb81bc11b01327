// The closed-form fall: the numbers of Kekerdom computed elsewhere, a fall integrated step by step, limits, and what
// cannot be.
#include <geodrop/calculators/fall.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "support/formulas.hpp"

using namespace geodrop;
using geodrop::test::check_refused;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

void check_equal(double found, double expected, double relative = 1e-12) {
  CAPTURE(found);
  CAPTURE(expected);
  CHECK(std::abs(found - expected) <= relative * std::abs(expected));
}

constexpr SinkingEllipse kekerdom{.along = 3.326767, .across = 0.507698, .density = 1631, .water_density = 1000};
constexpr SinkingEllipse circle{.along = 1.3, .across = 1.3, .density = 1631, .water_density = 1000};
/// 2 pi m2 that weigh 2 pi 9.81 kN/m under water, with an added mass of half the displaced water's.
constexpr SinkingEllipse plain{.along = 2, .across = 1, .density = 2000, .water_density = 1000};
constexpr Fall fall{.initial_acceleration = 3.470551246, .terminal_velocity = 3.3};

/// A fall by the classical Runge-Kutta method: no tanh, no logarithm.
FallState integrate(double time) {
  constexpr int steps = 4000;
  const double dt = time / steps;
  const auto acceleration = [](double v) {
    return fall.initial_acceleration * (1 - v * v / (fall.terminal_velocity * fall.terminal_velocity));
  };
  double z = 0, v = 0;
  for (int i = 0; i < steps; ++i) {
    const double a = acceleration(v), v2 = v + dt / 2 * a, b = acceleration(v2), v3 = v + dt / 2 * b;
    const double c = acceleration(v3), v4 = v + dt * c, d = acceleration(v4);
    z += dt / 6 * (v + 2 * v2 + 2 * v3 + v4);
    v += dt / 6 * (a + 2 * b + 2 * c + d);
  }
  return {time, z, v};
}

}  // namespace

TEST_CASE("Kekerdom: added mass, start and drag coefficients as computed elsewhere") {
  check_equal(added_mass_coefficient(kekerdom), 0.15261002649118);
  check_equal(initial_acceleration(kekerdom), 3.470551246103);
  check_equal(ellipse_area(kekerdom), 5.306127851118);
  check_equal(ellipse_perimeter(kekerdom), 13.738707230456);  // by the midpoint rule with 20000 points
  check_equal(drag_coefficient(kekerdom, 2 * kekerdom.across, 3.3), 5.940770076986);
  check_equal(drag_coefficient(kekerdom, 2 * kekerdom.across, 4.5), 3.194814130290);
}

TEST_CASE("The start: by hand, of a circle of any radius, of a plate across the fall and of a needle along it") {
  check_equal(initial_acceleration(plain), 9.81 * 1000 / 2500);
  check_equal(initial_acceleration(circle), 9.81 * 631 / 2631);
  SinkingEllipse larger = circle;
  larger.along = larger.across = 40;
  check_equal(initial_acceleration(larger), initial_acceleration(circle));
  check_equal(initial_acceleration({1e-9, 1, 2000, 1000}), 9.81 * 1000 / (2000 + 1e12));
  check_equal(initial_acceleration({1, 1e-9, 2000, 1000}), 9.81 / 2, 1e-9);  // no water is moved
}

TEST_CASE("Terminal velocity: by hand, and the coefficient that gives it back") {
  // 2 * 9.81 * 2 pi * 1000/(pi * 1000 * Cd) = 39.24/Cd
  check_equal(terminal_velocity(plain, {.coefficient = 1.09, .width = pi}), 6);
  const double coefficient = drag_coefficient(kekerdom, 0.8, 4.1);
  check_equal(terminal_velocity(kekerdom, {coefficient, 0.8}), 4.1);
}

TEST_CASE("Air: the density that is left, and the published 3.3 m/s from 4.5 m/s and 17 %") {
  check_equal(density_with_air(1631, 0.17), 1353.73);
  CHECK(density_with_air(1631, 0) == 1631);
  SinkingEllipse with_air = kekerdom;
  with_air.density = density_with_air(kekerdom.density, 0.17);
  check_equal(initial_acceleration(with_air), 2.303657367509);
  const double width = 2 * kekerdom.across;
  check_equal(terminal_velocity(with_air, {drag_coefficient(kekerdom, width, 4.5), width}), 3.369254221561);
}

TEST_CASE("A fall is that of its equation of motion, integrated step by step") {
  check_equal(time_scale(fall), 3.3 / 3.470551246);
  for (const double time : {0.2, 0.9, 1.1, 4.0}) {  // the logarithm changes its form at 0.95 s
    const FallState expected = integrate(time), found = fall_until(fall, time);
    CHECK(found.time == time);
    check_equal(found.way, expected.way, 1e-10);
    check_equal(found.speed, expected.speed, 1e-10);
  }
}

TEST_CASE("Limits: at first v = a0 t and z = a0 t^2/2, in the end terminal velocity, late by tau ln 2") {
  const double a0 = fall.initial_acceleration, tau = time_scale(fall);
  CHECK(fall_until(fall, 0).way == 0);
  CHECK(fall_until(fall, 0).speed == 0);
  check_equal(fall_until(fall, 1e-7).speed, a0 * 1e-7);
  check_equal(fall_until(fall, 1e-7).way, a0 * 1e-14 / 2);
  const FallState end = fall_until(fall, 1e4);  // cosh of it has no number
  check_equal(end.speed, 3.3);
  check_equal(end.way, 3.3 * (1e4 - tau * std::numbers::ln2));
  check_equal(fall_through(fall, 1e-14).speed, std::sqrt(2 * a0 * 1e-14));
  check_equal(fall_through(fall, 3e4).speed, 3.3);
}

TEST_CASE("The way gives back time and speed, from a hair to far beyond the terminal velocity") {
  for (const double time : {1e-6, 0.3, 1.0, 2.6, 50.0, 1e4}) {
    const FallState there = fall_until(fall, time), back = fall_through(fall, there.way);
    check_equal(back.time, there.time);
    check_equal(back.speed, there.speed);
    CHECK(back.way == there.way);
  }
  CHECK(fall_through(fall, 0).time == 0);
  check_equal(fall_through(fall, 9.8).time, 3.6283203, 1e-7);  // integrated elsewhere in steps of 0.1 ms
  check_equal(fall_through(fall, 9.8).speed, 3.2968016, 1e-7);
}

TEST_CASE("Without drag: by hand, faster than any fall, the limit of little drag") {
  check_equal(fall_without_drag(4, 2).speed, 4);
  check_equal(fall_without_drag(4, 2).time, 1);
  CHECK(fall_without_drag(fall.initial_acceleration, 9.8).speed > fall_through(fall, 9.8).speed);
  check_equal(fall_through({4, 1e7}, 2).speed, 4);
  check_equal(fall_through({4, 1e7}, 2).time, 1);
}

TEST_CASE("Landing: energies by hand, their loss on the way is that of the drag, tension that stores them") {
  check_equal(kinetic_energy(plain, 2), 2500 * 2 * pi * 4 / 2);
  CHECK(kinetic_energy(plain, 0) == 0);
  check_equal(settling_energy(plain), 1000 * 9.81 * 2 * pi * 2);
  // Without drag the weight under water turns into kinetic energy, metre by metre; 2 m are the semi-axis.
  check_equal(kinetic_energy(plain, fall_without_drag(initial_acceleration(plain), 2).speed), settling_energy(plain));
  // 13.7 m that carry 100 kN/m at 1000 kN/m are stretched by 10 %: 13.7 * 100e3 * 0.1/2.
  check_equal(tension_bound(68.5e3, 1e6, 13.7), 100e3);
  CHECK(tension_bound(0, 1e6, 13.7) == 0);
}

TEST_CASE("Perimeter and area give an upright ellipse: Kekerdom's, a circle, a nearly empty one") {
  const SemiAxes found = upright_ellipse(13.738705, 5.306122);
  check_equal(found.along, 3.326767, 2e-7);  // the digits of the source
  check_equal(found.across, 0.507698, 2e-6);
  for (const double r : {0.8, 0.9, 1.0, 1.6, 1.7, 2.1, 2.5}) {  // of some the perimeter is too long by rounding
    const double perimeter = 2 * pi * r;
    check_equal(upright_ellipse(perimeter, perimeter * perimeter / (4 * pi)).along, r, 1e-6);
  }
  // Perimeter and area hardly tell a circle from an ellipse near it.
  check_equal(upright_ellipse(2 * pi * 1.3 * (1 + 1e-14), pi * 1.69).along, 1.3, 1e-6);
  const SemiAxes flat = upright_ellipse(10, 1e-3);
  check_equal(4 * flat.along, 10, 1e-5);  // twice there and back
  check_equal(pi * flat.along * flat.across, 1e-3);
}

TEST_CASE("What cannot be is refused by the name of its key") {
  const double inf = std::numeric_limits<double>::infinity();
  const auto with = [](double SinkingEllipse::*value, double wrong) {
    SinkingEllipse ellipse = kekerdom;
    ellipse.*value = wrong;
    return [ellipse] { return initial_acceleration(ellipse); };
  };
  check_refused(with(&SinkingEllipse::along, 0), "fall: semi-axes: found 0; allowed: a length > 0 [m]");
  check_refused(with(&SinkingEllipse::across, -1), "semi-axes: found -1");
  check_refused(with(&SinkingEllipse::water_density, 0), "water-density: found 0");
  check_refused(with(&SinkingEllipse::density, 1000),
                "density: found 1000; allowed: more than that of the water, 1000");
  check_refused(with(&SinkingEllipse::density, no_number), "density: found nan");
  check_refused([] { return density_with_air(1631, 1); }, "air: found 1; allowed: a share of the volume >= 0 and < 1");
  check_refused([] { return density_with_air(1631, -0.1); }, "air: found -0.1");
  check_refused([] { return density_with_air(0, 0.1); }, "density: found 0");
  check_refused([] { return terminal_velocity(kekerdom, {1, 0}); }, "width: found 0; allowed: a width > 0 [m]");
  check_refused([] { return terminal_velocity(kekerdom, {0, 1}); }, "drag-coefficient: found 0");
  check_refused([] { return drag_coefficient(kekerdom, 1, 0); }, "terminal-velocity: found 0");
  check_refused([] { return fall_until(fall, -1).way; }, "time: found -1; allowed: a time >= 0 [s]");
  check_refused([=] { return fall_until({inf, 1}, 1).way; }, "initial-acceleration: found inf");
  check_refused([] { return time_scale({0, 1}); }, "initial-acceleration: found 0");
  check_refused([] { return time_scale({1, 0}); }, "terminal-velocity: found 0");
  check_refused([] { return fall_through(fall, -1).time; }, "fall-height: found -1; allowed: a height >= 0 [m]");
  check_refused([] { return fall_without_drag(0, 1).time; }, "initial-acceleration: found 0");
  check_refused([] { return fall_without_drag(1, -1).time; }, "fall-height: found -1");
  check_refused([] { return kinetic_energy(kekerdom, -1); }, "speed: found -1");
  check_refused([] { return tension_bound(-1, 1, 1); }, "energy: found -1");
  check_refused([] { return tension_bound(1, 0, 1); }, "stiffness: found 0");
  check_refused([] { return tension_bound(1, 1, 0); }, "perimeter: found 0");
  check_refused([] { return upright_ellipse(10, 9).along; }, "area: found 9; allowed: at most 7.95774715 m2");
  check_refused([] { return upright_ellipse(10, 0).along; }, "area: found 0");
  check_refused([] { return upright_ellipse(0, 1).along; }, "perimeter: found 0");
}
