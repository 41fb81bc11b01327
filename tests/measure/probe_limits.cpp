// Probes where it comes to the last digit: how near to a tip counts as near, where between two columns a heap ends.
#include <doctest/doctest.h>
#include "measure/probes/probes.hpp"

#include <algorithm>

#include "measure/probes/front_probe.hpp"
#include "measure/probes/pressure_probe.hpp"
#include "measure/strays.hpp"
#include "support/near.hpp"
#include "support/small_state.hpp"

using namespace geodrop;
using namespace geodrop::test;

TEST_CASE("Errors of pressure belong to a tip within 2 h of it") {
  Scene scene = small_scene();
  scene.gravity = {0.0, 0.0};
  const double K = 2e6;
  const auto J = [&](double pressure) { return 1 / (1 + pressure / K); };
  State<2> state;
  // The tips of the square are (3, 3) and (3, 5), h = 1.
  state.bodies = {body_at(scene.materials[0], {{3.0, 6.99}, {1.01, 3.0}, {3.0, 0.99}, {0.99, 3.0}}, 500)};
  state.bodies[0].name = "pool";
  state.bodies[0].J = {J(7e3), J(6e3), J(3e3), J(2e3)};
  state.membranes = {square_membrane()};
  HydrostaticProbeSpec probe{"still", "pool", HydrostaticSpec{"water", 4.0}};
  probe.tips_of = "skin";
  const PressureSpread spread = pressure_spread(scene, probe, state);
  // The 99.9th percentile of two values lies 0.999 of the way from the lower to the higher.
  CHECK(spread.tips == near(6e3 + 999, 1e-9));
  CHECK(spread.elsewhere == near(2e3 + 999, 1e-9));
}

TEST_CASE("The front of a heap lies between the middles of two columns, where the thickness is just as told") {
  GridSpec grid;
  grid.lower = {0.0, 0.0};
  grid.upper = {10.0, 2.0};
  grid.spacing = 1;
  // Columns from x = 3 m on, by their thickness; one particle of V = 0.1 m2 for each 0.1 m.
  const std::vector<double> thickness{0.2, 0.7, 1.0, 0.8, 0.1};
  std::vector<std::array<double, 2>> places;
  for (std::size_t c = 0; c < thickness.size(); ++c)
    for (int n = 0; n < static_cast<int>(10 * thickness[c] + 0.5); ++n) places.push_back({3.5 + double(c), 0.1 * n});
  const Body<2> heap = body_at(small_scene().materials[0], places, 100);
  for (const double least : {0.3, 0.5, 0.65}) {
    CAPTURE(least);
    const HeapFronts fronts = heap_fronts(grid, {"heap", "pool", least}, heap);
    CHECK(fronts.left == near(4.5 - (0.7 - least) / 0.5, 1e-12));
    CHECK(fronts.right == near(6.5 + (0.8 - least) / 0.7, 1e-12));
  }
}

TEST_CASE("Strays count whichever way the nodes of the membrane run") {
  State<2> state;
  state.bodies = {body_at(small_scene().materials[0], {{4.0, 4.0}, {5.5, 4.0}}, 500)};
  state.bodies[0].name = "pool";
  state.membranes = {square_membrane()};
  Membrane<2>& skin = state.membranes[0];
  CHECK(strays_inside(state, skin, {}, 0.0) == near(0.5, 1e-14));
  for (auto& component : skin.x) std::reverse(component.begin(), component.end());
  CHECK(strays_inside(state, skin, {}, 0.0) == near(0.5, 1e-14));
  state.bodies[0].field = waiting;
  CHECK(strays_inside(state, skin, {}, 0.0) == 0);
}
