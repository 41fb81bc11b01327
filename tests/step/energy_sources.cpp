// What pumps, still fluids, pressures, viscous boundaries, absorbing layers and endless slopes give is no growth of
// energy; what is drawn from nowhere there is one.
#include <doctest/doctest.h>
#include <geodrop/base/error.hpp>
#include <geodrop/measure/measure.hpp>
#include <geodrop/step/pipeline.hpp>

#include <cmath>

#include "step/energy_watch.hpp"
#include "step/pumps.hpp"
#include "support/near.hpp"
#include "support/random_particles.hpp"
#include "support/scene_files.hpp"
#include "support/text.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

/// A scene that has begun to run, under the watch.
template <int Dim>
struct Watched {
  Scene scene;
  State<Dim> state;
  Grids<Dim> grids;
  Pipeline<Dim> pipeline;

  Watched(const std::string& file, const std::vector<std::string>& changes)
      : scene(read_scene(source_path(file), changes)),
        state(build_state<Dim>(scene)),
        grids(make_grids<Dim>(scene)),
        pipeline(build_pipeline<Dim>(scene)) {
    REQUIRE(pipeline.back().name == "energy_watch");
  }
  /// What the watch says within so many looks; empty if nothing.
  std::string said_in(int looks) {
    try {
      for (std::uint64_t k = 0; k < looks * energy_watch_interval; ++k) advance(pipeline, state, grids);
    } catch (const RunError& error) {
      return error.what();
    }
    return {};
  }
};

/// A run goes on for some looks; with a damping that feeds motion by `gain` [1/s] the watch ends it soon.
template <int Dim>
void check_watch(const std::string& file, double gain, const std::vector<std::string>& changes = {}) {
  CAPTURE(file);
  Watched<Dim> run(file, changes);
  CHECK(run.said_in(6) == "");
  run.state.damping_rate = -gain;
  CHECK(contains(run.said_in(20), "energy grows without cause"));
}

}  // namespace

TEST_CASE("A tube that is pumped up runs on; fed by negative damping it is stopped") {
  check_watch<2>("tests/scenes/tube.toml", 500, {"relaxation={damping='none'}", "pumps.0.from=0", "time.end=10"});
}

TEST_CASE("Water hammer that swings through a pump is no growth") {
  CHECK(Watched<2>("cases/verification/pressurised_tube.toml", {}).said_in(4) == "");
}

TEST_CASE("A tube in still water runs on; fed by negative damping it is stopped") {
  check_watch<2>("cases/geotube_submerged.toml", 500, {"relaxation={damping='none'}", "grid.spacing=0.2"});
}

TEST_CASE("A bag under pressure, in space, runs on; fed by negative damping it is stopped") {
  check_watch<3>("cases/pillow_3d.toml", 500, {"solver.damping_rate=0"});
}

TEST_CASE("A bed on a viscous boundary runs on; fed by negative damping it is stopped") {
  check_watch<2>("cases/verification/viscous_boundary.toml", 500, {"grid.spacing=0.5"});
}

TEST_CASE("Water beside a silent side runs on; fed by negative damping it is stopped") {
  check_watch<2>("cases/verification/silent_side.toml", 20, {"grid.spacing=0.5"});
}

TEST_CASE("A layer that slides down an endless slope runs on; fed by negative damping it is stopped") {
  check_watch<2>("cases/verification/infinite_slope_slides.toml", 500, {"stages=[]"});
}

TEST_CASE("What a pump adds is motion, height and enthalpy of its fluid; against suction it is height alone") {
  const Newtonian water{1000, 2e6, 0};
  constexpr double added = 1e-3;  // [m2], of 4 m2
  const auto given = [&](double J, double speed) {
    State<2> state;
    state.bodies = {blank_body<2>(water, 1)};
    Body<2>& pool = state.bodies[0];
    pool.mass[0] = 4000;
    pool.x[1][0] = 3;
    pool.v[0][0] = speed;
    pool.J[0] = J;
    pump_fluid({{"body", added, 0, 1, {}}}, {0, -10}, {1, 0, 0}, state);
    return state.energy_budget.potential;
  };
  // Per volume at rest rho (v^2 / 2 + g y) + W + J p, with p J = K (1 - J), at the J after it.
  const double J = 0.98 / 1.00025, enthalpy = fluid_energy(water, J) + 2e6 * (1 - J);
  CHECK(given(0.98, 2) == near(added * (1000 * (2 + 30) + enthalpy), 1e-12));
  CHECK(given(1.02, 0) == near(added * 1000 * 30, 1e-12));
}

TEST_CASE("Gravity along a periodic axis gives its power: free fall goes on, 1.5 times its energy does not") {
  constexpr double g = 5, dt = 0.01;
  const EnergySources sources{{0, 0}, 1e-6, {g, 0}};
  State<2> state;
  state.bodies = {blank_body<2>(LinearElastic{1000, 2e6, 1e6}, 1)};
  const auto look = [&](std::uint64_t k, double factor) {
    const double t = static_cast<double>(k * energy_watch_interval) * dt;
    state.bodies[0].v[0][0] = std::sqrt(factor) * g * (t + dt);
    watch_energy(sources, {dt, t, k * energy_watch_interval}, state);
  };
  for (std::uint64_t k = 0; k < 40; ++k) CHECK_NOTHROW(look(k, 1));
  CHECK(state.energy_budget.fallen == near(0.5 * g * g * 19.51 * 19.51, 0.03));  // 40 rectangles: half of one more
  CHECK_THROWS_AS(look(40, 1.75), RunError);
}
