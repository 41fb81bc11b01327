// The exact tube against tables computed elsewhere by other means, against its own equilibrium, and in its limits.
#include <geodrop/base/error.hpp>
#include <geodrop/calculators/geotube.hpp>

#include "calculators/membrane_path.hpp"
#include "plot/csv_table.hpp"
#include "support/near.hpp"
#include "support/scene_files.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double kilo = 1e3;

/// The tube of the paper's three fills.
GeotubeInput paper_tube(double area) { return {.perimeter = 9.2, .unit_weight = 12e3, .value = area}; }

GeotubeInput in_water(GeotubeInput tube, double level, double unit_weight = 9810) {
  tube.water = {level, unit_weight};
  return tube;
}

void check_equal(double found, double expected, double tolerance) { CHECK(found == near(expected, tolerance)); }

CsvTable table(const std::string& name) { return read_csv(source_path("tests/data/" + name)); }

/// Of the polygon of an outline, clipped at a level: area, and its first moment about the ground.
struct Moments {
  double area = 0, moment = 0;
};

Moments below(const std::vector<OutlinePoint>& outline, double level) {
  Moments sum;
  for (std::size_t i = 0; i + 1 < outline.size(); ++i) {
    const double z0 = std::min(outline[i].z, level), z1 = std::min(outline[i + 1].z, level);
    const double dx = outline[i + 1].x - outline[i].x;
    sum.area += dx * (z0 + z1) / 2;
    sum.moment += dx * (z0 * z0 + z0 * z1 + z1 * z1) / 6;
  }
  return sum;
}

constexpr int many = 20000;  // segments: the polygon's area then is right to some 2e-8

/// Equal areas on every side: 1e-7 covers polygon and clipping.
void check_equilibrium(const Geotube& tube) {
  const double hw = std::min(tube.water.level, tube.height), water = tube.water.unit_weight;
  const std::vector<OutlinePoint> outline = geotube_outline(tube, many);
  const Moments wet = below(outline, hw), all = below(outline, tube.height);
  check_equal(all.area, tube.area, 1e-7);
  check_equal(2 * tube.tension,
              tube.top_pressure * tube.height + tube.unit_weight * tube.height * tube.height / 2 - water * hw * hw / 2,
              1e-10);
  check_equal(tube.bottom_pressure * tube.base_width, tube.unit_weight * tube.area - water * wet.area, 1e-6);
  check_equal(tube.length, tube.perimeter * (1 + tube.strain), 1e-12);
}

/// Potential energy of fill, of water that gave way, and of the membrane [J/m].
double energy(const GeotubeInput& input, const Geotube& tube) {
  const std::vector<OutlinePoint> outline = geotube_outline(tube, many);
  const Moments all = below(outline, tube.height), wet = below(outline, std::min(tube.water.level, tube.height));
  return tube.unit_weight * all.moment + tube.water.unit_weight * (tube.water.level * wet.area - wet.moment) +
         tube.tension * tube.strain * input.perimeter / 2;
}

/// What `solve` says when it refuses; empty if it does not.
std::string refusal(const GeotubeInput& input) {
  try {
    solve_geotube(input);
  } catch (const SceneError& error) {
    return error.what();
  }
  return {};
}

void check_refused(const GeotubeInput& input, const std::string& says) {
  const std::string said = refusal(input);
  CAPTURE(said);
  CHECK(said.find(says) != std::string::npos);
}

}  // namespace

TEST_CASE("The paper's three fills agree with the table of elliptic integrals in every column") {
  const CsvTable exact = table("geotube_three_cases.csv");
  REQUIRE(exact.rows() == 3);
  for (std::size_t i = 0; i < exact.rows(); ++i) {
    const Geotube tube = solve_geotube(paper_tube(exact.column("A_m2")[i]));
    const auto check = [&](const char* column, double found) { check_equal(found, exact.column(column)[i], 1e-11); };
    check("H_m", tube.height);
    check("W_m", tube.width);
    check("H_over_W", tube.height / tube.width);
    check("base_width_B_m", tube.base_width);
    check("height_of_max_width_m", tube.width_level);
    check("p_top_kPa", tube.top_pressure / kilo);
    check("p_bottom_kPa", tube.bottom_pressure / kilo);
    check("T_kN_per_m", tube.tension / kilo);
    check_equal(tube.length, 9.2, 1e-14);
    check_equilibrium(tube);
  }
}

