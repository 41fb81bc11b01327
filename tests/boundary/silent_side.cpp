// Silent sides: fading of particles and the flow beyond, by hand.
#include "boundary/silent_side.hpp"

#include <doctest/doctest.h>
#include <geodrop/measure/measure.hpp>
#include <geodrop/step/pipeline.hpp>

#include <cmath>

#include "support/near.hpp"
#include "support/scene_files.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double dt = 1e-3, still_level = 15;

struct Pond {
  Scene scene;
  State<2> state;
  GridLayout<2> layout;

  /// The pond of round_pulse.toml without its pulse.
  explicit Pond(std::vector<std::string> changes = {})
      : scene(read_scene(source_path("tests/scenes/round_pulse.toml"), without_pulse(std::move(changes)))),
        state(build_state<2>(scene)),
        layout(scene.grid, scene.walls) {}
  static std::vector<std::string> without_pulse(std::vector<std::string> changes) {
    for (const char* change : {"grid.spacing=0.5", "bodies.pulse.initial_stress.surface=15.0"})
      changes.emplace_back(change);
    return changes;
  }

  Body<2>& water() { return state.bodies[0]; }
  const Newtonian& law() { return std::get<Newtonian>(water().material); }
  void step() { fade_at_silent_sides(layout, dt, state); }
  double still(std::size_t p) { return still_pressure(law(), 9.81, still_level - water().x[1][p]); }
  double excess(std::size_t p) { return law().bulk_modulus * (1 / water().J[p] - 1) - still(p); }
  /// Raises the pressure everywhere.
  void press(double pressure) {
    for (std::size_t p = 0; p < water().size(); ++p)
      water().J[p] = 1 / (1 + (still(p) + pressure) / law().bulk_modulus);
  }
  /// Share that fades in a step at a place: s = 7.5 c / d (depth / d)^2, 2 m deep layers between -8 and 8 m.
  double share_at(double x) {
    const double depth = std::max(0.0, std::abs(x) - 6) / 2;
    return -std::expm1(-7.5 * 60 / 2 * depth * depth * dt);
  }
};

}  // namespace

TEST_CASE("Water at rest stays as it is, to round-off") {
  Pond pond;
  const Array<double> mass = pond.water().mass;
  for (int k = 0; k < 10; ++k) pond.step();
  for (std::size_t p = 0; p < mass.size(); ++p) {
    CHECK(std::abs(pond.water().mass[p] / mass[p] - 1) < 1e-12);
    CHECK(std::abs(pond.water().v[0][p]) < 1e-12);
  }
}

TEST_CASE("Pressure and velocity fade at one rate, with the square of the depth in the layer; volumes stay") {
  Pond pond({"absorbing_layers.left.water_beyond=inf", "absorbing_layers.right.water_beyond=inf"});
  constexpr double pressure = 1e3;
  pond.press(pressure);
  for (double& v : pond.water().v[0]) v = 0.3;
  for (double& v : pond.water().v[1]) v = -0.2;
  Body<2> before = pond.water();
  pond.step();
  int faded = 0;
  for (std::size_t p = 0; p < before.size(); ++p) {
    const double share = pond.share_at(before.x[0][p]);
    CHECK(pond.water().v[0][p] == near(0.3 * (1 - share), 1e-12));
    CHECK(pond.water().v[1][p] == near(-0.2 * (1 - share), 1e-12));
    // p_0 has followed by dt / T of it, J is not quite linear in p: 1 + p / K = 1.04 at most.
    CHECK(pond.excess(p) == near(pressure * (1 - share), 0.00015));
    CHECK(pond.water().volume(p) == near(before.volume(p), 1e-12));
    if (share > 0) faded += pond.water().mass[p] < before.mass[p];
    if (share == 0) CHECK(pond.water().mass[p] == before.mass[p]);
  }
  CHECK(faded > 100);
}

TEST_CASE("The water beyond is driven by the pressure at the inner edge, outwards, and comes to rest") {
  Pond pond;  // L = 8 m, T = 2 s
  pond.press(4e3);
  pond.step();
  const int row = pond.layout.base(1, 7.5) + GridLayout<2>::pad;
  for (const SilentSide& side : pond.state.silent_sides) {
    CHECK(side.flow[row] == near(dt * 4e3 / (1000 * 8), 1e-12));
    CHECK(side.lasting[row] == near(4e3 * dt / 2, 1e-12));
  }
  pond.press(0);
  for (SilentSide& side : pond.state.silent_sides) {
    side.lasting.assign(side.lasting.size(), 0.0);
    side.flow.assign(side.flow.size(), 0.1);
  }
  for (double& v : pond.water().v[0]) v = 0;
  pond.step();
  for (const SilentSide& side : pond.state.silent_sides) CHECK(side.flow[row] == near(0.1 * (1 - dt / 2), 1e-12));
  for (std::size_t p = 0; p < pond.water().size(); ++p) {
    const double x = pond.water().x[0][p], y = pond.water().x[1][p];
    if (y > 1 && y < 14)
      CHECK(pond.water().v[0][p] == within((x > 0 ? 0.1 : -0.1) * (1 - dt / 2) * pond.share_at(x), 1e-15));
  }
}

TEST_CASE("What the water gains in the layers joins the energy budget; what it loses is its height alone") {
  Pond pond;
  const auto given_over_gained = [&] {
    const Totals<2> was = measure(pond.state, pond.scene.gravity);
    const double before = pond.state.energy_budget.potential;
    pond.step();
    const Totals<2> is = measure(pond.state, pond.scene.gravity);
    const double height = is.potential - was.potential;
    return (pond.state.energy_budget.potential - before - height) / (is.energy() - was.energy() - height);
  };
  for (double& v : pond.water().v[0]) v = 0.5;
  CHECK(std::abs(given_over_gained()) < 1e-6);
  pond.press(-5000);  // water comes in from beyond
  for (double& v : pond.water().v[0]) v = 0;
  CHECK(given_over_gained() == near(1, 1e-4));
}
