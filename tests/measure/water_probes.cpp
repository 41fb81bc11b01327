// Pressure of water apart from its still value, and water on the wrong side of a membrane.
#include <doctest/doctest.h>
#include "measure/probes/probes.hpp"

#include <cmath>

#include "measure/probes/pressure_probe.hpp"
#include "measure/strays.hpp"
#include "measure/water_force.hpp"
#include "support/near.hpp"
#include "support/small_state.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

/// Water particles without weight at `places`, each with the pressure of J; a square membrane of side 2 around (4, 4).
State<2> water_at(const std::vector<std::array<double, 2>>& places, const std::vector<double>& J) {
  State<2> state;
  state.bodies = {body_at(small_scene().materials[0], places, 500)};
  state.bodies[0].name = "pool";
  state.bodies[0].J.assign(J.begin(), J.end());
  state.membranes = {square_membrane()};
  state.membranes[0].name = "skin";
  state.membranes[0].body = "bag";
  return state;
}

}  // namespace

TEST_CASE("Water inside a membrane is counted by its volume, its own body is not") {
  State<2> state = water_at({{4.0, 4.0}, {4.9, 4.9}, {5.1, 4.0}, {0.0, 0.0}}, {1, 1, 1, 1});
  CHECK(strays_inside(state, state.membranes[0], {}, 0.0) == near(1.0, 1e-12));  // two of 0.5 m2
  CHECK(strays_inside(state, state.membranes[0], {}, 0.2) == near(0.5, 1e-12));  // (4.9, 4.9) is 0.1 m inside
  state.membranes[0].body = "pool";
  CHECK(strays_inside(state, state.membranes[0], {}, 0.0) == 0);
}

TEST_CASE("What two membranes that overlap have both inside has not strayed") {
  State<2> state = water_at({{4.9, 4.0}, {4.5, 4.0}}, {1, 1});
  state.membranes.push_back(square_membrane());
  Membrane<2>& other = state.membranes.back();
  for (double& x : other.x[0]) x += 1.7;  // from 4.7 to 6.7 m
  CHECK(strays_inside(state, state.membranes[0], {}, 0.0) == near(0.5, 1e-12));
  CHECK(strays_inside(state, other, {}, 0.0) == 0);
  other.closed = false;
  CHECK(strays_inside(state, state.membranes[0], {}, 0.0) == near(1.0, 1e-12));
}

TEST_CASE("Pressure pushes a membrane inwards, whichever way its nodes run, and friction drags it along") {
  for (const bool clockwise : {false, true}) {
    CAPTURE(clockwise);
    Membrane<2> square = square_membrane();
    if (clockwise)
      for (auto& x : square.x) std::reverse(x.begin(), x.end());
    const std::size_t n = square.nodes();
    square.water_pressure.assign(n, 0.0);
    square.water_shear.assign(n, 0.0);
    for (std::size_t s = 0; s < n; ++s) {  // p = 100 - 10 y at the middle of a segment: 10 times the area upwards
      const std::size_t end = (s + 1) % n;
      square.water_pressure[s] = 100 - 5 * (square.x[1][s] + square.x[1][end]);
      square.water_shear[s] = square.x[0][end] > square.x[0][s] ? 3 : 0;
    }
    const WaterForce force = water_force(square);
    CHECK(force.pressure[0] == within(0, 1e-12));
    CHECK(force.pressure[1] == near(40, 1e-12));
    CHECK(force.friction[0] == near(6, 1e-12));
    CHECK(force.friction[1] == within(0, 1e-12));
  }
}

TEST_CASE("Errors of pressure near the tips of a membrane count apart") {
  Scene scene = small_scene();
  scene.gravity = {0.0, 0.0};  // still water has no pressure then
  const double K = 2e6, J = 1 / (1 + 1e3 / K), J_tip = 1 / (1 + 5e3 / K);
  const State<2> state = water_at({{9.0, 9.0}, {9.0, 0.0}, {4.0, 5.5}}, {J, J, J_tip});
  HydrostaticProbeSpec probe{"still", "pool", HydrostaticSpec{"water", 4.0}};
  CHECK(pressure_spread(scene, probe, state).elsewhere == near(5e3, 0.004));
  CHECK(std::isnan(pressure_spread(scene, probe, state).tips));
  probe.tips_of = "skin";  // h = 1: within 2 m of its highest corner
  CHECK(pressure_spread(scene, probe, state).elsewhere == near(1e3, 1e-12));
  CHECK(pressure_spread(scene, probe, state).tips == near(5e3, 1e-12));
}
