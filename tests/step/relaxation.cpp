// Kinetic damping and its two criteria, by hand.
#include "step/relaxation.hpp"

#include <doctest/doctest.h>
#include <geodrop/step/pipeline.hpp>

#include "support/near.hpp"
#include "support/random_particles.hpp"
#include "support/small_state.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

const Point gravity{0.0, -10.0};
const RelaxationSpec criteria{RelaxationSpec::Damping::kinetic, 0.01, 0.02};

/// One particle of 2 kg that has fallen by 1 m, a work of 20 J; one membrane that has no mass.
State<2> fallen() {
  State<2> state;
  state.bodies = {body_at(small_scene().materials[0], {{0.5, 3.0}}, 2.0)};
  state.relaxation.initial_potential = 2 * 10 * 4.0;
  return state;
}

bool at_rest(const Relaxation& relaxation) { return relaxation.cycles_at_rest >= cycles_to_rest; }

void set_kinetic_energy(double joule, State<2>& state) { state.bodies[0].v[0][0] = std::sqrt(joule); }

/// A cycle of `steps` steps: energy rises to `largest` [J], then falls.
void cycle(std::uint64_t steps, double largest, double balance, State<2>& state) {
  for (std::uint64_t k = 1; k < steps; ++k) {
    set_kinetic_energy(largest * static_cast<double>(k) / static_cast<double>(steps - 1), state);
    state.relaxation.out_of_balance_largest = std::max(state.relaxation.out_of_balance_largest, balance);
    damp_kinetically(criteria, gravity, state);
  }
  set_kinetic_energy(0.9 * largest, state);
  damp_kinetically(criteria, gravity, state);
}

}  // namespace

TEST_CASE("Velocities stay until the kinetic energy has passed a peak, and then are all zero") {
  State<2> state = fallen();
  state.membranes = {square_membrane()};
  Body<2>& body = state.bodies[0];
  for (const double joule : {1.0, 2.0, 2.0, 5.0}) {
    set_kinetic_energy(joule, state);
    state.membranes[0].v[1][2] = 1e-3;
    body.affine[1][0] = 1e-3;
    damp_kinetically(criteria, gravity, state);
    CHECK(body.v[0][0] == std::sqrt(joule));
    CHECK(state.membranes[0].v[1][2] == 1e-3);
  }
  set_kinetic_energy(4.9, state);
  damp_kinetically(criteria, gravity, state);
  for (const auto& component : body.v) CHECK(component[0] == 0);
  for (const auto& component : body.affine) CHECK(component[0] == 0);
  for (const auto& component : state.membranes[0].v)
    for (const double v : component) CHECK(v == 0);
  CHECK(state.relaxation.kinetic == 0);
  set_kinetic_energy(0.1, state);  // from rest, any energy is a rise
  damp_kinetically(criteria, gravity, state);
  CHECK(body.v[0][0] == std::sqrt(0.1));
}

TEST_CASE("Ratios of a cycle: largest energy over the work of gravity, largest force over the weight") {
  State<2> state = fallen();
  cycle(60, 0.5, 0.3, state);
  CHECK(state.relaxation.cycles == 1);
  CHECK(state.relaxation.kinetic_ratio == near(0.5 / 20, 1e-12));
  CHECK(state.relaxation.out_of_balance_ratio == 0.3);
  cycle(60, 0.1, 0.01, state);  // the largest values are those of this cycle
  CHECK(state.relaxation.kinetic_ratio == near(0.1 / 20, 1e-12));
  CHECK(state.relaxation.out_of_balance_ratio == 0.01);
}

TEST_CASE("A cycle shorter than the shortest counts with the next one") {
  State<2> state = fallen();
  cycle(shortest_cycle - 10, 1.0, 0.3, state);
  CHECK(state.relaxation.cycles == 0);
  CHECK(state.relaxation.kinetic_ratio == 1);
  CHECK(state.bodies[0].v[0][0] == 0);  // damped all the same
  cycle(20, 0.1, 0.01, state);
  CHECK(state.relaxation.cycles == 1);
  CHECK(state.relaxation.kinetic_ratio == near(1.0 / 20, 1e-12));
  CHECK(state.relaxation.out_of_balance_ratio == 0.3);
  State<2> exact = fallen();
  cycle(shortest_cycle, 1.0, 0.3, exact);
  CHECK(exact.relaxation.cycles == 1);
}

