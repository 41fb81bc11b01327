// What a run may change when it goes on: its end and its output, and nothing that it computes.
#include <doctest/doctest.h>

#include "support/program.hpp"
#include "support/text.hpp"

using namespace geodrop::test;

namespace {

const std::string scene = "tests/scenes/tube.toml";

}  // namespace

TEST_CASE("A stopped run goes on to a later end, with other output: the hash of one that had it from the start") {
  SceneRun run(scene, {"grid.spacing=0.2", "time.end=0.03"}, {"--until", "0.015"});
  REQUIRE(run.outcome().code == 75);
  const std::vector<std::string> later{"--set", "time.end=0.05", "--set",   "output.history_interval=0.001",
                                       "--set", "title=on",      "--set",   "results=[]",
                                       "--set", "expect=[]",     "--resume"};
  CHECK(run.again(later).code == 0);
  // The state remembers the largest tension since the last row, hence the same interval of rows.
  const SceneRun whole(scene, {"grid.spacing=0.2", "time.end=0.05", "output.history_interval=0.001"});
  CHECK(run.hash() == whole.hash());
}

TEST_CASE("What a run computes cannot change: the first key that differs is named") {
  SceneRun run(scene, {"grid.spacing=0.2", "time.end=0.03"}, {"--until", "0.015"});
  const Outcome& outcome = run.again({"--set", "solver.courant=0.25", "--resume"});
  CHECK(outcome.code == 2);
  CHECK(contains(outcome.err, "--resume: found a checkpoint of another scene: solver.courant = "));
  CHECK(contains(outcome.err, ", here 0.25; allowed: the scene, with the same --set"));
}

TEST_CASE("check refuses a scene that ends at its first step; info tells its memory") {
  const Outcome outcome = run_program({"check", geodrop::source_path(scene), "--set", "solver.damping_rate=1e300"});
  CAPTURE(outcome.err);
  CHECK(outcome.code == 2);
  CHECK(contains(outcome.err, "tube.toml:1:1: time: found the time step collapsed: at "));
  CHECK_FALSE(contains(outcome.err, "inf"));
  CHECK(contains(run_program({"info", geodrop::source_path(scene)}).out, "memory_bytes "));
}

TEST_CASE("More particles than there is memory for: refused before any is made, with the amount") {
  // 8e9 particles in 2e7 cells: some terabytes.
  const Outcome outcome = run_program({"info", geodrop::source_path("cases/hydrostatic_column_3d.toml"), "--set",
                                       "grid.spacing=0.005", "--set", "bodies.water.particles_per_cell_axis=8"});
  CAPTURE(outcome.err);
  CHECK(outcome.code == 2);
  CHECK(contains(outcome.err, "grid.spacing: found a scene that takes about "));
  CHECK(contains(outcome.err, "the memory here"));
}
