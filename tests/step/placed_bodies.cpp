// Stages of a run in time: bodies that come in later, and damping from when on.
#include "setup/scene_stages.hpp"
#include "step/stable_dt.hpp"

#include <doctest/doctest.h>
#include <geodrop/base/error.hpp>
#include <geodrop/files/checkpoint.hpp>
#include <geodrop/measure/history.hpp>
#include <geodrop/measure/measure.hpp>
#include <geodrop/step/pipeline.hpp>

#include <cmath>

#include "files/snapshot.hpp"
#include "support/near.hpp"
#include "support/scene_files.hpp"
#include "support/text.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double slab_mass = 1800 * 10 * 1.03, block_mass = 1800 * 2 * 1.0;
constexpr int slab = 0, block = 1;

Scene block_on_slab(std::vector<std::string> overrides) {
  overrides.push_back("time.end=10");
  return read_scene(source_path("tests/scenes/block_on_slab.toml"), overrides);
}

/// A scene under way.
struct Run {
  Scene scene;
  State<2> state = build_state<2>(scene);
  Grids<2> grids = make_grids<2>(scene);
  Pipeline<2> pipeline = build_pipeline<2>(scene);

  void step() { advance(pipeline, state, grids); }
  void until(double t) {
    while (state.t < t) step();
  }
  double mass() const { return measure(state, scene.gravity).mass; }
  std::size_t points_in_frame() const { return take_snapshot(state, {"elastic"}).particles.points.size() / 3; }
};

/// A block that flies freely at 1 m/s.
Run flyer(const std::vector<std::string>& overrides) {
  std::vector<std::string> all{"gravity=[0.0,0.0]", "bodies.block.shape={type='box',lower=[1.0,2.0],upper=[3.0,3.0]}",
                               "bodies.block.initial_velocity={type='uniform',value=[1.0,0.0]}"};
  all.insert(all.end(), overrides.begin(), overrides.end());
  return {block_on_slab(all)};
}

/// Where it started, and without stress. Particles may have changed their order.
bool stands_still(const Body<2>& body) {
  bool still = true;
  for (std::size_t p = 0; p < body.size(); ++p)
    for (int a = 0; a < 2; ++a)
      still = still && body.x[a][p] == body.initial_x[a][body.id[p]] && body.v[a][p] == 0 && body.stress[a][p] == 0;
  return still;
}

double speed(const Run& run) { return measure(run.state.bodies[block], 0.125).velocity[0]; }

}  // namespace

TEST_CASE("A body is not there before its stage places it, and then it is") {
  Run run{block_on_slab({"stages=[{name='wait',from=0.0},{name='drop',from=0.1,places=['block']}]"})};
  for (const double t : {0.0, 0.09}) {
    run.until(t);
    CHECK(run.state.bodies[block].field == waiting);
    CHECK(run.mass() == near(slab_mass, 1e-9));
    CHECK(run.points_in_frame() == run.state.bodies[slab].size());
    CHECK(take_snapshot(run.state, {"elastic"}).membranes.membrane.size() == run.state.membranes[0].segments());
    CHECK(run.state.membrane_contacts[0].normal_force == 0);
    CHECK(stands_still(run.state.bodies[block]));
  }
  run.until(0.1);
  run.step();
  CHECK(run.state.bodies[block].field != waiting);
  CHECK(run.state.bodies[block].field != run.state.bodies[slab].field);
  CHECK(run.mass() == near(slab_mass + block_mass, 1e-9));
  CHECK(run.points_in_frame() == run.state.particles());
  CHECK(speed(run) > 0);
  run.until(0.15);
  CHECK(run.state.membrane_contacts[0].normal_force > 0);
}

TEST_CASE("What the first stage places is there from the start, in the first row and frame") {
  const Run run{block_on_slab({"stages=[{name='drop',from=0.0,places=['block']}]"})};
  CHECK(run.mass() == near(slab_mass + block_mass, 1e-9));
  CHECK(run.points_in_frame() == run.state.particles());
}

