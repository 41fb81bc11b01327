// A plate on a fluid tube and tubes on tubes: exact shapes, and the balance of the forces that their membranes
// exchange.
#include <geodrop/calculators/geotube.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "support/near.hpp"
#include "support/program.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double unit_weight = 12e3, g = 9.81, fabric = 0.6;  // N/m3, m/s2, kg/m2

/// A tube that is pressed flat on `top` [m] of its crown: the tube without plate of a membrane shorter by twice that,
/// cut at the crown and drawn apart.
Geotube pressed_tube(double perimeter, double stiffness, double top, double top_pressure) {
  const double rest = perimeter - 2 * top;
  GeotubeInput input{};
  input.perimeter = rest;
  input.unit_weight = unit_weight;
  input.stiffness = stiffness * rest / perimeter;
  input.given = GeotubeQuantity::top_pressure;
  input.value = top_pressure;
  Geotube tube = solve_geotube(input);
  tube.area += top * tube.height;
  tube.width += top;
  tube.base_width += top;
  return tube;
}

/// Under a frictionless plate of `weight` [N/m], by halving the range of the pressure on it.
Geotube tube_under_plate(double perimeter, double stiffness, double area, double weight) {
  double low = weight / (0.45 * perimeter), high = 1e6;  // flat on most of its length; all but a circle
  Geotube tube{};
  for (int i = 0; i < 60; ++i) {
    const double pressure = std::sqrt(low * high);
    tube = pressed_tube(perimeter, stiffness, weight / pressure, pressure);
    (tube.area < area ? low : high) = pressure;
  }
  return tube;
}

double last(const SceneRun& run, const std::string& column) { return run.column(column).back(); }

/// 2 T + (force that presses the halves together) - (pressure on the vertical cut between them), over 2 T.
double cut_residual(const SceneRun& run, const std::string& tube, double pressed) {
  const double height = last(run, tube + ".height_m"), twice = 2 * last(run, tube + ".tension_mean_N_m");
  const double pushed = last(run, tube + ".pressure_top_Pa") * height + unit_weight * height * height / 2;
  return (twice + pressed - pushed) / twice;
}

}  // namespace

TEST_CASE("The exact tube under a plate balances its forces, and without weight is the tube without plate") {
  const double weight = 12e3, area = 5.56;
  const Geotube tube = tube_under_plate(9.2, 1e7, area, weight);
  CHECK(tube.area == near(area, 1e-9));
  CHECK(2 * tube.tension == near(tube.top_pressure * tube.height + unit_weight * tube.height * tube.height / 2, 1e-9));
  CHECK(tube.bottom_pressure * tube.base_width == near(unit_weight * area + weight, 1e-9));
  // The numbers of cases/plate_on_tube.toml.
  CHECK(tube.height == near(1.734243397, 1e-9));
  CHECK(tube.width == near(3.658858487, 1e-9));
  CHECK(tube.tension == near(19273.64262, 1e-9));
  CHECK(tube.top_pressure == near(11821.68795, 1e-9));
  CHECK(tube.bottom_pressure == near(32632.60872, 1e-9));
  CHECK(tube_under_plate(9.2, 1e7, area, 1e-3).height == near(1.806097126, 2e-8));
}

TEST_CASE("A tube under a plate takes the exact shape, and carries the plate's weight") {
  const SceneRun run("cases/plate_on_tube.toml", {}, {"--verify"});
  CHECK(run.outcome().code == 0);
  CHECK(std::abs(last(run, "plate.rotation_deg")) < 0.01);
  CHECK(std::abs(cut_residual(run, "tube", 0)) < 0.002);  // 0.0005 measured
  const SceneRun heavier("cases/plate_on_tube.toml", {"materials.slab.density=1000"}, {"--verify"});
  CHECK(heavier.outcome().code == 1);
}

TEST_CASE("One tube on another: the lower one is that under a plate, the upper one that on the ground") {
  const double stiffness = 4e6;
  const Geotube upper =
      solve_geotube({.perimeter = 4.6, .unit_weight = unit_weight, .stiffness = stiffness, .value = 1.39});
  const Geotube lower = pressed_tube(6, stiffness, upper.base_width, upper.bottom_pressure);
  CHECK(lower.area == near(2.123849479, 1e-9));
  const SceneRun run("cases/tube_on_tube.toml", {}, {"--verify"});
  CHECK(run.outcome().code == 0);
  CHECK(run.result("upper_height_m") == near(upper.height, 0.001));
  CHECK(run.result("upper_tension_mean_N_m") == near(upper.tension, 0.015));
  CHECK(run.result("lower_height_m") == near(lower.height, 0.0013));
  CHECK(run.result("lower_tension_mean_N_m") == near(lower.tension, 0.0009));
}

TEST_CASE("One tube on two: every tube is in equilibrium, with and without friction between them") {
  for (const std::string friction : {"0.0", "0.3"}) {
    CAPTURE(friction);
    const SceneRun run(
        "cases/tube_on_two_tubes.toml",
        {"contacts.0.friction=" + friction, "contacts.1.friction=" + friction, "contacts.2.friction=" + friction});
    REQUIRE(run.outcome().code == 0);
    const double weight = unit_weight * 1.39 + fabric * g * 4.6, lower = unit_weight * 1.65 + fabric * g * 4.6;
    const auto force = [&](const std::string& name) { return last(run, name); };
    const double left = force("upper.left.force_x_N_m"), right = force("upper.right.force_x_N_m");
    CHECK(force("upper.left.force_y_N_m") + force("upper.right.force_y_N_m") ==
          near(weight, 0.0045));  // with friction 0.0015: springs of contacts do not feel the cloth slide
    CHECK(std::abs(left + right) < 1e-3 * left);
    CHECK(force("left.west.normal_force_x_N_m") == near(left - force("left.right.force_x_N_m"), 1.6e-3));
    CHECK(force("left.ground.normal_force_N_m") ==
          near(lower + force("upper.left.force_y_N_m") - force("left.right.force_y_N_m"), 0.002));
  }
}