TEST_CASE("Tubes that stretch agree with the table of axial stiffnesses") {
  const CsvTable exact = table("geotube_extensible.csv");
  REQUIRE(exact.rows() == 21);
  for (std::size_t i = 0; i < exact.rows(); ++i) {
    GeotubeInput input = paper_tube(exact.column("A_m2")[i]);
    input.stiffness = kilo * exact.column("J_kN_per_m")[i];
    const Geotube tube = solve_geotube(input);
    const auto check = [&](const char* column, double found) { check_equal(found, exact.column(column)[i], 2e-9); };
    check("L_stretched_m", tube.length);
    check("strain", tube.strain);
    check("H_m", tube.height);
    check("W_m", tube.width);
    check("B_m", tube.base_width);
    check("p_top", tube.top_pressure / kilo);
    check("p_bot", tube.bottom_pressure / kilo);
    check("T", tube.tension / kilo);
    check_equal(tube.tension, input.stiffness * tube.strain, 1e-12);
  }
}

TEST_CASE("The membrane passes through every point of the tabulated outline") {
  const CsvTable exact = table("geotube_shape_A5.56.csv");
  const Geotube tube = solve_geotube(paper_tube(5.56));
  const MembranePath path({tube.top_pressure, tube.bottom_pressure, tube.tension, tube.height, 12e3, 12e3, 0});
  for (std::size_t i = 0; i < exact.rows(); ++i) {
    const double s = exact.column("s_m")[i];
    if (s > path.end().s) break;  // the base follows
    const PathPoint point = path.at(s);
    CHECK(std::abs(point.x - exact.column("x_m")[i]) < 1e-10);
    CHECK(std::abs(tube.height - point.y - exact.column("z_m")[i]) < 1e-10);
    CHECK(std::abs(point.theta - exact.column("theta_rad")[i]) < 1e-10);
    check_equal(point.pressure / kilo, exact.column("p_kPa")[i], 1e-10);
  }
}

TEST_CASE("The outline is even, symmetric, closed, and its curvature times the tension is the pressure") {
  for (const GeotubeInput& input : {paper_tube(5.56), in_water(paper_tube(5.56), 0.9), in_water(paper_tube(3.36), 3)}) {
    const Geotube tube = solve_geotube(input);
    const int segments = 1000;
    const std::vector<OutlinePoint> points = geotube_outline(tube, segments);
    REQUIRE(points.size() == 1001);
    const double step = tube.length / segments;
    for (int i = 0; i <= segments; ++i) {
      const OutlinePoint &a = points[i], &mirrored = points[segments - i];
      CHECK(std::abs(a.s - i * step) < 1e-12);
      CHECK(std::abs(a.x + mirrored.x) < 1e-12);
      CHECK(std::abs(a.z - mirrored.z) < 1e-12);
      CHECK(std::abs(a.theta + mirrored.theta - 2 * pi) < 1e-12);
      if (i == 0 || i == segments) continue;
      const OutlinePoint &before = points[i - 1], &after = points[i + 1];
      CHECK(std::hypot(after.x - a.x, after.z - a.z) <= step * (1 + 1e-12));
      const bool bends_evenly =
          before.z > 0 && after.z > 0 && (before.z > input.water.level) == (after.z > input.water.level);
      if (bends_evenly)  // differences of second order
        check_equal(tube.tension * (after.theta - before.theta) / (2 * step), a.pressure, 2e-4);
    }
    CHECK(points[segments / 2].z == 0);
    CHECK(points[segments / 2].pressure == tube.bottom_pressure);
    CHECK(points.front().z == tube.height);
    CHECK(points.front().pressure == tube.top_pressure);
  }
}

TEST_CASE("Perimeter and unit weight only scale: H with L, pressures with gamma L, T with gamma L^2") {
  const Geotube one = solve_geotube(paper_tube(5.56));
  GeotubeInput scaled = paper_tube(4 * 5.56);
  scaled.perimeter *= 2;
  scaled.unit_weight *= 3;
  const Geotube other = solve_geotube(scaled);
  check_equal(other.height, 2 * one.height, 1e-12);
  check_equal(other.width, 2 * one.width, 1e-12);
  check_equal(other.top_pressure, 6 * one.top_pressure, 1e-12);
  check_equal(other.tension, 12 * one.tension, 1e-12);
}

