// Dashpots and springs at an edge of the ground: tractions by hand, what they bring to the grid, how they move with it.
#include "boundary/viscous_boundary.hpp"
#include "grid/momentum.hpp"
#include "grid/neighbourhood.hpp"

#include <doctest/doctest.h>
#include <geodrop/step/pipeline.hpp>

#include "support/near.hpp"
#include "support/random_particles.hpp"
#include "support/scene_files.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double dt = 0.01;

/// Two points on an edge that looks down and to the left, 0.5 m of it each.
ViscousBoundary<2> slanted_edge() {
  ViscousBoundary<2> b;
  b.name = "base";
  b.normal = {-0.6, -0.8};
  b.length = 0.5;
  b.half_size = 0.25;
  b.inwards = 0.1;
  b.impedance_p = 2e5;
  b.impedance_s = 1e5;
  b.spring = 1e6;
  b.x = {Array<double>{1.6, 2.3}, Array<double>{2.1, 1.7}};
  b.v = {Array<double>{0.3, -1}, Array<double>{-0.1, 0.5}};
  b.moved = {Array<double>{0.01, 0}, Array<double>{-0.02, 0}};
  b.at_start = {Array<double>{2e4, 0}, Array<double>{4e4, 0}};
  return b;
}

State<2> state_with(const ViscousBoundary<2>& boundary) {
  State<2> state;
  state.viscous_boundaries = {boundary};
  return state;
}

Grid<2> box_grid(Transfer transfer) { return make_grid<2>(box_scene<2>(8, 0.5, WallKind::slip, transfer)); }

const std::string bed = source_path("tests/scenes/viscous_bed.toml");

ViscousBoundary<2> base_of(const std::vector<std::string>& changes) {
  return build_state<2>(read_scene(bed, changes)).viscous_boundaries.at(0);
}

}  // namespace

TEST_CASE("Dashpots and spring, normal and tangential by hand") {
  // v.n = -0.18 + 0.08 = -0.1, v_t = v + 0.1 n = (0.24, -0.18); u.n = -0.006 + 0.016 = 0.01:
  // t = -10^5 (0.24, -0.18) - (2 10^5 (-0.1) + 10^6 0.01) (-0.6, -0.8)
  const Vec<2> t = yielding_traction(slanted_edge(), 0);
  CHECK(t[0] == near(-2.4e4 - 0.6e4, 1e-12));
  CHECK(t[1] == near(1.8e4 - 0.8e4, 1e-12));
}

TEST_CASE("The dashpots only take energy, the more the faster") {
  ViscousBoundary<2> b = slanted_edge();
  b.spring = 0;
  const double power = yielding_traction(b, 0).dot(Vec<2>(0.3, -0.1));
  CHECK(power == near(-2e5 * 0.1 * 0.1 - 1e5 * (0.24 * 0.24 + 0.18 * 0.18), 1e-12));
}

TEST_CASE("The grid receives all of the force, at the right place, apart or within the momentum") {
  const State<2> state = state_with(slanted_edge());
  Grid<2> apart = box_grid(Transfer::blend), joined = box_grid(Transfer::tpic);
  for (Grid<2>* grid : {&apart, &joined})
    for (Vec4& record : grid->sum) record[3] = 250;  // full nodes
  boundaries_to_grid(state, apart, dt);
  boundaries_to_grid(state, joined, dt);
  Vec<2> force = Vec<2>::Zero(), expected = Vec<2>::Zero();
  double moment = 0, expected_moment = 0, worst = 0;
  for_each_node(apart.layout, 2, [&](int flat, const std::array<int, 2>& i) {
    force += Vec<2>(apart.force[flat][0], apart.force[flat][1]);
    moment += 0.5 * (i[0] * apart.force[flat][1] - i[1] * apart.force[flat][0]);
    worst = std::max(worst, largest_component(apart.sum[flat] + dt * apart.force[flat] - joined.sum[flat]));
  });
  const ViscousBoundary<2>& b = state.viscous_boundaries[0];
  for (std::size_t k = 0; k < 2; ++k) {
    const Vec<2> f = 0.5 * yielding_traction(b, k), x = vector_at(b.x, k);
    const Vec<2> f_0 = 0.5 * vector_at(b.at_start, k), edge = x + 0.1 * Vec<2>(-0.6, -0.8);
    expected += f + f_0;
    expected_moment += x[0] * f[1] - x[1] * f[0] + edge[0] * f_0[1] - edge[1] * f_0[0];
  }
  CHECK((force - expected).norm() < 1e-9 * expected.norm());
  CHECK(moment == near(expected_moment, 1e-12));
  CHECK(worst < 1e-9);
}

TEST_CASE("Nodes with hardly a mass get none of the force, the others all of it") {
  const State<2> state = state_with(slanted_edge());
  Grid<2> grid = box_grid(Transfer::blend);
  for_each_node(grid.layout, 2,
                [&](int flat, const std::array<int, 2>& i) { grid.sum[flat][3] = i[1] > 3 ? 250 : 1e-9; });
  boundaries_to_grid(state, grid, dt);
  double below = 0, above = 0;
  for_each_node(grid.layout, 2,
                [&](int flat, const std::array<int, 2>& i) { (i[1] > 3 ? above : below) += grid.force[flat][1]; });
  const ViscousBoundary<2>& b = state.viscous_boundaries[0];
  CHECK(below == 0);
  CHECK(above == near(0.5 * (4e4 + yielding_traction(b, 0)[1] + yielding_traction(b, 1)[1]), 1e-12));
}

