// What particles take over from the nodes, by hand, where these all move alike: the blend of what they keep and what
// the grid has, and damping.
#include <doctest/doctest.h>

#include <cmath>

#include "support/near.hpp"
#include "support/random_particles.hpp"
#include "transfer/transfer_stages.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double dt = 0.02, before = 5, change = -2, nodes = 1;  ///< [s], [m/s]

/// The velocity of a particle that had `before`, from nodes at `nodes` that changed by `change`.
double velocity_after(const SolverSpec& solver, double damping_rate) {
  Scene scene = box_scene<2>(8, 1.0, WallKind::slip, solver.transfer);
  scene.bodies[0].pressure = PressureSupport::particle;
  Grids<2> grids(1);
  grids[0] = make_grid<2>(scene);
  State<2> state;
  state.bodies = {blank_body<2>(LinearElastic{1000, 2e6, 1e6}, 1)};
  Body<2>& stone = state.bodies[0];
  stone.x = {Array<double>{4.3}, Array<double>{3.8}};
  stone.v = {Array<double>{before}, Array<double>{-before}};
  state.damping_rate = damping_rate;
  state.drift = -1;
  sort_particles(state, grids[0]);
  std::fill(grids[0].velocity.begin(), grids[0].velocity.end(), Vec4{nodes, -nodes, 0, 0});
  std::fill(grids[0].velocity_change.begin(), grids[0].velocity_change.end(), Vec4{change, -change, 0, 0});
  grid_to_particles(solver, state, grids, dt);
  CHECK(stone.v[1][0] == near(-stone.v[0][0], 1e-14));
  CHECK(stone.x[0][0] == near(4.3 + dt * nodes, 1e-14));
  CHECK(state.drift == near(dt * nodes, 1e-9));  // of the position's digits
  CHECK(state.v_max == near(std::sqrt(2.0) * stone.v[0][0], 1e-14));
  return stone.v[0][0];
}

SolverSpec blend(double rate) {
  SolverSpec solver;
  solver.transfer = Transfer::blend;
  solver.blend_rate = rate;
  return solver;
}

}  // namespace

TEST_CASE("With the blend a particle keeps exp(-rate dt) of its own velocity, changed as the nodes changed") {
  for (const double rate : {3.0, 30.0}) {
    const double keep = std::exp(-rate * dt);
    CHECK(velocity_after(blend(rate), 0) == near(keep * (before + change) + (1 - keep) * nodes, 1e-14));
  }
  CHECK(velocity_after(blend(0), 0) == near(before + change, 1e-14));
  CHECK(velocity_after(blend(1e6), 0) == near(nodes, 1e-14));
}

TEST_CASE("With TPIC it has the velocity of the nodes; damping takes exp(-rate dt) of all") {
  SolverSpec solver;
  solver.transfer = Transfer::tpic;
  CHECK(velocity_after(solver, 0) == near(nodes, 1e-14));
  CHECK(velocity_after(solver, 7) == near(std::exp(-7 * dt) * nodes, 1e-14));
  CHECK(velocity_after(blend(0), 7) == near(std::exp(-7 * dt) * (before + change), 1e-14));
}
