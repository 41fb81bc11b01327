// Membranes and tracers on the grid: what they bring, and how they move with it.
#include <doctest/doctest.h>

#include "membrane/membrane_force.hpp"
#include "support/near.hpp"
#include "support/random_particles.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double dt = 0.01;

/// An open line of three nodes of different mass in the middle of a box, one segment stretched, one slack.
State<2> line_state() {
  Membrane<2> m;
  m.closed = false;
  m.axial_stiffness = 1e4;
  m.x = {Array<double>{1.6, 2.3, 2.4}, Array<double>{2.1, 2.2, 1.9}};
  m.v = {Array<double>{3, -1, 2}, Array<double>{0.5, 4, -2}};
  m.mass = {1, 2, 5};
  m.rest_length = {0.6, 0.4};
  m.strain.assign(2, 0);
  m.tension.assign(2, 0);
  State<2> state;
  state.membranes = {m};
  return state;
}

Grid<2> box_grid(Transfer transfer) { return make_grid<2>(box_scene<2>(8, 0.5, WallKind::slip, transfer)); }

/// A velocity field linear in space, change included.
void put_field(Grid<2>& grid) {
  for_each_node(grid.layout, 2, [&](int flat, const std::array<int, 2>& i) {
    const double x = 0.5 * i[0], y = 0.5 * i[1];
    grid.velocity[flat] = Vec4{1 + 2 * x - y, 3 * y, 0, 0};
    if (!grid.velocity_change.empty()) grid.velocity_change[flat] = Vec4{0.1 * x, -0.2, 0, 0};
  });
}

}  // namespace

TEST_CASE("A membrane brings its mass and momentum to the grid; its forces have no resultant but the right moment") {
  State<2> state = line_state();
  Grid<2> grid = box_grid(Transfer::blend);
  membranes_to_grid(state, grid, 0, dt);
  double mass = 0, px = 0, py = 0, fx = 0, fy = 0, virial = 0;
  for_each_node(grid.layout, 2, [&](int flat, const std::array<int, 2>& i) {
    mass += grid.sum[flat][3];
    px += grid.sum[flat][0];
    py += grid.sum[flat][1];
    fx += grid.force[flat][0];
    fy += grid.force[flat][1];
    virial += 0.5 * (i[0] * grid.force[flat][0] + i[1] * grid.force[flat][1]);
  });
  CHECK(mass == near(8, 1e-14));
  CHECK(px == near(3 * 1 - 1 * 2 + 2 * 5, 1e-13));
  CHECK(py == near(0.5 * 1 + 4 * 2 - 2 * 5, 1e-13));
  CHECK(std::abs(fx) < 1e-9);
  CHECK(std::abs(fy) < 1e-9);
  // sum x . f = -sum T L: only the first segment, sqrt(0.5) long, is stretched.
  const double L = std::sqrt(0.5), T = 1e4 * (L / 0.6 - 1);
  CHECK(virial == near(-T * L, 1e-12));
  CHECK(state.membranes[0].tension[0] == near(T, 1e-13));
  CHECK(state.membranes[0].tension[1] == 0);
}

TEST_CASE("What a membrane caught of particles goes to the grid as a force of one step") {
  State<2> state = line_state();
  Grid<2> grid = box_grid(Transfer::blend);
  for (auto& component : state.membranes[0].caught) component.assign(state.membranes[0].nodes(), 0.0);
  state.membranes[0].caught[0][1] = 3;
  state.membranes[0].caught[1][2] = -5;
  membranes_to_grid(state, grid, 0, dt);
  double fx = 0, fy = 0;
  for_each_node(grid.layout, 2, [&](int flat, const auto&) {
    fx += grid.force[flat][0];
    fy += grid.force[flat][1];
  });
  CHECK(fx * dt == near(3, 1e-10));
  CHECK(fy * dt == near(-5, 1e-10));
}

TEST_CASE("Without a record of its own, dt times the membrane's force joins the momentum") {
  State<2> state = line_state();
  Grid<2> apart = box_grid(Transfer::blend), joined = box_grid(Transfer::tpic);
  membranes_to_grid(state, apart, 0, dt);
  membranes_to_grid(state, joined, 0, dt);
  double worst = 0;
  for_each_node(apart.layout, 2, [&](int flat, const auto&) {
    worst = std::max(worst, largest_component(apart.sum[flat] + dt * apart.force[flat] - joined.sum[flat]));
  });
  CHECK(worst < 1e-12);
}

TEST_CASE("Membrane nodes and tracers move with the grid; a linear field exactly") {
  State<2> state = line_state();
  state.tracers = {{"cork", {1.3, 2.6}, {}, {1, 1}}};
  const Membrane<2> before = state.membranes[0];
  Grid<2> grid = box_grid(Transfer::tpic);
  put_field(grid);
  SolverSpec solver;
  state.drift = 0.1;
  grid_to_membranes(solver, state, grid, dt);
  grid_to_tracers(state, grid, dt);
  double largest = 0;
  for (int k = 0; k < 3; ++k) {
    const double x = before.x[0][k], y = before.x[1][k], u = 1 + 2 * x - y, v = 3 * y;
    CHECK(state.membranes[0].v[0][k] == near(u, 1e-13));
    CHECK(state.membranes[0].v[1][k] == near(v, 1e-13));
    CHECK(state.membranes[0].x[0][k] == near(x + dt * u, 1e-13));
    CHECK(state.membranes[0].x[1][k] == near(y + dt * v, 1e-13));
    largest = std::max({largest, std::abs(dt * u), std::abs(dt * v)});
  }
  CHECK(state.drift >= 0.1 + largest * (1 - 1e-12));
  CHECK(state.tracers[0].v[0] == near(1.0, 1e-13));
  CHECK(state.tracers[0].v[1] == near(7.8, 1e-13));
  CHECK(state.tracers[0].x[1] == near(2.678, 1e-13));
  CHECK(state.tracers[0].initial_x[0] == 1);
}

TEST_CASE("Membrane nodes blend like particles: a (v + dv) + (1 - a) v', damped") {
  State<2> state = line_state();
  Grid<2> grid = box_grid(Transfer::blend);
  put_field(grid);
  SolverSpec solver;
  solver.transfer = Transfer::blend;
  solver.blend_rate = 50;  // a = exp(-0.5)
  state.damping_rate = 20;
  grid_to_membranes(solver, state, grid, dt);
  const double a = std::exp(-0.5), d = std::exp(-0.2);
  CHECK(state.membranes[0].v[0][0] == near(d * (a * (3 + 0.16) + (1 - a) * 2.1), 1e-12));
  CHECK(state.membranes[0].v[1][1] == near(d * (a * (4 - 0.2) + (1 - a) * 6.6), 1e-12));
  CHECK(state.membranes[0].x[0][0] == near(1.6 + dt * 2.1, 1e-13));
}
