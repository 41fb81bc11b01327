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

TEST_CASE("A finished run cannot be resumed, and says that it is finished") {
  SceneRun run(scene, settings);
  REQUIRE(run.outcome().code == 0);
  CHECK_FALSE(std::filesystem::exists(run.file("checkpoint.bin")));
  const std::string summary = run.summary();
  CHECK(run.again({"--resume"}).code == 2);
  CHECK(contains(run.outcome().err, "--resume: found a run that is finished (t = 0.1"));
  CHECK(run.summary() == summary);
}

TEST_CASE("A run that was resumed to its end leaves no checkpoint of its middle") {
  SceneRun run(scene, settings, {"--until", "0.05"});
  REQUIRE(std::filesystem::exists(run.file("checkpoint.bin")));
  REQUIRE(run.again({"--resume"}).code == 0);
  CHECK_FALSE(std::filesystem::exists(run.file("checkpoint.bin")));
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
  CHECK_FALSE(std::filesystem::exists(run.file("checkpoint.bin")));
}
