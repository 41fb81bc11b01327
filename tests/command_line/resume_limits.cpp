// What --resume and --until refuse or warn of.
#include <doctest/doctest.h>

#include <geodrop/files/checkpoint.hpp>
#include <geodrop/reader/scene_reader.hpp>

#include <filesystem>

#include "support/program.hpp"
#include "support/text.hpp"

using namespace geodrop::test;

namespace {

const std::string scene = "cases/hydrostatic_column.toml";
const std::vector<std::string> settings{"time.end=0.1", "grid.spacing=0.5"};

/// Stopped with two checkpoints.
SceneRun stopped_run() {
  return SceneRun(scene, {"time.end=0.1", "grid.spacing=0.5", "output.checkpoint_every=0.02"}, {"--until", "0.05"});
}

/// Gives a checkpoint another state, which has its right checksum then.
void change_state(const SceneRun& run, const std::string& name, void (*change)(geodrop::State<2>&)) {
  const geodrop::Scene as_run = geodrop::read_scene(geodrop::source_path(scene), settings);
  geodrop::Checkpoint<2> checkpoint = geodrop::read_checkpoint<2>(run.file(name), as_run);
  change(checkpoint.state);
  geodrop::write_checkpoint(run.file(name), as_run, checkpoint.state, checkpoint.output);
}
void send_away(geodrop::State<2>& state) { state.bodies.at(0).x[1].at(5) = 1e6; }
void empty(geodrop::State<2>& state) { state.bodies.at(0).J.at(5) = 0; }

}  // namespace

TEST_CASE("A newest checkpoint with a state that no run has is refused in one line, and the one before is taken") {
  SceneRun run = stopped_run();
  const SceneRun whole(scene, settings);
  change_state(run, "checkpoint.bin", send_away);
  CHECK(run.again({"--resume"}).code == 0);
  CHECK(contains(run.outcome().out,
                 "\nwarning: checkpoint.bin is no use: a checkpoint with body 'water': a particle outside of the "
                 "domain; the run goes on from the one before, checkpoint.previous.bin\n"));
  CHECK(run.hash() == whole.hash());
  CHECK((geodrop::read_file(run.file("history.csv")) == geodrop::read_file(whole.file("history.csv"))));
}

TEST_CASE("Two checkpoints that are refused are each named with the reason, and nothing is touched") {
  SceneRun run = stopped_run();
  change_state(run, "checkpoint.bin", send_away);
  change_state(run, "checkpoint.previous.bin", empty);
  const std::string log = geodrop::read_file(run.file("run.log"));
  CHECK(run.again({"--resume"}).code == 2);
  const std::string& told = run.outcome().err;
  CHECK(contains(told, ": checkpoint.bin: --resume: found a checkpoint with body 'water': a particle outside of the "));
  CHECK(
      contains(told, ": checkpoint.previous.bin: --resume: found a checkpoint with body 'water': a particle without "));
  CHECK(geodrop::read_file(run.file("run.log")) == log);
}

TEST_CASE("A finished run keeps one checkpoint; resumed without more to do it says that it is finished") {
  SceneRun run(scene, settings);
  REQUIRE(run.outcome().code == 0);
  CHECK(std::filesystem::exists(run.file("checkpoint.bin")));
  const std::string summary = run.summary();
  CHECK(run.again({"--resume"}).code == 2);
  CHECK(contains(run.outcome().err, "--resume: found a run that is finished (t = 0.1"));
  CHECK(run.summary() == summary);
  std::filesystem::remove(run.file("checkpoint.bin"));
  CHECK(run.again({"--resume"}).code == 2);
  CHECK(contains(run.outcome().err, "--resume: found a run that is finished (t = 0.1"));
}

TEST_CASE("A finished run goes on to a later end, and leaves what a run to that end leaves") {
  SceneRun run(scene, settings);
  const SceneRun longer(scene, {"time.end=0.25", "grid.spacing=0.5"});
  CHECK(run.again({"--resume", "--set", "time.end=0.25"}).code == 0);
  CHECK(run.hash() == longer.hash());
  for (const char* file : {"history.csv", "particles.pvd", "scene.toml", "particles_000001.vtu"})
    CHECK((geodrop::read_file(run.file(file)) == geodrop::read_file(longer.file(file))));
}

TEST_CASE("A run that was stopped by --until does not judge its expectations") {
  SceneRun run("cases/hydrostatic_column.toml", {"expect.1.tolerance=0"}, {"--until", "0.05", "--verify"});
  CHECK(run.outcome().code == 75);
  CHECK(contains(run.summary(), "\"expectations\": []"));
  CHECK(contains(run.outcome().out, "\ngo on with: "));
}

TEST_CASE("A run that was resumed to its end keeps only the checkpoint of its end") {
  SceneRun run(scene, settings, {"--until", "0.05"});
  REQUIRE(std::filesystem::exists(run.file("checkpoint.bin")));
  REQUIRE(run.again({"--resume"}).code == 0);
  CHECK_FALSE(std::filesystem::exists(run.file("checkpoint.previous.bin")));
  CHECK_FALSE(std::filesystem::exists(run.file("checkpoint.reserve")));
  CHECK(run.again({"--resume"}).code == 2);
  CHECK(contains(run.outcome().err, "finished"));
}

TEST_CASE("--until must be after the checkpoint; beyond the end of the scene it is a warning") {
  SceneRun run(scene, settings, {"--until", "0.05"});
  for (const char* until : {"0.02", "0.05"}) {
    CAPTURE(until);
    CHECK(run.again({"--resume", "--until", until}).code == 2);
    CHECK(contains(run.outcome().err,
                   std::string("--until: found ") + until + "; allowed: a time after the checkpoint's"));
  }
  CHECK_FALSE(contains(run.outcome().out, "beyond"));
  CHECK(run.again({"--resume", "--until", "0.2"}).code == 0);
  CHECK(contains(run.outcome().out, "warning: --until 0.2 is beyond time.end; the run ends at t = 0.1 s"));
  CHECK(contains(geodrop::read_file(run.file("run.log")), "warning: --until 0.2"));
}
