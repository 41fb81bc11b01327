// `geodrop replay` through the program: what it compares, what it names, how it ends.
#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "support/program.hpp"
#include "support/text.hpp"

using namespace geodrop::test;

namespace {

const std::vector<std::string> settings{"grid.spacing=0.5", "time.end=0.05", "output.history_interval=0.01"};

SceneRun recorded(const std::vector<std::string>& more = {}) {
  return SceneRun("cases/dump_kekerdom_mixture.toml", settings, more);
}

Outcome replay(const SceneRun& run, const std::string& threads = "1") {
  return run_program({"replay", run.file("scene.toml").parent_path(), "--threads", threads});
}

/// Line `number` of a file, from 0.
std::string line_of(const std::filesystem::path& path, int number) {
  std::istringstream lines(geodrop::read_file(path));
  std::string line;
  for (int k = 0; k <= number; ++k) std::getline(lines, line);
  return line;
}

void replace(const std::filesystem::path& path, const std::string& old, const std::string& by) {
  std::string text = geodrop::read_file(path);
  const std::size_t at = text.find(old);
  REQUIRE(at != std::string::npos);
  text.replace(at, old.size(), by);
  std::ofstream(path) << text;
}

/// "0.0100512,13,0123456789abcdef" without its hash.
std::string without_hash(const std::string& row) { return row.substr(0, row.rfind(',')); }
std::string step_of(const std::string& row) {
  const std::size_t comma = row.find(',');
  return row.substr(comma + 1, row.rfind(',') - comma - 1);
}

}  // namespace

TEST_CASE("A run is the same again, on one thread and on two; it has a hash for each row of its history") {
  const SceneRun run = recorded({"--threads", "2"});
  REQUIRE(run.outcome().code == 0);
  const std::string hashes = geodrop::read_file(run.file("hashes.csv"));
  CHECK(std::count(hashes.begin(), hashes.end(), '\n') == 1 + static_cast<long>(run.column("time_s").size()));
  for (const std::string threads : {"1", "2"}) {
    const Outcome outcome = replay(run, threads);
    CHECK(outcome.code == 0);
    CHECK(contains(outcome.out, "the same states: 6 hashes, to t = 0.05"));
  }
}

TEST_CASE("A recorded hash that differs is named with its interval and both hashes") {
  const SceneRun run = recorded();
  const std::string before = line_of(run.file("hashes.csv"), 3), row = line_of(run.file("hashes.csv"), 4);
  replace(run.file("hashes.csv"), row, without_hash(row) + ",0123456789abcdef");
  const Outcome outcome = replay(run);
  CHECK(outcome.code == 1);
  const std::string told = line(outcome.out, "differs first between");
  CHECK(contains(told, "(step " + step_of(before) + ") and"));
  CHECK(contains(told,
                 "(step " + step_of(row) + "): 0123456789abcdef recorded, " + row.substr(row.rfind(',') + 1) + " now"));
}

TEST_CASE("A scene that was changed differs where the change acts") {
  const SceneRun run("tests/scenes/block_on_slab.toml", {"time.end=0.03", "output.history_interval=0.005",
                                                         "stages=[{name='slab',from=0.0,damping_rate=4.0},"
                                                         "{name='both',from=0.02,places=['block'],damping_rate=6.0}]"});
  REQUIRE(run.outcome().code == 0);
  REQUIRE(replay(run).code == 0);
  replace(run.file("scene.toml"), "damping_rate = 6.0", "damping_rate = 5.0");
  const Outcome outcome = replay(run);
  CHECK(outcome.code == 1);
  CHECK(contains(outcome.out, "differs first between t = 0.02"));
  CHECK(contains(outcome.out, "and t = 0.025"));
}

TEST_CASE("Parts: the first stage whose hash differs is named") {
  const SceneRun run = recorded({"--record-parts", "20:22"});
  REQUIRE(run.outcome().code == 0);
  CHECK(line_of(run.file("parts.csv"), 1).starts_with("20,stable_dt,"));
  CHECK(replay(run, "2").code == 0);
  std::string part;
  for (int k = 1; !part.starts_with("21,momentum,"); ++k) part = line_of(run.file("parts.csv"), k);
  replace(run.file("parts.csv"), part, "21,momentum,0123456789abcdef");
  std::string row;
  for (int k = 1; row.empty() || std::stoi(step_of(row)) <= 21; ++k) row = line_of(run.file("hashes.csv"), k);
  replace(run.file("hashes.csv"), row, without_hash(row) + ",fedcba9876543210");
  const Outcome outcome = replay(run);
  CHECK(outcome.code == 1);
  CHECK(contains(outcome.out, "first in step 21, after the stage momentum: 0123456789abcdef recorded, " +
                                  part.substr(part.rfind(',') + 1) + " now"));
}

TEST_CASE("A resumed run has the hashes of an uninterrupted one, and replays") {
  const SceneRun whole = recorded();
  SceneRun run = recorded({"--until", "0.023"});
  CHECK(run.again({"--resume"}).code == 0);
  CHECK(geodrop::read_file(run.file("hashes.csv")) == geodrop::read_file(whole.file("hashes.csv")));
  CHECK(replay(run).code == 0);
}

TEST_CASE("No such run, no such steps: exit 2") {
  const Outcome outcome = run_program({"replay", geodrop::source_path("cases")});
  CHECK(outcome.code == 2);
  CHECK(contains(outcome.err, "no recorded run"));
  CHECK(recorded({"--record-parts", "7:3"}).outcome().code == 2);
}
