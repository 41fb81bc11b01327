// Pressure of fluids on the edges of a membrane: by hand, and in sum what Archimedes says.
#include "membrane/fluid_load.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>

#include "support/near.hpp"
#include "support/small_state.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

/// The square of side 2 around (4, 4), without loads; the scene's fluid stands at `surface` around it.
struct Submerged {
  Scene scene = small_scene();
  State<2> state;

  explicit Submerged(double surface) {
    scene.still_fluids = {{"skin", "water", StillFluidSpec::Side::outside, surface, {}}};
    state.membranes = {square_membrane()};
    for (auto& component : membrane().load) component.assign(4, 0.0);
  }
  Membrane<2>& membrane() { return state.membranes[0]; }
  double force(int axis) { return std::accumulate(membrane().load[axis].begin(), membrane().load[axis].end(), 0.0); }
};

}  // namespace

TEST_CASE("A linear pressure on a part of an edge, worked by hand") {
  Membrane<2> m = square_membrane();
  for (auto& component : m.load) component.assign(4, 0.0);
  add_pressure({0.25, 0.75, 10, 30}, 1, 0, m);  // the lower edge, 2 m long: outwards is down
  // int p (1 - t) dt and int p t dt over [1/4, 3/4] with p = 40 t: 20 (9 - 1)/16 - 40 (27 - 1)/192, and 40 (27 -
  // 1)/192.
  const double at_end = 40.0 * 26 / 192, at_start = 20.0 * 8 / 16 - at_end;
  CHECK(m.load[1][0] == near(-2 * at_start, 1e-13));
  CHECK(m.load[1][1] == near(-2 * at_end, 1e-13));
  CHECK(m.load[0] == Array<double>(4, 0.0));
  add_pressure({0, 1, 5, 5}, 1, 3, m);  // the edge that closes the loop, on the left
  CHECK(m.load[0][3] == near(-5, 1e-13));
  CHECK(m.load[0][0] == near(-5, 1e-13));
}

TEST_CASE("What a still fluid lifts is the weight of the fluid displaced, in either sense of the outline") {
  const double gamma = 10 * 1000;
  for (const bool clockwise : {false, true})
    for (const double surface : {2.5, 3.0, 4.2, 5.0, 9.0}) {
      CAPTURE(clockwise);
      CAPTURE(surface);
      Submerged square(surface);
      if (clockwise)
        for (auto& component : square.membrane().x) std::reverse(component.begin(), component.end());
      CHECK(sense_of(square.membrane()) == (clockwise ? -1 : 1));
      add_still_fluids(still_fluids(square.scene), square.state);
      const double depth = std::clamp(surface - 3, 0.0, 2.0);
      CHECK(std::abs(square.force(1) - gamma * 2 * depth) < 1e-9);
      CHECK(std::abs(square.force(0)) < 1e-9);
    }
}

TEST_CASE("The push on a wall that is partly wet: gamma d^2 / 2, at a third of the depth") {
  Submerged square(4.2);
  add_still_fluids(still_fluids(square.scene), square.state);
  const Array<double>& load = square.membrane().load[0];
  const double push = 1e4 * 1.2 * 1.2 / 2;
  CHECK(load[1] + load[2] == near(-push, 1e-12));      // the right edge, from node 1 up to 2
  CHECK(2 * load[2] == near(-push * 1.2 / 3, 1e-12));  // its moment about the lower end
}

TEST_CASE("Still fluids press only on the membrane that they stand around") {
  Submerged square(9);
  square.scene.still_fluids[0].membrane = "another";
  add_still_fluids(still_fluids(square.scene), square.state);
  for (const auto& component : square.membrane().load) CHECK(component == Array<double>(4, 0.0));
}
