// What the program says and returns: usage errors, warnings, broken runs, expectations.
#include <doctest/doctest.h>

#include <filesystem>
#include <thread>

#include "support/program.hpp"
#include "support/text.hpp"

using namespace geodrop::test;

namespace {

const std::string scene = geodrop::source_path("cases/hydrostatic_column.toml");

void check_usage(const std::vector<std::string>& arguments, const std::string& says) {
  const Outcome outcome = run_program(arguments);
  CAPTURE(outcome.err);
  CHECK(outcome.code == 2);
  CHECK(outcome.out.empty());
  CHECK(contains(outcome.err, says));
  CHECK(outcome.err.size() < 300);  // a message, not a dump
}

}  // namespace

TEST_CASE("Mistakes of usage end with 2 and one message on stderr") {
  check_usage({}, "a command is missing: run, check");
  check_usage({"fly"}, "fly");
  check_usage({"run"}, "scene is required");
  check_usage({"run", scene, "--speed"}, "--speed");
  check_usage({"run", scene, "--threads"}, "--threads");
  check_usage({"run", scene, "--threads", "0"}, "--threads: found 0; allowed: a whole number from 1 to 1024");
  check_usage({"run", scene, "--threads", "-1"}, "found -1; allowed: a whole number from 1 to 1024");
  check_usage({"run", scene, "--threads", "two"}, "two");
  check_usage({"run", scene, "--threads", "1.5"}, "found 1.5; allowed: a whole number from 1 to 1024");
  check_usage({"run", scene, "--threads", "100000"}, "found 100000; allowed: a whole number from 1 to 1024");
  check_usage({"bench", "--threads", "100000"}, "found 100000; allowed: a whole number from 1 to 1024");
  check_usage({"bench", "--particles", "10"}, "found 10; allowed: a number from 1e3 to 1e8");
  check_usage({"bench", "--steps", "3", "--growth"}, "--growth");
  check_usage({"bench", "--steps", "0"}, "--steps: found 0; allowed: a whole number > 0");
  check_usage({"bench", "--update"}, "--instructions");
  check_usage({"run", scene, "--until", "0"}, "--until: found 0; allowed: a time > 0 [s]");
}

TEST_CASE("A scene that is not there, or a key that does not exist, ends with 2 and leaves no run directory") {
  const geodrop::TemporaryDirectory directory;
  const std::string output = directory / "run";
  check_usage({"run", "no_such_scene.toml", "--output", output}, "no_such_scene.toml");
  check_usage({"check", "no_such_scene.toml"}, "no_such_scene.toml");
  check_usage({"run", scene, "--output", output, "--set", "grid.spacin=0.5"}, "the nearest is \"spacing\"");
  check_usage({"run", scene, "--output", output, "--set", "grid.spacing=-1"}, "grid.spacing");
  check_usage({"run", scene, "--output", output, "--resume"}, "checkpoint.bin: --resume: found no such file");
  CHECK_FALSE(std::filesystem::exists(output));
}

TEST_CASE("A benchmark or a main case that is not there ends with 2") {
  const geodrop::TemporaryDirectory directory;
  const std::string output = directory / "bench";
  const Outcome unknown = run_program({"bench", "--only", "honey", "--output", output});
  CHECK(unknown.code == 2);
  CHECK(contains(unknown.err, "no benchmark is called 'honey'; allowed: a part of a name, e.g. "));
  check_usage({"bench", "--only", "main_case", "--scene", "no_such_scene.toml", "--output", output}, "no_such_scene");
}

TEST_CASE("A directory that holds other things than a run is not touched") {
  const geodrop::TemporaryDirectory directory;
  std::ofstream(directory / "letter.txt") << "dear reader";
  const Outcome outcome = run_program({"run", scene, "--output", directory / "", "--set", "time.end=0.1"});
  CHECK(outcome.code == 2);
  CHECK(contains(outcome.err, ": --output: found a directory with other files in it"));
  CHECK(geodrop::read_file(directory / "letter.txt") == "dear reader");
  CHECK_FALSE(std::filesystem::exists(directory / "history.csv"));
}