TEST_CASE("Area, height, top pressure and tension each lead back to the same tube") {
  std::vector<GeotubeInput> inputs;
  const double circle = 9.2 * 9.2 / (4 * pi);
  for (const double part : {0.02, 0.3, 0.825, 0.957, 0.9999}) {
    for (const double stiffness : {std::numeric_limits<double>::infinity(), 1e6, 2e5}) {
      for (const OutsideWater& water : {OutsideWater{}, OutsideWater{0.4, 9810}, OutsideWater{5, 9810}}) {
        inputs.push_back(paper_tube(part * circle));
        inputs.back().stiffness = stiffness;
        inputs.back().water = water;
      }
    }
  }
  inputs.push_back(in_water(paper_tube(5.56), 1.0, 12e3));  // fill and water of the same weight
  inputs.push_back(in_water(paper_tube(5.56), 1.0, 14e3));  // a fill lighter than the water
  for (const GeotubeInput& input : inputs) {
    const Geotube tube = solve_geotube(input);
    CAPTURE(input.value);
    CAPTURE(input.stiffness);
    CAPTURE(input.water.level);
    std::vector<std::pair<GeotubeQuantity, double>> known{{GeotubeQuantity::area, tube.area},
                                                          {GeotubeQuantity::height, tube.height},
                                                          {GeotubeQuantity::tension, tube.tension}};
    // A flat tube whose crown has just come out of the water shares its top pressure with a submerged one.
    const bool has_just_emerged = tube.height > tube.water.level && tube.height < 2 * tube.water.level;
    if (!has_just_emerged) known.emplace_back(GeotubeQuantity::top_pressure, tube.top_pressure);
    for (const auto& [quantity, value] : known) {
      GeotubeInput again = input;
      again.given = quantity;
      again.value = value;
      const Geotube same = solve_geotube(again);
      check_equal(same.area, input.value, 1e-8);
      check_equal(same.height, tube.height, 1e-8);
      check_equal(same.width, tube.width, 1e-8);
      check_equal(same.base_width, tube.base_width, 1e-8);
      check_equal(same.top_pressure, tube.top_pressure, 1e-8);
      check_equal(same.bottom_pressure, tube.bottom_pressure, 1e-8);
      check_equal(same.tension, tube.tension, 1e-8);
      check_equal(same.length, tube.length, 1e-8);
    }
  }
}

TEST_CASE(
    "Of the tubes that share a top pressure the submerged one is given; above, pressure and height rise together") {
  const double level = 0.4;
  GeotubeInput input = in_water(paper_tube(1), level);
  input.given = GeotubeQuantity::height;
  const auto of_height = [&](double height) {
    input.value = height;
    return solve_geotube(input);
  };
  const double touching = of_height(level).top_pressure;
  CHECK(of_height(1.05 * level).top_pressure < touching);  // so that there are others
  GeotubeInput by_pressure = input;
  by_pressure.given = GeotubeQuantity::top_pressure;
  for (const double share : {0.5, 0.99}) {
    by_pressure.value = share * touching;
    const Geotube tube = solve_geotube(by_pressure);
    CHECK(tube.height < level);
    check_equal(tube.top_pressure, by_pressure.value, 1e-10);
  }
  double before = level;
  for (const double share : {1.01, 2.0, 10.0, 1000.0}) {
    by_pressure.value = share * touching;
    const Geotube tube = solve_geotube(by_pressure);
    CHECK(tube.height > before);
    check_equal(tube.top_pressure, by_pressure.value, 1e-10);
    before = tube.height;
  }
}

