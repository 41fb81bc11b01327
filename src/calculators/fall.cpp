#include <geodrop/calculators/fall.hpp>
#include <geodrop/calculators/release.hpp>

#include "find_root.hpp"
#include "geometry/ellipse.hpp"
#include "require.hpp"

#include <cmath>
#include <numbers>

namespace geodrop {
namespace {

constexpr double pi = std::numbers::pi;

constexpr Require require{"fall"};

void check(const SinkingEllipse& ellipse) {
  for (const double semi_axis : {ellipse.along, ellipse.across})
    require(semi_axis > 0, "semi-axes", semi_axis, "a length > 0 [m]");
  require(ellipse.water_density > 0, "water-density", ellipse.water_density, "a density > 0 [kg/m3]");
  require(ellipse.density > ellipse.water_density, "density", ellipse.density,
          "more than that of the water, " + format_number(ellipse.water_density) + " kg/m3");
}

void check(const Fall& fall) {
  require(fall.initial_acceleration > 0, "initial-acceleration", fall.initial_acceleration,
          "an acceleration > 0 [m/s2]");
  require(fall.terminal_velocity > 0, "terminal-velocity", fall.terminal_velocity, "a speed > 0 [m/s]");
}

void require_height(double height) { require(height >= 0, "fall-height", height, "a height >= 0 [m]"); }

double weight_in_water(const SinkingEllipse& ellipse) {
  return container_weight({ellipse_area(ellipse), ellipse.density, ellipse.water_density});
}

/// Mass of container and added mass over the area [kg/m3].
double moved_density(const SinkingEllipse& ellipse) {
  return ellipse.density + added_mass_coefficient(ellipse) * ellipse.water_density;
}

SemiAxes axes_of_ratio(double area, double ratio) {
  return {std::sqrt(area * ratio / pi), std::sqrt(area / ratio / pi)};
}

double perimeter_of(const SemiAxes& axes) {
  return ellipse_perimeter(EllipseShape{.centre = {}, .semi_axes = {axes.along, axes.across}});
}

/// ln cosh x, x >= 0: neither loses digits near 0 nor overflows.
double log_cosh(double x) {
  if (x > 1) return x + std::log1p(std::exp(-2 * x)) - std::numbers::ln2;
  const double sine = std::sinh(x / 2);
  return std::log1p(2 * sine * sine);
}

}  // namespace

SemiAxes upright_ellipse(double perimeter, double area) {
  const double share = circle_share(area, perimeter);
  const auto excess = [&](double log_ratio) {
    return perimeter_of(axes_of_ratio(area, std::exp(log_ratio))) / perimeter - 1;
  };
  if (excess(0) >= 0) return axes_of_ratio(area, 1);  // the circle, to rounding
  // A perimeter is at least four longer semi-axes, 4 sqrt(A ratio/pi): with this ratio it is longer than what is
  // sought.
  const double largest_ratio = 4 / share;
  return axes_of_ratio(area, std::exp(find_root(excess, 0, std::log(largest_ratio))));
}

double ellipse_area(const SinkingEllipse& ellipse) {
  check(ellipse);
  return pi * ellipse.along * ellipse.across;
}

double ellipse_perimeter(const SinkingEllipse& ellipse) {
  check(ellipse);
  return perimeter_of({ellipse.along, ellipse.across});
}

double density_with_air(double density, double share) {
  require(density > 0, "density", density, "a density > 0 [kg/m3]");
  require(share >= 0 && share < 1, "air", share, "a share of the volume >= 0 and < 1");
  return (1 - share) * density;
}

double added_mass_coefficient(const SinkingEllipse& ellipse) {
  check(ellipse);
  return ellipse.across / ellipse.along;
}

double initial_acceleration(const SinkingEllipse& ellipse) {
  return weight_in_water(ellipse) / (moved_density(ellipse) * ellipse_area(ellipse));
}

double terminal_velocity(const SinkingEllipse& ellipse, const Drag& drag) {
  require(drag.width > 0, "width", drag.width, "a width > 0 [m]");
  return terminal_velocity({.volume = ellipse_area(ellipse),
                            .frontal_area = drag.width,
                            .drag_coefficient = drag.coefficient,
                            .density = ellipse.density,
                            .water_density = ellipse.water_density});
}

double drag_coefficient(const SinkingEllipse& ellipse, double width, double terminal_velocity) {
  require(terminal_velocity > 0, "terminal-velocity", terminal_velocity, "a speed > 0 [m/s]");
  const double with_one = geodrop::terminal_velocity(ellipse, {.coefficient = 1, .width = width});
  return with_one * with_one / (terminal_velocity * terminal_velocity);
}

double time_scale(const Fall& fall) {
  check(fall);
  return fall.terminal_velocity / fall.initial_acceleration;
}

FallState fall_until(const Fall& fall, double time) {
  require(time >= 0, "time", time, "a time >= 0 [s]");
  const double tau = time_scale(fall), v = fall.terminal_velocity;
  return {time, v * tau * log_cosh(time / tau), v * std::tanh(time / tau)};
}

FallState fall_through(const Fall& fall, double height) {
  require_height(height);
  const double tau = time_scale(fall), q = height / (fall.terminal_velocity * tau);
  const double share = std::sqrt(-std::expm1(-2 * q));  // of the terminal velocity
  return {tau * (q + std::log1p(share)), height, fall.terminal_velocity * share};
}

FallState fall_without_drag(double initial_acceleration, double height) {
  require(initial_acceleration > 0, "initial-acceleration", initial_acceleration, "an acceleration > 0 [m/s2]");
  require_height(height);
  return {std::sqrt(2 * height / initial_acceleration), height, std::sqrt(2 * initial_acceleration * height)};
}

double kinetic_energy(const SinkingEllipse& ellipse, double speed) {
  require(speed >= 0, "speed", speed, "a speed >= 0 [m/s]");
  return moved_density(ellipse) * ellipse_area(ellipse) * speed * speed / 2;
}

double settling_energy(const SinkingEllipse& ellipse) { return weight_in_water(ellipse) * ellipse.along; }

double tension_bound(double energy, double stiffness, double perimeter) {
  require(energy >= 0, "energy", energy, "an energy >= 0 [J/m]");
  require(stiffness > 0, "stiffness", stiffness, "an axial stiffness > 0 [N/m]");
  require(perimeter > 0, "perimeter", perimeter, "a length > 0 [m]");
  return std::sqrt(2 * energy * stiffness / perimeter);
}

}  // namespace geodrop
