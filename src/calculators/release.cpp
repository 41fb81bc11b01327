// Each formula is a line; the rest says what cannot be.
#include <geodrop/calculators/release.hpp>

#include "base/text.hpp"
#include "require.hpp"

#include <cmath>
#include <numbers>
#include <string>

namespace geodrop {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double g = release_gravity;

constexpr Require require{"release"};

void require_area(double area) { require(area > 0, "area", area, "an area > 0 [m2]"); }

void check(const SplitBarge& barge) {
  require(barge.wall_slope > 0 && barge.wall_slope < pi / 2, "wall-slope", barge.wall_slope,
          "an angle from the horizontal > 0 and < pi/2 [rad]");
  require(barge.hinge_radius > 0, "hinge-radius", barge.hinge_radius, "a height above the keel > 0 [m]");
  require(barge.friction >= 0, "friction", barge.friction, "a coefficient >= 0");
}

}  // namespace

double container_weight(const ContainerSection& section) {
  require_area(section.area);
  require(section.water_density >= 0, "water-density", section.water_density, "a density >= 0 [kg/m3], 0 for air");
  require(section.density > section.water_density, "density", section.density,
          "more than the density around the container, " + format_number(section.water_density) + " kg/m3");
  return (section.density - section.water_density) * g * section.area;
}

double smallest_perimeter(double area, double opening_width) {
  require_area(area);
  require(opening_width > 0, "opening-width", opening_width, "a width > 0 [m]");
  constexpr double rule = 2.5;
  return rule * (area / opening_width + opening_width);
}

double best_opening_width(double area) {
  require_area(area);
  return std::sqrt(area);
}

double circle_share(double area, double perimeter) {
  require_area(area);
  require(perimeter > 0, "perimeter", perimeter, "a length > 0 [m]");
  const double circle = perimeter * perimeter / (4 * pi);
  require(area <= circle, "area", area,
          "at most " + format_number(circle) + " m2, the area of the circle of this perimeter");
  return area / circle;
}

double opening_tension(const ContainerSection& section) {
  constexpr double share_of_weight = 0.45;
  return share_of_weight * container_weight(section);
}

double opening_width(const SplitBarge& barge, double angle) {
  check(barge);
  require(angle >= 0 && angle <= pi / 2, "angle", angle, "an angle from 0 to pi/2 [rad]");
  return 2 * barge.hinge_radius * std::sin(angle);
}

double opening_angle(const SplitBarge& barge, double width) {
  check(barge);
  require(width >= 0 && width <= 2 * barge.hinge_radius, "opening-width", width,
          "from 0 to " + format_number(2 * barge.hinge_radius) + " m, twice the height of the hinge above the keel");
  return std::asin(width / (2 * barge.hinge_radius));
}

double neutral_height(const SplitBarge& barge) {
  check(barge);
  const double sine = std::sin(barge.wall_slope);
  return barge.hinge_radius * sine * sine;
}

double wall_force(const SplitBarge& barge, double weight, double angle) {
  check(barge);
  require(weight > 0, "weight", weight, "a weight > 0 [N/m]");
  const double slope = barge.wall_slope + angle, friction = std::atan(barge.friction);
  require(angle >= 0 && slope <= pi / 2, "angle", angle,
          "from 0 to " + format_number(pi / 2 - barge.wall_slope) + " rad, where the walls stand upright");
  require(
      slope >= friction, "angle", angle,
      "at least " + format_number(friction - barge.wall_slope) + " rad, from which friction lets the container slide");
  require(slope - friction < pi / 2, "angle", angle, "less than upright walls, where there is no friction");
  return weight / 2 * std::tan(slope - friction);
}

FreeFall free_fall(double height) {
  require(height > 0, "fall-height", height, "a height > 0 [m]");
  return {std::sqrt(2 * g * height), std::sqrt(2 * height / g)};
}

double terminal_velocity(const SinkingContainer& container) {
  require(container.volume > 0, "volume", container.volume, "a volume > 0 [m3]");
  require(container.frontal_area > 0, "frontal-area", container.frontal_area, "an area > 0 [m2]");
  require(container.drag_coefficient > 0, "drag-coefficient", container.drag_coefficient, "a coefficient > 0");
  require(container.water_density > 0, "water-density", container.water_density, "a density > 0 [kg/m3]");
  require(container.density > container.water_density, "density", container.density,
          "more than that of the water, " + format_number(container.water_density) + " kg/m3");
  return std::sqrt(2 * g * container.volume * (container.density - container.water_density) /
                   (container.frontal_area * container.drag_coefficient * container.water_density));
}

}  // namespace geodrop