TEST_CASE("A body placed at the start moves as one without stages, bit for bit") {
  Run staged{block_on_slab({"stages=[{name='drop',from=0.0,places=['block']}]"})}, plain{block_on_slab({})};
  for (int k = 0; k < 50; ++k) {
    staged.step();
    plain.step();
  }
  CHECK(staged.state.t == plain.state.t);
  for (const int b : {slab, block}) {
    CHECK(staged.state.bodies[b].x == plain.state.bodies[b].x);
    CHECK(staged.state.bodies[b].stress == plain.state.bodies[b].stress);
  }
}

TEST_CASE("A body placed later moves as it would have from the start") {
  // Nothing else moves: with the same steps from then on, it falls the same way.
  Run later = flyer({"stages=[{name='wait',from=0.0},{name='fly',from=0.05,places=['block']}]"});
  later.until(0.05);
  Run now = flyer({});
  const double placed_at = later.state.t;
  for (int k = 0; k < 100; ++k) {
    later.step();
    now.step();
  }
  CHECK(speed(later) == near(1, 1e-9));
  const double moved = measure(later.state.bodies[block], 0.125).centre[0] - 2;
  CHECK(moved == near(measure(now.state.bodies[block], 0.125).centre[0] - 2, 5e-4));
  CHECK(moved == near(later.state.t - placed_at, 1e-12));
}

TEST_CASE("Tracers in a body that comes later move with it then, others do before") {
  const std::string probes =
      "probes=[{name='rider',type='tracer',position=[2.0,2.5]},{name='deep',type='tracer',position=[5.0,0.5]}]";
  Run run = flyer({"stages=[{name='wait',from=0.0},{name='fly',from=0.05,places=['block']}]", probes});
  run.until(0.05);
  CHECK(run.state.tracers[0].field == waiting);
  CHECK(run.state.tracers[0].x == run.state.tracers[0].initial_x);
  run.until(0.15);
  const double moved = measure(run.state.bodies[block], 0.125).centre[0] - 2;
  CHECK(run.state.tracers[0].x[0] - 2 == near(moved, 1e-12));
  CHECK(run.state.tracers[1].field == run.state.bodies[slab].field);
}

TEST_CASE("Damping: velocity falls by the exponential of the integral of its rate, ramps included") {
  Run run =
      flyer({"stages=[{name='slow',from=0.0,damping_rate=2.0},{name='ramp',from=0.2,damping_rate=5.0,damping_ramp=0.2},"
             "{name='free',from=0.6}]"});
  const auto integral = [](double t) {
    const double flat = 2 * std::min(t, 0.2), ramp = 12.5 * std::pow(std::clamp(t - 0.2, 0.0, 0.2), 2);
    return flat + ramp + 5 * std::clamp(t - 0.4, 0.0, 0.2);
  };
  for (const double t : {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8}) {
    CAPTURE(t);
    run.until(t);
    // A stage begins with the first step after its time: up to two steps' damping may be missing or too many.
    const double off = 2 * 5 * stable_dt(run.scene, run.state, run.grids[0].layout);
    CHECK(std::abs(speed(run) / std::exp(-integral(run.state.t)) - 1) < off);
    CHECK(off < 0.015);
  }
}

TEST_CASE("A stage with a rate from the start is damping of the solver, bit for bit") {
  Run staged = flyer({"stages=[{name='slow',from=0.0,damping_rate=3.0}]"}), plain = flyer({"solver.damping_rate=3.0"});
  staged.until(0.1);
  plain.until(0.1);
  CHECK(state_hash(staged.state) != state_hash(plain.state));  // one has entered a stage
  plain.state.stages_entered = staged.state.stages_entered;
  plain.state.energy_budget.stages = staged.state.energy_budget.stages;
  CHECK(state_hash(staged.state) == state_hash(plain.state));
}