TEST_CASE("A nearly full tube is a circle with T = p R") {
  const double radius = 9.2 / (2 * pi), circle = pi * radius * radius;
  for (const double missing : {1e-4, 1e-6, 1e-8}) {
    const Geotube tube = solve_geotube(paper_tube(circle * (1 - missing)));
    const double p_middle = (tube.top_pressure + tube.bottom_pressure) / 2, small = std::sqrt(missing);
    CAPTURE(missing);
    check_equal(tube.height, 2 * radius, small);
    check_equal(tube.width, 2 * radius, small);
    check_equal(tube.tension, p_middle * radius, small);
    CHECK(tube.base_width < 10 * small);
    // The closed form and the integrated membrane are independent: their lengths and areas must agree to round-off.
    const MembranePath path({tube.top_pressure, tube.bottom_pressure, tube.tension, tube.height, 12e3, 12e3, 0});
    check_equal(2 * (path.end().s + path.end().x), 9.2, 1e-12);
    check_equal(path.end().area, circle * (1 - missing), 1e-12);
    CHECK(std::abs(2 * path.end().x - tube.base_width) < 1e-13);
  }
}

TEST_CASE("A nearly empty tube: T = gamma H^2/4, A = H B, ln(p_top/p_bottom) = ln 4 - 1 - L/(2H)") {
  const double circle = 9.2 * 9.2 / (4 * pi);
  for (const double part : {0.006, 0.02, 0.05}) {
    const Geotube tube = solve_geotube(paper_tube(part * circle));
    check_equal(tube.tension, 12e3 * tube.height * tube.height / 4, 1e-12);
    check_equal(tube.area, tube.height * tube.base_width, 1e-12);
    check_equal(std::log(tube.top_pressure / tube.bottom_pressure), std::log(4) - 1 - 9.2 / (2 * tube.height), 1e-10);
  }
}

TEST_CASE("Filling costs the fill's pressure at the ground: dE/dA = p") {
  GeotubeInput soft = paper_tube(5.56);
  soft.stiffness = 2e5;
  for (const GeotubeInput& input : {paper_tube(5.56), soft, in_water(paper_tube(5.56), 0.9), in_water(soft, 1.2),
                                    in_water(paper_tube(3.36), 4), in_water(paper_tube(6), 1, 13e3)}) {
    constexpr double change = 0.005;  // [m2]; what is left of the second order is 5e-6
    GeotubeInput less = input, more = input;
    less.value -= change;
    more.value += change;
    const double rise = energy(more, solve_geotube(more)) - energy(less, solve_geotube(less));
    check_equal(rise / (2 * change), solve_geotube(input).fill_pressure_bottom, 1e-5);
  }
}

TEST_CASE("Partly submerged: the published tube, equilibrium, and the limits of little and much water") {
  const double half = solve_geotube(paper_tube(5.56)).height / 2;
  const Geotube tube = solve_geotube(in_water(paper_tube(5.56), half));
  CHECK(std::abs(tube.height - 1.78535676) < 1e-8);
  CHECK(std::abs(tube.width - 3.68304708) < 1e-8);
  CHECK(std::abs(tube.top_pressure / kilo - 2.805257) < 1e-6);
  CHECK(std::abs(tube.tension / kilo - 10.054225) < 1e-6);
  check_equilibrium(tube);
  check_equilibrium(solve_geotube(in_water(paper_tube(5.56), 1.0, 12e3)));
  check_equilibrium(solve_geotube(in_water(paper_tube(5.56), 1.0, 14e3)));
  check_equal(tube.fill_pressure_top, tube.top_pressure, 1e-15);
  check_equal(tube.fill_pressure_bottom, tube.top_pressure + 12e3 * tube.height, 1e-14);

  const Geotube dry = solve_geotube(paper_tube(5.56)), hardly = solve_geotube(in_water(paper_tube(5.56), 1e-6));
  check_equal(hardly.height, dry.height, 1e-9);
  check_equal(hardly.tension, dry.tension, 1e-9);
  check_equal(hardly.base_width, dry.base_width, 1e-9);
}

TEST_CASE("Submerged: the dry shape, pressures and tension with the difference of the unit weights") {
  const Geotube dry = solve_geotube(paper_tube(5.56));
  const double share = (12e3 - 9810) / 12e3;
  for (const double level : {dry.height * (1 + 1e-12), 2.0, 13.0}) {
    const Geotube tube = solve_geotube(in_water(paper_tube(5.56), level));
    check_equal(tube.height, dry.height, 1e-11);
    check_equal(tube.width, dry.width, 1e-11);
    check_equal(tube.tension, share * dry.tension, 1e-11);
    check_equal(tube.bottom_pressure, share * dry.bottom_pressure, 1e-11);
    check_equal(tube.fill_pressure_top, tube.top_pressure + 9810 * (level - tube.height), 1e-11);
    check_equal(tube.fill_pressure_bottom, tube.fill_pressure_top + 12e3 * tube.height, 1e-11);
  }
  const Geotube just = solve_geotube(in_water(paper_tube(5.56), dry.height * (1 - 1e-7)));  // an island of nothing
  check_equal(just.tension, share * dry.tension, 1e-6);
}

