// Signals, pipes that close, damaged checkpoints: the run goes on, or goes on later, and leaves the same files.
#include <doctest/doctest.h>

#include <csignal>
#include <sstream>

#include "support/survival.hpp"

using namespace geodrop::test;

namespace {

const SceneRun& whole() {
  static const SceneRun run(drop, short_drop(), {"--threads", "1"});
  return run;
}

/// Sends `number` once the run has written its frame 5, and waits for its end.
Outcome signalled(SceneRun& run, int number, const std::vector<std::string>& more) {
  const Program program(run.arguments(more));
  CHECK(wait_for_file(run.file("particles_000005.vtu")));
  program.signal(number);
  return program.wait();
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

}  // namespace

TEST_CASE("SIGTERM and SIGHUP: 75, the command that goes on, and on other threads the same files") {
  for (const int number : {SIGTERM, SIGHUP}) {
    SceneRun run(drop, short_drop(), {}, SceneRun::Begin::later);
    const Outcome stopped = signalled(run, number, {"--threads", "1"});
    CHECK(stopped.code == 75);
    CHECK(contains(stopped.out, "\ngo on with: "));
    CHECK(run.text("status") == "stopped");
    CHECK(run.again({"--resume", "--threads", "2"}).code == 0);
    check_same(run, whole());
  }
}

TEST_CASE("SIGUSR1: a checkpoint, no frame, no end") {
  SceneRun run(drop, short_drop({"output.checkpoint_interval=0"}), {}, SceneRun::Begin::later);
  const Program program(run.arguments({"--threads", "1"}));
  REQUIRE(wait_for_file(run.file("particles_000003.vtu")));
  CHECK_FALSE(std::filesystem::exists(run.file("checkpoint.bin")));
  CHECK(run.text("status") == "running");
  CHECK(contains(run.text("command"), " run "));
  program.signal(SIGUSR1);
  CHECK(wait_for_file(run.file("checkpoint.bin")));
  CHECK(program.wait().code == 0);
  CHECK(run.hash() == whole().hash());
  CHECK(files_of(run).at("particles.pvd") == files_of(whole()).at("particles.pvd"));
}

TEST_CASE("Checkpoints by simulated time: two are kept, and neither state nor files depend on them") {
  SceneRun run(drop, short_drop({"output.checkpoint_interval=0", "output.checkpoint_every=0.05"}), {"--until", "0.33"});
  CHECK(std::filesystem::exists(run.file("checkpoint.previous.bin")));
  CHECK(run.again({"--resume"}).code == 0);
  CHECK(run.hash() == whole().hash());
  CHECK(geodrop::read_file(run.file("history.csv")) == geodrop::read_file(whole().file("history.csv")));
}

TEST_CASE("A damaged checkpoint: the run goes on from the one before, and says so") {
  SceneRun run(drop, short_drop(), {}, SceneRun::Begin::later);
  const Program program(run.arguments({}));
  CHECK(wait_for_file(run.file("checkpoint.previous.bin")));
  program.signal(SIGKILL);
  program.wait();
  std::filesystem::resize_file(run.file("checkpoint.bin"), 5000);
  CHECK(run.again({"--resume"}).code == 0);
  CHECK(contains(run.outcome().out, "warning: checkpoint.bin is no use: "));
  CHECK(contains(run.outcome().out, "the run goes on from the one before, checkpoint.previous.bin"));
  check_same(run, whole());
}

TEST_CASE("A pipe that nobody reads, or a closed output: the run is done and run.log has it all, once") {
  SceneRun run(drop, short_drop({"time.end=0.1"}), {}, SceneRun::Begin::later);
  const std::string command = in_shell(run.arguments({"--threads", "1", "--overwrite"}));
  const std::filesystem::path code = std::filesystem::temp_directory_path() / ("code_" + std::to_string(getpid()));
  CHECK(shell("{ " + command + "; echo $? >" + code.string() + "; } | true") == 0);
  CHECK(geodrop::read_file(code) == "0\n");
  std::filesystem::remove(code);
  CHECK(run.text("status") == "done");
  CHECK(contains(geodrop::read_file(run.file("run.log")), "\ndone at t = "));
  CHECK(shell(command + " >&- 2>&- <&-") == 0);
  CHECK(count(geodrop::read_file(run.file("run.log")), "\ndone at t = ") == 1);
  CHECK(count(geodrop::read_file(run.file("run.log")), "frame 3\n") == 1);
}

TEST_CASE("A run that breaks keeps the checkpoint from before, and tells how to go back to it") {
  // Water that falls on a wall, thrown so fast that the wall presses it to nothing.
  const SceneRun run("cases/hydrostatic_column.toml",
                     {"time.end=0.5", "output.checkpoint_every=0.0001", "output.checkpoint_interval=0",
                      "bodies.water.initial_velocity={type='uniform', value=[100.0, 500.0]}"});
  CHECK(run.outcome().code == 1);
  CHECK(run.text("status") == "failed");
  CHECK(std::filesystem::exists(run.file("checkpoint.bin")));
  CHECK(contains(run.outcome().out, "is from before the break and is kept; back to it with: "));
}