TEST_CASE("More threads than cores: a warning on stderr, and the run is done") {
  const int many = static_cast<int>(std::thread::hardware_concurrency()) + 1;
  const SceneRun run(scene, {"time.end=0.05"}, {"--threads", std::to_string(many)});
  CHECK(run.outcome().code == 0);
  CHECK(contains(run.outcome().err, "warning: " + std::to_string(many) + " threads"));
  const SceneRun one(scene, {"time.end=0.05"}, {"--threads", "1"});
  CHECK(one.outcome().err.empty());
}

TEST_CASE("check, stages, info and --version answer without a run directory") {
  CHECK(run_program({"check", scene}).code == 0);
  CHECK(contains(run_program({"stages", scene}).out, "particles_to_grid"));
  CHECK(contains(run_program({"info", scene}).out, "time_step_s"));
  CHECK(run_program({"info"}).code == 0);
  CHECK(contains(run_program({"--version"}).out, "geodrop "));
  CHECK(contains(run_program({"--help"}).out, "run"));
  CHECK(run_program({"check", geodrop::source_path("tests/bad_scenes/units.toml")}).code == 2);
}

TEST_CASE("A broken run ends with 1, says why, and keeps its last frame") {
  // Water that hits the walls with eight times its speed of sound is pressed to nothing.
  const SceneRun run(scene, {"time.end=0.5", "bodies.water.initial_velocity={type='uniform', value=[100.0, 500.0]}"});
  CHECK(run.outcome().code == 1);
  CHECK(run.text("status") == "failed");
  CHECK(contains(run.text("message"), "has no volume left"));
  CHECK(contains(run.outcome().out + run.outcome().err, run.text("message")));
  CHECK(std::filesystem::exists(run.file("history.csv")));
  const std::string frames = geodrop::read_file(run.file("particles.pvd"));
  const std::string last = run.summary().substr(run.summary().find("\"time_s\": ") + 10, 8);
  CHECK(contains(frames, last));  // a frame at the time of the break
}

#ifndef __SANITIZE_ADDRESS__  // which itself takes terabytes of addresses
TEST_CASE("Too little memory: 1 and one message") {
  const geodrop::TemporaryDirectory directory;
  // 1.3e7 particles of some 130 bytes in at most 0.6 GB.
  const std::string command = "ulimit -v 600000; exec '" + geodrop::test::program_path + "' run '" + scene +
                              "' --threads 1 --set grid.spacing=0.002 --output '" + (directory / "run").string() +
                              "' 2>&1 >/dev/null";
  std::string said;
  FILE* program = popen(command.c_str(), "r");
  for (int letter = fgetc(program); letter != EOF; letter = fgetc(program)) said += static_cast<char>(letter);
  const int status = pclose(program);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 1);
  CHECK(said.starts_with("geodrop: not enough memory: the scene takes about "));
  CHECK(contains(said, " GB for "));
}
#endif

TEST_CASE("An expectation that is not met fails the run only with --verify") {
  const std::vector<std::string> settings{"time.end=0.2", "results.velocity_rms_m_s.from=0", "expect.1.tolerance=0",
                                          "results.pressure_error_rms_ratio.from=0"};
  SceneRun run(scene, settings);
  CHECK(run.outcome().code == 0);
  CHECK(contains(run.summary(), "\"met\": false"));
  CHECK(run.again({"--verify"}).code == 1);
  std::vector<std::string> generous = settings;
  generous[2] = "expect.1.tolerance=1";
  const SceneRun met(scene, generous, {"--verify"});
  CHECK(met.outcome().code == 0);
  CHECK_FALSE(contains(met.summary(), "\"met\": false"));
}