TEST_CASE("What has no solution is refused with the limit") {
  const double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  check_refused(paper_tube(6.74), "area: found 6.74; allowed: less than 6.73543719 m2, the area of the circle");
  check_refused(paper_tube(0.03),
                "area: found 0.03; allowed: more than 0.0377844467 m2; flatter tubes are not computed");
  check_refused(paper_tube(-1), "area: found -1; allowed: a value > 0 [m2]");
  check_refused(paper_tube(nan), "area: found nan");
  GeotubeInput input = paper_tube(3);
  input.given = GeotubeQuantity::height;
  check_refused(input, "height: found 3; allowed: less than 2.92845095 m, the diameter of the circle");
  input.given = GeotubeQuantity::top_pressure;
  input.value = 0;
  check_refused(input, "pressure: found 0; allowed: a value > 0 [Pa]");
  input.given = GeotubeQuantity::tension;
  input.value = infinity;
  check_refused(input, "tension: found inf; allowed: a value > 0 [N/m]");

  GeotubeInput soft = paper_tube(25);
  soft.stiffness = 1e5;
  check_refused(soft, "area: found 25; allowed: less than 24.2751284 m2, where the membrane's strain is 1");
  soft.value = 24.275;
  CHECK(solve_geotube(soft).strain > 0.999);
  soft.stiffness = -1;
  check_refused(soft, "stiffness: found -1; allowed: an axial stiffness > 0 [N/m]");
  soft.stiffness = 1e-3;
  check_refused(soft, "stiffness: found 0.001; allowed: more than 0.203136 N/m");

  GeotubeInput odd = paper_tube(5.56);
  odd.perimeter = 0;
  check_refused(odd, "perimeter: found 0; allowed: a length > 0 [m]");
  odd = paper_tube(5.56);
  odd.unit_weight = 0;
  check_refused(odd, "unit-weight: found 0; allowed: a unit weight > 0 [N/m3]");
  check_refused(in_water(paper_tube(5.56), -1), "water-level: found -1; allowed: a height above the ground >= 0 [m]");
  check_refused(in_water(paper_tube(5.56), 1, 0), "water-unit-weight: found 0; allowed: a unit weight > 0 [N/m3]");
}

TEST_CASE("A membrane too soft for its fill is refused, though its curve is followed in a million pieces") {
  CHECK_THROWS_AS(
      solve_geotube({.perimeter = 7, .unit_weight = 16000, .stiffness = 0.5, .water = {1, 1}, .value = 2.8}),
      SceneError);
}

TEST_CASE("A tube that floats is refused with the highest water in which it rests") {
  const GeotubeInput deep = in_water(paper_tube(5.56), 5, 14e3);
  const std::string said = refusal(deep), before = "water-level: found 5; allowed: at most ";
  CAPTURE(said);
  REQUIRE(said.find(before) != std::string::npos);
  CHECK(said.find("above which this tube floats") != std::string::npos);
  const double limit = std::stod(said.substr(said.find(before) + before.size()));
  const Geotube resting = solve_geotube(in_water(deep, limit * (1 - 1e-6), 14e3));
  const Moments wet = below(geotube_outline(resting, many), resting.water.level);
  check_equal(14e3 * wet.area, 12e3 * 5.56, 1e-4);  // it almost swims
  check_refused(in_water(deep, limit * (1 + 1e-6), 14e3), "above which this tube floats");
  check_refused(in_water(paper_tube(5.56), 5, 12e3), "above which this tube floats");
  CHECK_FALSE(find_geotube(in_water(deep, limit * (1 + 1e-6), 14e3)));
  REQUIRE(find_geotube(in_water(deep, limit * (1 - 1e-6), 14e3)));
  CHECK(find_geotube(paper_tube(5.56))->tension == solve_geotube(paper_tube(5.56)).tension);
}
