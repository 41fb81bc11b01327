// What a new run does to an earlier one in its directory, and that two never share one.
#include <doctest/doctest.h>

#include <csignal>

#include "support/survival.hpp"

using namespace geodrop::test;

namespace {

const std::string scene = "cases/hydrostatic_column.toml";
const std::vector<std::string> settings{"time.end=0.05", "grid.spacing=0.5"};

std::string directory_of(const SceneRun& run) { return run.file("").parent_path().string(); }

}  // namespace

TEST_CASE("An earlier run moves aside, --overwrite replaces it") {
  SceneRun run(scene, settings);
  std::ofstream(run.file("notes.txt")) << "mine";
  CHECK(run.again({}).code == 0);
  const std::string aside = directory_of(run) + ".1";
  CHECK(line(run.outcome().out, "an earlier run") ==
        "an earlier run in " + directory_of(run) + " was moved aside, to " + aside);
  CHECK(geodrop::read_file(aside + "/notes.txt") == "mine");
  CHECK(std::filesystem::exists(aside + "/summary.json"));
  CHECK_FALSE(std::filesystem::exists(run.file("notes.txt")));
  CHECK(run.again({"--overwrite"}).code == 0);
  CHECK(contains(run.outcome().out, "replaced an earlier run in "));
  CHECK_FALSE(std::filesystem::exists(directory_of(run) + ".2"));
  CHECK(run.again({"--overwrite", "--resume"}).code == 2);
}

TEST_CASE("The directory in which the command runs is not moved") {
  SceneRun run(scene, settings);
  const std::string summary = run.summary();
  const std::string command = "cd '" + directory_of(run) + "' && " +
                              in_shell({"run", geodrop::source_path(scene), "--set", settings[0], "--output", "."});
  CHECK(shell(command + " 2>/dev/null >&2") == 2);
  CHECK(run.summary() == summary);
  CHECK(shell(command + " --overwrite 2>/dev/null >&2") == 0);
}

TEST_CASE("A run that was killed before its first line does not keep others out of its directory") {
  SceneRun run(scene, settings, {}, SceneRun::Begin::later);
  std::filesystem::create_directory(run.file(""));
  std::ofstream(run.file("run.log"));
  std::ofstream(run.file("run.lock"));
  CHECK(run.again({}).code == 0);
  CHECK_FALSE(std::filesystem::exists(directory_of(run) + ".1"));
  std::ofstream(run.file("run.log"));  // and by a power cut
  CHECK(run.again({}).code == 0);
  CHECK(std::filesystem::exists(directory_of(run) + ".1"));
}

TEST_CASE("A second run in the same directory is refused with process and machine of the first; a killed one is not") {
  SceneRun run(scene, {"time.end=1000", "grid.spacing=0.5"}, {}, SceneRun::Begin::later);
  const Program first(run.arguments({}));
  REQUIRE(wait_for([&] { return contains(geodrop::read_file(run.file("run.lock")), "host"); }));
  std::string lock = geodrop::read_file(run.file("run.lock"));
  lock.pop_back();
  CHECK(wait_for_file(run.file("history.csv")));
  for (const char* how : {"--overwrite", "--threads=1"}) {
    const Outcome second = run_program(run.arguments({how}));
    CHECK(second.code == 2);
    CHECK(contains(second.err, "a directory in which another run is at work (" + lock + ")"));
  }
  first.signal(SIGUSR1);
  CHECK(wait_for_file(run.file("checkpoint.bin")));
  CHECK(run_program(run.arguments({"--resume"})).code == 2);
  first.signal(SIGKILL);
  first.wait();
  CHECK(run.text("status") == "running");
  const Outcome resumed = run_program(run.arguments({"--resume", "--until", "0.001"}));
  CHECK(contains(resumed.err, "--until: found 0.001; allowed: a time after the checkpoint's"));
}
