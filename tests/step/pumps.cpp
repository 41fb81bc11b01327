// A pump adds rest volume to a fluid: by hand.
#include "step/pumps.hpp"

#include <doctest/doctest.h>
#include <geodrop/measure/measure.hpp>

#include <numeric>

#include "support/near.hpp"
#include "support/small_state.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

/// Into the pool, of water at 1000 kg/m3, while 1 s <= t < 2 s.
const std::vector<PumpSpec> pump{{"pool", 0.25, 1.0, 2.0, {}}};

const Point gravity{0.0, -10.0};

State<2> with_pool() {
  State<2> state = small_state();
  state.bodies[0].name = "pool";
  state.bodies[1].name = "bag";
  Body<2>& pool = state.bodies[0];
  pool.mass = {1000, 500, 2000, 1500};
  pool.J = {1, 0.99, 1.01, 1};
  for (std::size_t p = 0; p < pool.size(); ++p) pool.v[0][p] = static_cast<double>(p);
  return state;
}

double mass(const Body<2>& body) { return std::accumulate(body.mass.begin(), body.mass.end(), 0.0); }

/// What a step from t, dt long, adds to the pool [kg].
double pumped(double t, double dt) {
  State<2> state = with_pool();
  const double before = mass(state.bodies[0]);
  pump_fluid(pump, gravity, {dt, t, 0}, state);
  return mass(state.bodies[0]) - before;
}

}  // namespace

TEST_CASE("Mass grows at the rate; volumes and velocities stay, so pressure rises") {
  const State<2> before = with_pool();
  State<2> after = before;
  pump_fluid(pump, gravity, {0.1, 1.2, 0}, after);
  const Body<2>&was = before.bodies[0], &is = after.bodies[0];
  CHECK(mass(is) == near(5000 + 0.25 * 0.1 * 1000, 1e-14));
  for (std::size_t p = 0; p < is.size(); ++p) {
    CHECK(is.mass[p] / was.mass[p] == near(1.005, 1e-14));
    CHECK(is.volume(p) == near(was.volume(p), 1e-15));
    CHECK(is.J[p] < was.J[p]);
    CHECK(is.v[0][p] == was.v[0][p]);
  }
  CHECK(mass(after.bodies[1]) == mass(before.bodies[1]));
  CHECK(after.bodies[1].J == before.bodies[1].J);
}

TEST_CASE("It runs between its two times, also in the steps that they cut") {
  CHECK(pumped(0.5, 0.4) == 0);
  CHECK(pumped(0.5, 0.5) == 0);
  CHECK(pumped(0.9, 0.4) == near(75, 1e-10));
  CHECK(pumped(1.0, 0.4) == near(100, 1e-10));
  CHECK(pumped(1.9, 0.4) == near(25, 1e-10));
  CHECK(pumped(0.0, 3.0) == near(250, 1e-10));
  CHECK(pumped(2.0, 0.4) == 0);
}

TEST_CASE("Two pumps into one body add up") {
  State<2> state = with_pool();
  pump_fluid({pump[0], pump[0]}, gravity, {0.1, 1.2, 0}, state);
  CHECK(mass(state.bodies[0]) == near(5050, 1e-14));
}

TEST_CASE("What is pumped in brings its potential with it: no work of gravity") {
  State<2> state = with_pool();
  state.relaxation.initial_potential = 7;
  const double before = measure(state, gravity).potential;
  pump_fluid(pump, gravity, {0.1, 1.2, 0}, state);
  const double added = measure(state, gravity).potential - before;
  CHECK(added == near(0.25 * 0.1 * 1000 * 10 * 0.5, 1e-12));  // the pool lies at y = 0.5 m
  CHECK(state.relaxation.initial_potential == near(7 + added, 1e-12));
}
