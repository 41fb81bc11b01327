// Files that are none, too large or of another make: told apart at once, without a wait.
#include <doctest/doctest.h>

#include <sys/stat.h>

#include "support/program.hpp"
#include "support/text.hpp"

using namespace geodrop::test;

namespace {

void check_refused(const std::vector<std::string>& arguments, const std::string& says) {
  const Outcome outcome = run_program(arguments);
  CAPTURE(outcome.err);
  CHECK(outcome.code == 2);
  CHECK(contains(outcome.err, says));
}

}  // namespace

TEST_CASE("A scene that is a pipe, a device, a directory or too large is refused at once") {
  const geodrop::TemporaryDirectory directory;
  const std::string pipe = directory / "pipe.toml", large = directory / "large.toml";
  REQUIRE(mkfifo(pipe.c_str(), S_IRUSR | S_IWUSR) == 0);
  check_refused({"check", pipe}, "pipe.toml: found a pipe, not a regular file; allowed: a scene in TOML");
  check_refused({"check", "/dev/zero"}, "/dev/zero: found a device, not a regular file");
  check_refused({"run", directory / ""}, "found a directory, not a regular file");
  check_refused({"info", directory / "none.toml"}, "none.toml: found no such file");
  { std::ofstream(large) << "title = 1\n"; }
  std::filesystem::resize_file(large, (std::uintmax_t{64} << 20) + 1);  // zeros that take no room on the disk
  check_refused({"check", large}, "large.toml: found a file of more than 67 MB");
}

TEST_CASE("A history that is a pipe is refused at once") {
  const geodrop::TemporaryDirectory directory;
  const std::string pipe = directory / "history.csv";
  REQUIRE(mkfifo(pipe.c_str(), S_IRUSR | S_IWUSR) == 0);
  check_refused({"plot", directory / ""}, "history.csv: found a pipe, not a regular file");
}

TEST_CASE("A column of a foreign history names no file elsewhere") {
  const geodrop::TemporaryDirectory directory;
  std::filesystem::create_directories(directory / "run/section_");
  std::ofstream(directory / "run/history.csv")
      << "time_s,port.rotation_deg,port.displacement_x_m,/../../out.soil_force_N_m,/../../out.membrane_force_N_m\n"
         "0,0,0,1,1\n1,5,1,1,1\n";
  check_refused({"plot", directory / "run"}, "found a probe named \"/../../out\"");
  CHECK_FALSE(std::filesystem::exists(directory / "out.svg"));
}

TEST_CASE("A message shows the beginning of what was found") {
  const geodrop::TemporaryDirectory directory;
  const std::string scene = directory / "long.toml";
  { std::ofstream(scene) << "title = \"long\"\ndimension = \"" << std::string(100000, 'x') << "\"\n"; }
  const Outcome outcome = run_program({"check", scene});
  CHECK(outcome.code == 2);
  CHECK(contains(outcome.err, std::string(199, 'x').append("... (1000")));
  CHECK(outcome.err.size() < 5000);
}