TEST_CASE("A run ends where a stage places a body that another one has moved into") {
  const auto slab_at = [](const std::string& speed) {  // its upper side is where the block will be placed
    return Run{block_on_slab({"gravity=[0.0,0.0]", "bodies.slab.shape={type='box',lower=[0.0,0.53],upper=[10.0,1.03]}",
                              "bodies.slab.initial_velocity={type='uniform',value=[0.0," + speed + "]}",
                              "stages=[{name='wait',from=0.0},{name='drop',from=0.1,places=['block']}]"})};
  };
  Run beside = slab_at("0.0"), into = slab_at("3.0");
  beside.until(0.12);
  CHECK(beside.state.bodies[block].field != waiting);
  std::string message;
  try {
    into.until(0.12);
  } catch (const RunError& error) {
    message = error.what();
  }
  CHECK(contains(message, "stage \"drop\" at t = 0.1"));
  CHECK(contains(message, "places \"block\" where \"slab\" is: "));
}

TEST_CASE("Several stages that are due in one step are all entered, in order") {
  Run run{
      block_on_slab({"stages=[{name='a',from=0.0,damping_rate=7.0},{name='b',from=1e-6,places=['block']},"
                     "{name='c',from=2e-6,damping_rate=3.0},{name='d',from=5.0}]"})};
  run.step();
  CHECK(run.state.stages_entered == 1);
  CHECK(run.state.damping_rate == 7);
  run.step();
  CHECK(run.state.stages_entered == 3);
  CHECK(run.state.damping_rate == 3);
  CHECK(run.state.bodies[block].field != waiting);
}

TEST_CASE("A relaxation at rest goes on while a stage is still to come, and counts what that places") {
  const std::string relaxation = "relaxation={damping='kinetic',kinetic_ratio=1e-3,out_of_balance_ratio=1e-2}";
  Run run{block_on_slab({"gravity=[0.0,-9.81]", relaxation, "time.end=20",
                         "bodies.block.initial_velocity={type='uniform',value=[0.0,-0.5]}",
                         "stages=[{name='slab',from=0.0},{name='both',from=3.0,places=['block']}]"})};
  while (run.state.t < 3.0) {
    REQUIRE_FALSE(is_over(run.scene, run.state));
    run.step();
  }
  CHECK(run.state.relaxation.cycles_at_rest > 3);
  CHECK(speed(run) == 0);
  CHECK(measure(run.state.bodies[block], 0.125).velocity[1] == near(-0.5, 1e-12));  // not damped while it waits
  run.step();
  const double placed = -run.scene.gravity[1] * block_mass * 1.53, slab_start = 9.81 * slab_mass * 0.515;
  CHECK(run.state.relaxation.initial_potential == near(slab_start + placed, 1e-12));
}

TEST_CASE("A pump waits for the body that it pumps into") {
  Run run{block_on_slab({"materials.slurry={model='newtonian',density=1800.0,sound_speed=60.0,viscosity=1.0}",
                         "bodies.block.material=slurry", "pumps=[{body='block',rate=0.1,from=0.0,to=9.0}]",
                         "stages=[{name='wait',from=0.0},{name='fill',from=0.05,places=['block']}]"})};
  run.until(0.05);
  const double start = run.state.t;
  CHECK(measure(run.state, run.scene.gravity).mass == near(slab_mass, 1e-9));
  run.until(0.1);
  CHECK(run.mass() == near(slab_mass + block_mass + 1800 * 0.1 * (run.state.t - start), 1e-9));
}

TEST_CASE("What stages remember is part of the checkpoint") {
  State<2> state = build_state<2>(block_on_slab({"stages=[{name='a',from=0.0},{name='b',from=1.0,places=['block']}]"}));
  const std::string hash = state_hash(state);
  REQUIRE(state.stages_entered == 1);
  state.stages_entered = 2;
  CHECK(state_hash(state) != hash);
  state.stages_entered = 1;
  state.bodies[block].field = 1;
  CHECK(state_hash(state) != hash);
}