TEST_CASE("At rest: both ratios met over three cycles in a row") {
  State<2> state = fallen();
  const double calm = 0.1, loud = 0.3;  // [J], ratios 0.005 and 0.015
  cycle(60, calm, 0.01, state);
  cycle(60, calm, 0.01, state);
  CHECK_FALSE(at_rest(state.relaxation));
  cycle(60, loud, 0.01, state);
  CHECK(state.relaxation.cycles_at_rest == 0);
  cycle(60, calm, 0.01, state);
  cycle(60, calm, 0.03, state);
  CHECK(state.relaxation.cycles_at_rest == 0);
  for (int k = 0; k < 3; ++k) {
    CHECK_FALSE(at_rest(state.relaxation));
    cycle(60, calm, 0.01, state);
  }
  CHECK(at_rest(state.relaxation));
}

TEST_CASE("What was lifted comes to rest as well; not at rest before any work was done") {
  State<2> state = fallen();
  state.relaxation.initial_potential = 2 * 10 * 2.0;  // by 1 m
  for (int k = 0; k < 3; ++k) cycle(60, 0.1, 0.01, state);
  CHECK(state.relaxation.kinetic_ratio == near(0.1 / 20, 1e-12));
  CHECK(at_rest(state.relaxation));
  State<2> still = fallen();
  still.relaxation.initial_potential = 2 * 10 * 3.0;
  for (int k = 0; k < 4; ++k) cycle(60, 1e-6, 0.01, still);
  CHECK_FALSE(at_rest(still.relaxation));
}

TEST_CASE("A run is over at its end, or at rest with no pump still to run") {
  Scene scene = small_scene();  // ends at 1 s
  State<2> state = fallen();
  CHECK_FALSE(is_over(scene, state));
  state.relaxation.cycles_at_rest = cycles_to_rest;
  CHECK(is_over(scene, state));
  scene.pumps = {{"pool", 0.1, 0.0, 0.5, {}}};
  CHECK_FALSE(is_over(scene, state));
  state.t = 0.5;
  CHECK(is_over(scene, state));
  state.relaxation.cycles_at_rest = 0;
  CHECK_FALSE(is_over(scene, state));
  state.t = 1;
  CHECK(is_over(scene, state));
}

TEST_CASE("The out-of-balance ratio: norms over nodes by hand, the largest of all steps") {
  Scene scene = box_scene<2>(6, 0.5, WallKind::slip, Transfer::blend);
  Grids<2> grids = make_grids<2>(scene);
  Grid<2>& grid = grids.front();
  State<2> state;
  activate_all_blocks(grid);
  constexpr double dt = 0.01;
  const int a = grid.layout.index({1, 2}), b = grid.layout.index({4, 3});
  grid.sum[a] = Vec4{9, 9, 9, 3};
  grid.sum[b] = Vec4{9, 9, 9, 4};
  grid.velocity_change[a] = Vec4{0.04, 0, 0, 0};  // 3 kg at 4 m/s2: 12 N
  grid.velocity_change[b] = Vec4{0, 0.04, 0, 0};  // 16 N: the norm is 20 N; that of the weights 30 N and 40 N is 50 N
  measure_balance(gravity, dt, state, grids);
  CHECK(state.relaxation.out_of_balance_largest == near(0.4, 1e-13));
  grid.velocity_change[a] = Vec4{};
  measure_balance(gravity, dt, state, grids);
  CHECK(state.relaxation.out_of_balance_largest == near(0.4, 1e-13));
  grid.velocity_change[b] = Vec4{0, 0.4, 0, 0};
  measure_balance(gravity, dt, state, grids);
  CHECK(state.relaxation.out_of_balance_largest == near(160.0 / 50, 1e-13));
}
