// What --resume and --until refuse or warn of.
#include <doctest/doctest.h>

#include <filesystem>

#include "support/program.hpp"
#include "support/text.hpp"

using namespace geodrop::test;

namespace {

const std::string scene = "cases/hydrostatic_column.toml";
const std::vector<std::string> settings{"time.end=0.1", "grid.spacing=0.5"};

}  // namespace

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
