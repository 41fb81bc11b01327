// Rigid bodies in the stages of a scene: they move where a stage says so, and are gone once one has taken them away.
#include "setup/scene_stages.hpp"

#include <doctest/doctest.h>
#include <geodrop/base/find_named.hpp>
#include <geodrop/step/pipeline.hpp>

#include "support/near.hpp"
#include "support/scene_files.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

const std::string in_stages =
    "stages=[{name='wait',from=0.0},{name='open',from=0.05,moves=['gate']},"
    "{name='stop',from=0.1,removes=['wheel']}]";

/// The state after all steps up to a time.
State<2> state_at(double end) {
  const Scene scene = read_scene(source_path("tests/scenes/ramp.toml"), {in_stages});
  State<2> state = build_state<2>(scene);
  Grids<2> grids = make_grids<2>(scene);
  Pipeline<2> pipeline = build_pipeline<2>(scene);
  while (state.t < end) advance(pipeline, state, grids);
  return state;
}

}  // namespace

TEST_CASE("A rigid body moves only in stages that name it, for as long as they last") {
  const State<2> before = state_at(0.045), opening = state_at(0.09), after = state_at(0.15);
  CHECK(find_named(before.rigid, "gate").angle == 0);
  CHECK(find_named(before.rigid, "ram").displacement[1] == 0);
  CHECK(find_named(opening.rigid, "gate").angle == near(-2 * 0.04, 0.05));
  CHECK(find_named(opening.rigid, "ram").displacement[1] == 0);
  CHECK(find_named(after.rigid, "gate").angle == near(-2 * 0.05, 0.05));
  CHECK(find_named(after.rigid, "gate").angle_rate == 0);
}

TEST_CASE("A rigid body that a stage removes is there up to then") {
  const State<2> before = state_at(0.09), after = state_at(0.15);
  CHECK(find_named(before.rigid, "wheel").present);
  CHECK_FALSE(find_named(after.rigid, "wheel").present);
  CHECK(find_named(after.rigid, "gate").present);
}