TEST_CASE("On graded axes a node gets its part of the force if it is not light for its own spline") {
  const State<2> state = state_with(slanted_edge());
  Grid<2> full = make_grid<2>(graded_scene<2>(12, 0.5, WallKind::slip, Transfer::blend)), light = full;
  for_each_node(full.layout, 2, [&](int flat, const std::array<int, 2>&) {
    full.sum[flat][3] = 250;
    light.sum[flat][3] = 1.01 * light_mass<2>(light, stored_cell(light.layout, flat));
  });
  boundaries_to_grid(state, full, dt);
  boundaries_to_grid(state, light, dt);
  double most = 0, apart = 0;
  for_each_node(full.layout, 2, [&](int flat, const std::array<int, 2>&) {
    most = std::max(most, largest_component(full.force[flat]));
    apart = std::max(apart, largest_component(full.force[flat] - light.force[flat]));
  });
  CHECK(most > 1e3);
  CHECK(apart == 0);
}

TEST_CASE("The points move with the grid; their displacement counts towards the next sort") {
  State<2> state = state_with(slanted_edge());
  Grid<2> grid = box_grid(Transfer::tpic);
  for_each_node(grid.layout, 2, [&](int flat, const std::array<int, 2>& i) {
    grid.velocity[flat] = Vec4{1 + i[0] - 0.5 * i[1], 1.5 * i[1], 0, 0};  // 1 + 2 x - y, 3 y
  });
  grid_to_boundaries(state, grid, dt);
  const ViscousBoundary<2>&b = state.viscous_boundaries[0], before = slanted_edge();
  for (int k = 0; k < 2; ++k) {
    const double u = 1 + 2 * before.x[0][k] - before.x[1][k], v = 3 * before.x[1][k];
    CHECK(b.v[0][k] == near(u, 1e-13));
    CHECK(b.v[1][k] == near(v, 1e-13));
    CHECK(b.x[1][k] == near(before.x[1][k] + dt * v, 1e-13));
    CHECK(b.moved[0][k] == near(before.moved[0][k] + dt * u, 1e-12));
  }
  CHECK(state.drift == near(dt * 3 * 2.1, 1e-12));
}

TEST_CASE("A point that leaves the domain ends the run") {
  State<2> state = state_with(slanted_edge());
  Grid<2> grid = box_grid(Transfer::tpic);
  std::fill(grid.velocity.begin(), grid.velocity.end(), Vec4{0, -1000, 0, 0});
  CHECK_THROWS_WITH_AS(grid_to_boundaries(state, grid, dt), doctest::Contains("viscous boundary 'base' left"),
                       RunError);
}

TEST_CASE("Impedance, spring and stress at the start are those of the ground") {
  const double E = 5e6, nu = 0.3, rho = 1800, G = E / 2.6, M = E * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
  const ViscousBoundary<2> b = base_of({});
  CHECK(b.points() == 24);  // h / 2 = 0.125 m on 3 m
  CHECK(b.length == near(0.125, 1e-12));
  CHECK(b.x[1][0] == near(-2 + 0.0625, 1e-12));  // with the lowest particles
  CHECK(b.normal[1] == near(-1, 1e-12));
  CHECK(b.impedance_p == near(std::sqrt(rho * M), 1e-12));
  CHECK(b.impedance_s == near(std::sqrt(rho * G), 1e-12));
  CHECK(b.spring == near(M / 10, 1e-12));
  CHECK(b.at_start[1][5] == near(rho * 9.81 * 2, 1e-12));  // upwards
  CHECK(b.at_start[0][5] == 0);
  CHECK(base_of({"viscous_boundaries.base.spring_depth=inf"}).spring == 0);
  const ViscousBoundary<2> wet = base_of(
      {"materials.soil.drainage=undrained", "materials.soil.porosity=0.4", "materials.soil.fluid_bulk_modulus=40e6"});
  CHECK(wet.impedance_p == near(std::sqrt(rho * (M + 100e6)), 1e-12));
  CHECK(wet.impedance_s == near(std::sqrt(rho * G), 1e-12));
}

TEST_CASE("Under water the edge bears skeleton and pore water together") {
  const std::vector<std::string> under_water{
      "materials.water={model='newtonian',density=1000,sound_speed=60,viscosity=1e-3}",
      "bodies.bed.initial_stress={type='k0',surface=0.0,k0=0.5,under='fluid',fluid='water',fluid_surface=3.0}"};
  const ViscousBoundary<2> b = base_of(under_water);
  const double K = 3.6e6, above = K * std::expm1(1000 * 9.81 * 3 / K);
  CHECK(b.at_start[1][0] == near(1800 * 9.81 * 2 + above, 1e-12));
}

TEST_CASE("At rest the slope of the potential over the displacement is the push and the spring on the edge") {
  ViscousBoundary<2> boundary = slanted_edge();
  for (auto& component : boundary.v) component.assign(2, 0.0);
  for (int a = 0; a < 2; ++a) {
    constexpr double off = 1e-3;
    const auto at = [&](double by) {
      ViscousBoundary<2> moved = boundary;
      moved.moved[a][0] += by;
      return boundary_potential(state_with(moved));
    };
    const double push = boundary.at_start[a][0] + yielding_traction(boundary, 0)[a];
    CHECK(-(at(off) - at(-off)) / (2 * off) == near(boundary.length * push, 1e-9));
  }
}
