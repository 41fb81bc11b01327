// What the energy watch allows where there is weight: a lift by a tenth of a cell, and what has fallen.
#include <doctest/doctest.h>
#include <geodrop/base/error.hpp>

#include <cmath>

#include "step/energy_watch.hpp"
#include "support/random_particles.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double g = 10, h = 0.5, dt = 0.01;

/// One particle of 2 kg at rest that the watch looks at, and again after it has fallen by `fall` and got up to `speed`.
bool goes_on(double speed, double fall) {
  const Point gravity{0, -g};
  State<2> state;
  state.bodies = {blank_body<2>(LinearElastic{1000, 2e6, 1e6}, 1)};
  Body<2>& stone = state.bodies[0];
  stone.mass[0] = 2;
  stone.x[1][0] = 5;
  watch_energy({gravity, h}, {dt, 0.0, 0}, state);
  stone.x[1][0] -= fall;
  stone.v[0][0] = speed;
  try {
    watch_energy({gravity, h}, {dt, 0.5, energy_watch_interval}, state);
  } catch (const RunError&) {
    return false;
  }
  return true;
}

/// Speed with so many times the energy that lifts by `height` [m/s].
double speed_of(double factor, double height) { return std::sqrt(2 * g * height * factor); }

}  // namespace

TEST_CASE("From rest, motion may hold 1.5 times what lifts all mass by 0.1 h, and no more") {
  CHECK(goes_on(speed_of(1.49, 0.1 * h), 0));
  CHECK_FALSE(goes_on(speed_of(1.51, 0.1 * h), 0));
}

TEST_CASE("What has fallen may move 1.5 times as fast in energy, over the lift; what was raised gives nothing") {
  CHECK(goes_on(speed_of(1.49, 0.1 * h + 3), 3));
  CHECK_FALSE(goes_on(speed_of(1.51, 0.1 * h + 3), 3));
  CHECK(goes_on(speed_of(1.49, 0.1 * h), -3));
  CHECK_FALSE(goes_on(speed_of(1.51, 0.1 * h), -3));
}
