// A run that is killed at any instant goes on from its last checkpoint and leaves what an uninterrupted one leaves.
#include <doctest/doctest.h>

#include <chrono>
#include <csignal>
#include <random>

#include "support/survival.hpp"

using namespace geodrop::test;

namespace {

/// Runs until `wall` has passed, then kills. A run that was killed before its first checkpoint has to begin anew.
/// Returns whether the kill met a run.
bool run_and_kill(SceneRun& run, std::chrono::duration<double> wall, const std::string& threads) {
  std::vector<std::string> more{"--threads", threads};
  const bool can_resume = std::filesystem::exists(run.file("checkpoint.bin"));
  more.push_back(can_resume ? "--resume" : "--overwrite");
  const Program program(run.arguments(more));
  std::this_thread::sleep_for(wall);
  program.signal(SIGKILL);
  return program.wait().code == 128 + SIGKILL;
}

int finish(SceneRun& run) {
  const bool can_resume = std::filesystem::exists(run.file("checkpoint.bin"));
  const int code = run.again({can_resume ? "--resume" : "--overwrite"}).code;
  // Killed after its end was written: nothing is left to do.
  return code == 2 && contains(run.outcome().err, "a run that is finished") ? 0 : code;
}

}  // namespace

TEST_CASE("Killed at 20 random instants, some runs again and again, and resumed: the same files, byte for byte") {
  const auto start = std::chrono::steady_clock::now();
  const SceneRun whole(drop, short_drop(), {"--threads", "1"});
  std::chrono::duration<double> takes = std::chrono::steady_clock::now() - start;
  REQUIRE(whole.outcome().code == 0);
  constexpr int instants = 20, times_at_most = 4;
  std::mt19937 random(16);
  std::uniform_real_distribution<double> part(0.02, 1.0);
  int killed = 0, resumed = 0;
  for (int tries = 0; killed < instants && tries < 5 * instants;) {
    SceneRun run(drop, short_drop(), {}, SceneRun::Begin::later);
    for (int times = 0; times < times_at_most && killed < instants; ++times, ++tries) {
      const bool met = run_and_kill(run, part(random) * takes, times % 2 == 0 ? "1" : "2");
      killed += met;
      if (!met) takes *= 0.7;  // the machine is less busy than it was
      resumed += std::filesystem::exists(run.file("checkpoint.bin"));
      if (std::filesystem::exists(run.file("summary.json"))) CHECK_FALSE(run.text("status") == "failed");
    }
    CHECK(finish(run) == 0);
    check_same(run, whole);
  }
  CHECK(killed == instants);
  CHECK(resumed >= instants / 2);
}
