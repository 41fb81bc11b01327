// What draws and compares runs, of one that is still being written, that was killed early, that has no frames.
#include <doctest/doctest.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "support/program.hpp"
#include "support/text.hpp"

using namespace geodrop::test;
namespace fs = std::filesystem;

namespace {

const std::string scene = geodrop::source_path("cases/gravity_column.toml"), running = "is not over (status running)";

/// Commands that have what they need in a history and frames.
const std::vector<std::vector<std::string>> commands{
    {"snapshot"}, {"animate"}, {"plot"}, {"plot", "--columns", "column.velocity_y_m_s"}, {"report"}};

Outcome of_run(std::vector<std::string> command, const fs::path& run) {
  command.push_back(run.string());
  return run_program(command);
}

void make_run(const fs::path& run) {
  REQUIRE(run_program({"run", scene, "--set", "time.end=0.1", "--output", run.string()}).code == 0);
}

}  // namespace

TEST_CASE("A run that is still being written is drawn as far as it has come, and that is said") {
  const geodrop::TemporaryDirectory directory;
  const fs::path run = fs::path(directory / "run"), other = fs::path(directory / "other");
  make_run(other);
  Program program({"run", scene, "--output", run.string(), "--set", "time.end=1e4", "--set",
                   "output.frame_interval=2.0", "--set", "output.history_interval=0.01"});
  constexpr int most = 3000;
  for (int i = 0; i < most && !fs::exists(run / "particles_000001.vtu"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  for (const auto& command : commands) {
    const Outcome outcome = of_run(command, run);
    CAPTURE(command.front());
    CAPTURE(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(contains(outcome.err, run.string() + ' ' + running));
    CHECK_FALSE(contains(of_run(command, other).err, running));
  }
  const std::string page = geodrop::read_file(run / "report.html");
  CHECK(contains(page, "<b>running</b> at t = "));
  CHECK_FALSE(contains(page, "<b>running</b> at t = 0 "));
  const Outcome compared = run_program({"compare", run.string(), other.string()});
  CHECK(compared.code == 0);
  CHECK(contains(compared.err, running));
  CHECK(line(compared.out, "status") == "status running done");
  CHECK(line(compared.out, "steps").starts_with("steps - "));
  program.signal(SIGKILL);
  program.wait();
}

TEST_CASE("A run without frames is drawn where no frame is needed, and refused where one is") {
  const geodrop::TemporaryDirectory directory;
  const fs::path run = fs::path(directory / "run");
  make_run(run);
  std::vector<fs::path> frames;
  for (const auto& entry : fs::directory_iterator(run))
    if (entry.path().filename().string().starts_with("particles")) frames.push_back(entry.path());
  for (const fs::path& frame : frames) fs::remove(frame);
  for (const auto& command : commands) {
    const Outcome outcome = of_run(command, run);
    CAPTURE(command.front());
    CAPTURE(outcome.err);
    const bool needs_frames = command.front() == "snapshot" || command.front() == "animate";
    CHECK(outcome.code == (needs_frames ? 2 : 0));
    CHECK(contains(outcome.err, "run: found a run without frames; allowed: the frames of a run") == needs_frames);
  }
  CHECK(contains(geodrop::read_file(run / "report.html"), "<b>done</b>"));
}

TEST_CASE("A run that was killed before its first frame and row, and what is no run, are refused by name") {
  const geodrop::TemporaryDirectory directory;
  const fs::path run = fs::path(directory / "run");
  fs::create_directories(run);
  std::ofstream(run / "summary.json") << R"({"status": "running"})";
  std::ofstream(run / "history.csv") << "time_s,column.velocity_y_m_s\n";
  for (const auto& command : commands) {
    const Outcome outcome = of_run(command, run), none = of_run(command, directory / "none");
    const bool needs_frames = command.front() == "snapshot" || command.front() == "animate";
    CAPTURE(outcome.err);
    CHECK(outcome.code == 2);
    if (needs_frames) CHECK(contains(outcome.err, "run: found a run without a frame so far"));
    if (command.front() == "plot") CHECK(contains(outcome.err, "history.csv: found no row of numbers"));
    CHECK(none.code == 2);
    CHECK(contains(none.err, "found no such file; allowed: the "));
  }
}
