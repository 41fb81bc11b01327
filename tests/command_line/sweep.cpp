// `geodrop sweep` through the program: cases, manifest, stopped and killed in the middle, the job array.
#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <thread>

#include "files/run_lock.hpp"
#include "support/near.hpp"
#include "support/program.hpp"
#include "support/text.hpp"

using namespace geodrop::test;
namespace fs = std::filesystem;

namespace {

const std::string scene = geodrop::source_path("cases/gravity_column.toml");
const std::string stiffness = "materials.soil.youngs_modulus=", spacing = "grid.spacing=";

std::vector<std::string> sweep(const fs::path& output, const std::vector<std::string>& more) {
  std::vector<std::string> words{"sweep", scene, "--output", output.string(), "--jobs", "2"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// Cases of some seconds each, with few rows and frames.
std::vector<std::string> long_sweep(const fs::path& output) {
  return sweep(output, {"--set", "time.end=8", "--set", "output.history_interval=0.1", "--set",
                        "output.frame_interval=1.0", "--vary", stiffness + "8e6:16e6:3"});
}

std::size_t done(const fs::path& output) {
  const auto table = csv(output / "manifest.csv");
  return static_cast<std::size_t>(
      std::ranges::count_if(table, [](const auto& row) { return std::ranges::find(row, "done") != row.end(); }));
}

template <class Condition>
bool wait_until(const Condition& holds) {
  constexpr int most = 3000;
  for (int i = 0; i < most && !holds(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return holds();
}

bool is_at_work(const fs::path& run) { return fs::exists(run / "summary.json"); }

/// Kills the run that holds the lock of a directory; false if there is none.
bool kill_run(const fs::path& run) {
  std::istringstream lock(geodrop::read_file(run / geodrop::RunLock::file_name));
  std::string word;
  pid_t process = 0;
  return lock >> word >> process && process > 0 && kill(process, SIGKILL) == 0;
}

}  // namespace

TEST_CASE("A sweep of two keys: all combinations, settlement goes as 1/E") {
  const geodrop::TemporaryDirectory directory;
  const fs::path output = fs::path(directory / "columns");
  const std::vector<std::string> more{"--vary", stiffness + "8e6:16e6:2", "--vary", "solver.courant=0.3,0.4"};
  const Outcome outcome = run_program(sweep(output, more));
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK(contains(outcome.out, "case_004"));
  const auto table = csv(output / "manifest.csv");
  REQUIRE(table.size() == 5);
  REQUIRE(table[0][6] == "displacement_mean_m");
  CHECK(table[2][1] == "8e+06");
  CHECK(table[2][2] == "0.4");
  for (std::size_t i = 1; i < 5; ++i) {
    CHECK(table[i][3] == "done");
    CHECK(std::stod(table[i][1]) * std::stod(table[i][6]) == near(-6600, 0.05));
  }
}

TEST_CASE("A result that a run does not have is a dash in the table and nan in the manifest") {
  const geodrop::TemporaryDirectory directory;
  const fs::path output = fs::path(directory / "columns");
  const std::string result =
      "results=[{name='t_s',column='column.position_y_m',reduce='first_time_below',level=-99.0}]";
  const std::vector<std::string> more{
      "--vary",     "solver.courant=0.3,0.4", "--set", result, "--set", "expect=[]", "--set", "verify=[]", "--set",
      "variants=[]"};
  const Outcome outcome = run_program(sweep(output, more));
  CAPTURE(outcome.out);
  CAPTURE(outcome.err);
  CHECK(contains(line(outcome.out, "case_001"), "done -"));
  CHECK_FALSE(contains(outcome.out, "nan"));
  CHECK(contains(geodrop::read_file(output / "manifest.csv"), "nan"));
}

TEST_CASE("A sweep that is killed leaves runs that go on, and the second call completes it") {
  const geodrop::TemporaryDirectory directory;
  const fs::path output = fs::path(directory / "killed");
  const std::vector<std::string> words = long_sweep(output);
  Program first(words);
  REQUIRE(wait_until([&] { return is_at_work(output / "case_001") && is_at_work(output / "case_002"); }));
  CHECK(csv(output / "manifest.csv")[1][2] == "running");
  first.signal(SIGKILL);
  CHECK(first.wait().code == 128 + SIGKILL);
  // They are asked to stop when their sweep is gone, and have a checkpoint then.
  REQUIRE(wait_until([&] {
    return contains(geodrop::read_file(output / "case_001" / "summary.json"), "\"stopped\"") &&
           contains(geodrop::read_file(output / "case_002" / "summary.json"), "\"stopped\"");
  }));
  CHECK(done(output) == 0);
  const Outcome second = run_program(words);
  CAPTURE(second.err);
  CHECK(second.code == 0);
  CHECK(done(output) == 3);
  CHECK(contains(geodrop::read_file(output / "case_001" / "run.log"), "resumed at t = "));
}

TEST_CASE("A case that a process of an earlier call still writes is waited for, and shown as running") {
  const geodrop::TemporaryDirectory directory;
  const fs::path output = fs::path(directory / "held");
  std::vector<std::string> words = sweep(output, {"--set", "time.end=0.01", "--vary", stiffness + "8e6,16e6"});
  words.emplace_back("--no-run");
  REQUIRE(run_program(words).code == 0);
  fs::create_directories(output / "case_001");
  auto lock = std::make_optional<geodrop::RunLock>(output / "case_001");
  CHECK(contains(line(run_program(words).out, "case_001"), "running"));
  words.pop_back();
  Program waits(words);
  REQUIRE(wait_until([&] { return done(output) == 1; }));
  lock.reset();
  const Outcome outcome = waits.wait();
  CHECK(outcome.code == 0);
  CHECK(contains(outcome.out, "case_001: waits for process " + std::to_string(getpid())));
  CHECK(done(output) == 2);
}

TEST_CASE(
    "Twenty cases, all processes killed at once in the middle: the same command completes them, with the same "
    "numbers") {
  const geodrop::TemporaryDirectory directory;
  const fs::path killed = fs::path(directory / "killed"), whole = fs::path(directory / "whole");
  const std::vector<std::string> more{"--set",  "time.end=0.5",           "--set", "output.history_interval=0.01",
                                      "--vary", stiffness + "8e6:16e6:20"};
  Program first(sweep(killed, more));
  REQUIRE(wait_until([&] { return fs::exists(killed / "manifest.csv") && done(killed) >= 7; }));
  int runs = 0;
  REQUIRE(wait_until([&] {
    first.signal(SIGSTOP);  // so that it begins no other run meanwhile
    for (const auto& entry : fs::directory_iterator(killed)) runs += kill_run(entry.path());
    if (runs == 0) first.signal(SIGCONT);
    return runs > 0;
  }));
  first.signal(SIGKILL);
  CHECK(first.wait().code == 128 + SIGKILL);
  CHECK(done(killed) < 20);

  CHECK(run_program(sweep(killed, more)).code == 0);
  CHECK(done(killed) == 20);
  REQUIRE(run_program(sweep(whole, more)).code == 0);
  CHECK(geodrop::read_file(killed / "manifest.csv") == geodrop::read_file(whole / "manifest.csv"));
  const std::string picture = (killed / "mean.svg").string();
  CHECK(run_program({"plot", killed.string(), "--over", "materials.soil.youngs_modulus", "--result",
                     "displacement_mean_m", "--output", picture})
            .code == 0);
  CHECK(contains(geodrop::read_file(picture), "</svg>"));
}

TEST_CASE("A sweep that is stopped says so in its manifest, and goes on") {
  const geodrop::TemporaryDirectory directory;
  const fs::path output = fs::path(directory / "stopped");
  const std::vector<std::string> words = long_sweep(output);
  Program first(words);
  REQUIRE(wait_until([&] { return is_at_work(output / "case_001") && is_at_work(output / "case_002"); }));
  first.signal(SIGTERM);
  const Outcome outcome = first.wait();
  CHECK(outcome.code == 75);
  CHECK(contains(outcome.out, "the same command goes on"));
  const auto table = csv(output / "manifest.csv");
  CHECK(table[1][2] == "stopped");
  CHECK(table[3][2] == "waiting");
  CHECK(run_program(words).code == 0);
  CHECK(done(output) == 3);
}

TEST_CASE("The job array makes one case, and queues it again when its time is over, not when it is cancelled") {
  const geodrop::TemporaryDirectory directory;
  const fs::path output = fs::path(directory / "array"), queue = fs::path(directory / "scontrol");
  const std::vector<std::string> words = long_sweep(output);
  std::vector<std::string> prepare = words;
  prepare.emplace_back("--no-run");
  REQUIRE(run_program(prepare).code == 0);
  CHECK_FALSE(fs::exists(output / "case_001"));
  const std::string script = geodrop::read_file(output / "array.sbatch");
  for (const char* line : {"#SBATCH --array=1-3\n", "#SBATCH --signal=B:USR1@", "#SBATCH --requeue"})
    CHECK(contains(script, line));
  CHECK_FALSE(contains(script, "--jobs"));

  std::ofstream(queue) << "#!/bin/sh\necho \"$@\" >>" << (directory / "requeued").string() << "\n";
  fs::permissions(queue, fs::perms::owner_all);
  // The limit of time is told to the script alone, an end by scancel to its run as well.
  const auto requeued_after = [&](const std::string& signal) {
    const std::string job = "PATH=" + (directory / "").string() +
                            ":$PATH SLURM_ARRAY_JOB_ID=7 SLURM_ARRAY_TASK_ID=2 timeout -s " + signal + " 0.7 bash " +
                            (output / "array.sbatch").string() + " >/dev/null 2>&1";
    std::system(job.c_str());
    return fs::exists(directory / "requeued");
  };
  // The time of timeout(1) may be over before the run began on a busy machine: then the job is not queued again.
  bool stopped = false, queued = false;
  for (int i = 0; i < 5 && !stopped; ++i) {
    CHECK_FALSE(requeued_after("TERM"));
    stopped = contains(geodrop::read_file(output / "case_002" / "summary.json"), "\"stopped\"");
  }
  CHECK(stopped);
  for (int i = 0; i < 5 && !queued; ++i) queued = requeued_after("USR1 --foreground");
  CHECK(geodrop::read_file(directory / "requeued") == "requeue 7_2\n");
  CHECK(contains(geodrop::read_file(output / "case_002" / "summary.json"), "\"stopped\""));
  CHECK_FALSE(fs::exists(output / "case_001"));
  std::vector<std::string> last = words;
  last.insert(last.end(), {"--case", "2"});
  CHECK(run_program(last).code == 0);
  CHECK(run_program(last).out.find("is done") != std::string::npos);
  REQUIRE(run_program(prepare).code == 0);
  CHECK(done(output) == 1);
}

TEST_CASE("Mistakes of a sweep are told before the first run") {
  const geodrop::TemporaryDirectory directory;
  const fs::path output = fs::path(directory / "none");
  const auto told = [&](const std::vector<std::string>& more) {
    const Outcome outcome = run_program(sweep(output, more));
    CHECK(outcome.code == 2);
    CHECK_FALSE(fs::exists(output / "case_001"));
    return outcome.err;
  };
  CHECK(contains(told({"--vary", stiffness + "8e6:9e6"}), "KEY=FROM:TO:COUNT"));
  CHECK(contains(told({"--vary", stiffness + "8e6:-9e6:3"}), "youngs_modulus"));
  CHECK(contains(told({"--vary", "materials.soil.stifness=1.0:2.0:2"}), "stifness"));
  CHECK(contains(told({"--vary", stiffness + "8e6:9e6:2", "--case", "3"}), "1 to 2"));
  CHECK(contains(told({"--vary", stiffness + "8e6:9e6:2", "--sample", "3"}), "KEY=LOW:HIGH"));
  CHECK(contains(told({"--vary", stiffness + "8e6:9e6:2", "--vary", stiffness + "7e6,6e6"}), "youngs_modulus\" twice"));
  CHECK(contains(told({"--vary", stiffness + "8e6:9e6:2", "--set", stiffness + "7e6"}), "which --set sets, too"));
  fs::create_directories(output);
  std::ofstream(output / "letter.txt") << "dear";
  CHECK(contains(told({"--vary", stiffness + "8e6:9e6:2"}), "other files"));
}
