// A run whose energy grows without cause ends; one that is given energy does not.
#include <doctest/doctest.h>
#include <geodrop/base/find_named.hpp>
#include <geodrop/measure/measure.hpp>
#include <geodrop/step/pipeline.hpp>

#include <cmath>
#include <limits>

#include "support/near.hpp"
#include "support/program.hpp"
#include "support/text.hpp"

#include "step/energy_watch.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

const std::string drifting = "cases/verification/edge_drift.toml";

State<2> block_that_drifts() { return build_state<2>(read_scene(source_path(drifting))); }

/// What the watch says of a block whose energy at a later look is `factor` times that of the first; empty if nothing.
std::string said_of(double factor, const Point& gravity = {0, 0}, State<2> state = block_that_drifts()) {
  const Point nowhere{0, 0};
  watch_energy({nowhere, 1.0}, {0.01, 0.0, 0}, state);
  for (double& v : state.bodies[0].v[0]) v *= std::sqrt(factor);
  for (double& v : state.bodies[0].v[1]) v *= std::sqrt(factor);
  try {
    watch_energy({gravity, 1.0}, {0.01, 0.5, energy_watch_interval}, state);
  } catch (const RunError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("Half as much energy again is too much, and what is no number too") {
  CHECK(said_of(1.4) == "");
  CHECK(contains(said_of(1.6), "energy grows without cause"));
  CHECK(contains(said_of(1.6), "in order until t = 0.01 s"));
  CHECK(contains(said_of(std::numeric_limits<double>::quiet_NaN()), "energy grows without cause"));
  CHECK(contains(said_of(std::numeric_limits<double>::quiet_NaN()), "strain hold more than any number, but"));
}

TEST_CASE("Of soil that has opened it says what it wants: a memory of its voids") {
  State<2> state = block_that_drifts();
  Body<2>& block = state.bodies[0];
  CHECK_FALSE(contains(said_of(1.6), "void_memory"));
  block.material = MohrCoulomb{1000, 2e6, 1e6, 2e4, 0.5, 0.8, 0, 0, 0};
  CHECK_FALSE(contains(said_of(1.6, {0, 0}, state), "void_memory"));
  block.J.back() = 2.5;
  CHECK(contains(said_of(1.6, {0, 0}, state), "void_memory may cure it"));
  block.material = LinearElastic{1000, 2e6, 1e6};
  CHECK_FALSE(contains(said_of(1.6, {0, 0}, state), "void_memory"));
}

TEST_CASE("What is no number is said in words, of what was given too") {
  const std::string said = said_of(std::numeric_limits<double>::quiet_NaN(), {0, -1.7e308});
  CHECK(contains(said, "moving bodies gave more than any number"));
  CHECK_FALSE(contains(said, "nan"));
}

TEST_CASE("A run with too large a time step ends with 1, the reason, and frames from before") {
  const SceneRun run(drifting, {"solver.courant=0.85", "output.frame_interval=1.0"});
  CHECK(run.outcome().code == 1);
  CHECK(run.text("status") == "failed");
  const std::string message = run.text("message");
  CHECK(contains(message, "energy grows without cause"));
  const std::string good = message.substr(message.find("until t = ") + 10);
  CHECK(std::stod(good) < 60);
  CHECK(std::filesystem::exists(run.file("particles_000001.vtu")));
}

TEST_CASE("What gravity gives is no growth: a block at rest that falls") {
  const SceneRun run(drifting, {"gravity=[0.0,-0.01]", "bodies.block.initial_velocity={type='uniform',value=[0.0,0.0]}",
                                "time.end=20"});
  CHECK(run.text("status") == "done");
}

TEST_CASE("Nor is the work of what moves; it adds up with the energy of the block") {
  const Scene scene = read_scene(source_path("tests/scenes/pushed_block.toml"));
  State<2> state = build_state<2>(scene);
  Grids<2> grids = make_grids<2>(scene);
  Pipeline<2> pipeline = build_pipeline<2>(scene);
  REQUIRE(pipeline.back().name == "energy_watch");
  while (!is_over(scene, state)) REQUIRE_NOTHROW(advance(pipeline, state, grids));
  const RigidContact<2>& contact = state.rigid_contacts[0];
  const double gained = measure(state, scene.gravity).energy(), mass = 1600;
  CHECK(gained > 0.9 * 0.5 * mass);  // it does not stay behind the wall, nor does it stick to it
  CHECK(contact.driving_work - contact.damping_work == near(gained, 0.1));
}

TEST_CASE("A new budget begins with a stage in time") {
  const Point nowhere{0, 0};
  State<2> state = build_state<2>(read_scene(source_path(drifting)));
  watch_energy({nowhere, 1.0}, {0.01, 0.0, 0}, state);
  for (double& v : state.bodies[0].v[0]) v *= 10;
  ++state.stages_entered;
  CHECK_NOTHROW(watch_energy({nowhere, 1.0}, {0.01, 0.5, energy_watch_interval}, state));
}

TEST_CASE("Nobody watches where a solution drives a body; all others are watched") {
  const auto watched = [](const char* scene) {
    return build_pipeline<2>(read_scene(source_path(scene))).back().name == "energy_watch";
  };
  CHECK_FALSE(watched("cases/verification/mms_axis_aligned.toml"));
  for (const char* scene :
       {"tests/scenes/tube.toml", "cases/verification/viscous_boundary.toml", "cases/verification/silent_side.toml",
        "cases/geotube_submerged.toml", "cases/verification/infinite_slope_slides.toml", "cases/dump_kekerdom.toml",
        "cases/dump_barge_underwater.toml", "cases/verification/taylor_green.toml", "cases/elastic_bar.toml"})
    CHECK(watched(scene));
}
