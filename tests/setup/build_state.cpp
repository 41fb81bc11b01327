// The state at t = 0 from a scene: membranes, tracers, velocities, arrays of absent features.
#include <doctest/doctest.h>
#include <geodrop/geometry/shapes.hpp>
#include <geodrop/step/pipeline.hpp>

#include <numbers>

#include "membrane/triangles.hpp"
#include "support/near.hpp"
#include "support/scene_files.hpp"

using namespace geodrop;
using namespace geodrop::test;

TEST_CASE("The geotextile of the main case has the mass of its rest length, evenly, and no tension") {
  for (const double slack : {0.0, 0.07}) {
    CAPTURE(slack);
    const Scene scene = read_scene(source_path("cases/dump_kekerdom_mixture.toml"),
                                   {"membranes.geotextile.slack=" + std::to_string(slack)});
    const State<2> state = build_state<2>(scene);
    REQUIRE(state.membranes.size() == 1);
    const Membrane<2>& m = state.membranes[0];
    const double perimeter = 13.738705;  // reference: circumference of the ellipse of Kekerdom [m]
    double mass = 0, rest = 0;
    for (const double each : m.mass) mass += each;
    for (const double each : m.rest_length) rest += each;
    // Chords of h/4 on a radius of at least 0.077 m at the tips: a few 1e-4 shorter than the arc.
    CHECK(rest == near(perimeter * (1 + slack), 1e-3));
    CHECK(mass == near(0.63 * perimeter * (1 + slack), 1e-3));
    CHECK(mass == near(0.63 * rest, 1e-12));
    CHECK(m.closed);
    CHECK(m.segments() == m.nodes());
    const double spacing = rest / (1 + slack) / static_cast<double>(m.segments());
    CHECK(spacing == near(0.25 / 4, 0.003));
    for (const double T : m.tension) CHECK(T == 0);
    for (std::size_t k = 0; k < m.nodes(); ++k)
      CHECK(distance_to_outline(scene.bodies[2].shape, {m.x[0][k], m.x[1][k]}) < 1e-6);
  }
}

TEST_CASE("The container of the main case has the area of the field test, and its weight") {
  const State<2> state = build_state<2>(read_scene(source_path("cases/dump_kekerdom_mixture.toml")));
  double mass = 0;
  for (const double m : state.bodies[2].mass) mass += m;
  CHECK(mass == near(1631 * 130 / 24.5, 3e-6));
}

TEST_CASE("A bar in its first mode moves with v0 sin(pi x / 2 L), its affine rate is the derivative") {
  const State<2> state = build_state<2>(read_scene(source_path("cases/elastic_bar.toml")));
  const Body<2>& bar = state.bodies[0];
  const double k = std::numbers::pi / 50;
  double fastest = 0;
  for (std::size_t p = 0; p < bar.size(); ++p) {
    CHECK(bar.v[0][p] == near(0.1 * std::sin(k * bar.x[0][p]), 1e-12));
    CHECK(bar.v[1][p] == 0);
    CHECK(bar.affine[0][p] == near(0.1 * k * std::cos(k * bar.x[0][p]), 1e-12));
    for (int c = 1; c < 4; ++c) CHECK(bar.affine[c][p] == 0);
    fastest = std::max(fastest, bar.v[0][p]);
  }
  CHECK(state.v_max == near(fastest, 1e-14));
}

TEST_CASE("A linear field: v = gradient (x - centre), and the gradient goes with the particles") {
  const std::string field = "{type='linear', gradient=[[0.5, -2.0], [3.0, 0.25]], centre=[1.0, 2.0]}";
  const State<2> state =
      build_state<2>(read_scene(source_path("cases/elastic_bar.toml"), {"bodies.bar.initial_velocity=" + field}));
  const Body<2>& bar = state.bodies[0];
  for (std::size_t p = 0; p < bar.size(); ++p) {
    const double x = bar.x[0][p] - 1, y = bar.x[1][p] - 2;
    CHECK(bar.v[0][p] == near(0.5 * x - 2 * y, 1e-12));
    CHECK(bar.v[1][p] == near(3 * x + 0.25 * y, 1e-12));
    CHECK(bar.affine[1][p] == -2);
    CHECK(bar.affine[2][p] == 3);
  }
}

