// What a stopped run tells its user to type must work as it stands.
#include <doctest/doctest.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include "support/program.hpp"

using namespace geodrop::test;

namespace {

/// The rest of the line after "go on with: "; empty if there is none.
std::string printed_command(const std::string& output) {
  const std::string before = "\ngo on with: ";
  const std::size_t at = output.find(before);
  if (at == std::string::npos) return {};
  const std::size_t start = at + before.size();
  return output.substr(start, output.find('\n', start) - start);
}

int exit_code_of(const std::string& command) {
  return WEXITSTATUS(std::system((command + " >/dev/null 2>&1").c_str()));
}

}  // namespace

TEST_CASE("Ctrl-C, then the printed command, with --set and spaces in paths: the run is done") {
  const geodrop::TemporaryDirectory directory;
  const std::string scene = directory / "my scene.toml", output = directory / "my run";
  std::filesystem::copy_file(geodrop::source_path("cases/hydrostatic_column.toml"), scene);
  const Program program({"run", scene, "--output", output, "--until", "9", "--set", "time.end=40", "--set",
                         "gravity=[0.0, -9.0]", "--set", "output.frame_interval=0.05"});
  for (int k = 0; k < 1000 && !std::filesystem::exists(output + "/particles_000001.vtu"); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  program.signal(SIGINT);
  const Outcome stopped = program.wait();
  REQUIRE(stopped.code == 75);
  const std::string command = printed_command(stopped.out);
  CAPTURE(command);
  CHECK(command.ends_with(" --resume"));
  CHECK(command.find("--until") == std::string::npos);
  CHECK(exit_code_of(command) == 0);
  CHECK(geodrop::read_file(output + "/summary.json").find("\"status\": \"done\"") != std::string::npos);
}

TEST_CASE("The command begins with the name that the wrapper script was called by") {
  setenv("GEODROP_WRAPPER", "./geodrop", 1);
  const geodrop::TemporaryDirectory directory;
  const std::string output = directory / "run";
  const Program program({"run", geodrop::source_path("cases/hydrostatic_column.toml"), "--output", output, "--set",
                         "output.frame_interval=0.05", "--set", "time.end=40"});
  unsetenv("GEODROP_WRAPPER");
  for (int k = 0; k < 1000 && !std::filesystem::exists(output + "/particles_000001.vtu"); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  program.signal(SIGINT);
  CHECK(printed_command(program.wait().out).starts_with("./geodrop run "));
}