TEST_CASE("A pulse: value cos^2 in the middle, nothing beyond half its width, the affine rate is the derivative") {
  const std::string field = "{type='pulse', value=[0.5, -2.0], axis='x', centre=[10.0, 0.0], width=4.0}";
  const State<2> state =
      build_state<2>(read_scene(source_path("cases/elastic_bar.toml"), {"bodies.bar.initial_velocity=" + field}));
  const Body<2>& bar = state.bodies[0];
  int inside = 0;
  for (std::size_t p = 0; p < bar.size(); ++p) {
    const double away = bar.x[0][p] - 10, phase = std::numbers::pi * away / 4;
    const bool moves = std::abs(away) < 2;
    inside += moves;
    const double share = moves ? std::cos(phase) * std::cos(phase) : 0;
    const double slope = moves ? -std::numbers::pi / 4 * 2 * std::cos(phase) * std::sin(phase) : 0;
    CHECK(bar.v[0][p] == within(0.5 * share, 1e-14));
    CHECK(bar.v[1][p] == within(-2 * share, 1e-14));
    CHECK(bar.affine[0][p] == within(0.5 * slope, 1e-14));
    CHECK(bar.affine[2][p] == within(-2 * slope, 1e-14));
    CHECK(bar.affine[1][p] == 0);
    CHECK(bar.affine[3][p] == 0);
  }
  CHECK(inside > 0);
}

TEST_CASE("The geotextile of a bag that is thrown moves with the bag from the start") {
  const std::string field = "{type='linear', gradient=[[0.5, -2.0], [3.0, 0.25]], centre=[1.0, 2.0]}";
  const State<2> state = build_state<2>(
      read_scene(source_path("cases/dump_kekerdom_mixture.toml"), {"bodies.container.initial_velocity=" + field}));
  const Membrane<2>& m = state.membranes[0];
  for (std::size_t k = 0; k < m.nodes(); ++k) {
    const double x = m.x[0][k] - 1, y = m.x[1][k] - 2;
    CHECK(m.v[0][k] == within(0.5 * x - 2 * y, 1e-12));
    CHECK(m.v[1][k] == within(3 * x + 0.25 * y, 1e-12));
  }
}

TEST_CASE("With MUSL, which never renews them, particles start without gradients of velocity") {
  const State<2> state = build_state<2>(read_scene(source_path("cases/elastic_bar.toml"), {"solver.transfer=musl"}));
  for (const auto& component : state.bodies[0].affine)
    for (const double each : component) CHECK(each == 0);
}

TEST_CASE("Arrays of absent features have length zero") {
  const State<2> column = build_state<2>(read_scene(source_path("cases/gravity_column.toml")));
  CHECK(column.bodies[0].pore_pressure.empty());
  CHECK(column.bodies[0].deviatoric_strain.empty());
  CHECK(column.membranes.empty());
  REQUIRE(column.tracers.size() == 1);
  CHECK(column.tracers[0].x == std::array<double, 2>{0.05, 0.94309});
  CHECK(column.tracers[0].initial_x == column.tracers[0].x);
  const Scene ideal = read_scene(source_path("cases/hydrostatic_column.toml"), {"materials.water.viscosity=0"});
  const State<2> water = build_state<2>(ideal);
  for (const auto& component : water.bodies[0].stress) CHECK(component.empty());
  CHECK(water.bodies[0].pore_pressure.empty());
  CHECK(water.tracers.empty());
  const State<2> main_case = build_state<2>(read_scene(source_path("cases/dump_kekerdom_mixture.toml")));
  CHECK(main_case.bodies[1].pore_pressure.size() == main_case.bodies[1].size());  // undrained bed
  CHECK(main_case.bodies[2].pore_pressure.empty());                               // drained sand
  CHECK(main_case.drift < 0);
  CHECK(main_case.t == 0);
  CHECK(main_case.step == 0);
}

TEST_CASE("A body inside a surface has its volume, cloth its mass and its warp along x") {
  const Scene scene = read_scene(source_path("tests/scenes/bag_3d.toml"));
  const State<3> state = build_state<3>(scene);
  const Membrane<3>& bag = state.membranes[0];
  double fluid = 0, cloth = 0, rest = 0;
  for (const double m : state.bodies[0].mass) fluid += m;
  for (const double m : bag.mass) cloth += m;
  for (const double area : bag.triangles.rest_area) rest += area;
  CHECK(fluid == near(1000 * enclosed_volume(bag), 1e-9));                               // shares below 1e-9 are none
  CHECK(cloth == near(rest, 1e-13));                                                     // 1 kg/m2
  CHECK(enclosed_volume(bag) == near(std::numbers::pi * (0.25 * 1.2 + 0.5 / 3), 0.03));  // chords of 0.16 m
  CHECK(bag.body == "fill");
  // 1 % of slack: stretches of 1 / 1.01 before any step.
  for (std::size_t t = 0; t < bag.triangles.size(); ++t) {
    const auto F = deformation(bag, t);
    CHECK((F.transpose() * F - Eigen::Matrix2d::Identity() / (1.01 * 1.01)).norm() < 1e-12);
    const Vec<3> middle = middle_of(bag, t);
    if (std::abs(middle[0]) < 0.5) CHECK(F(0, 0) > 0.99 / 1.01);
  }
}
