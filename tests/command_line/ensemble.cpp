// `geodrop ensemble` through the program: the runs, their tables, going on, and mistakes.
#include <doctest/doctest.h>

#include <algorithm>

#include "support/near.hpp"
#include "support/program.hpp"
#include "support/text.hpp"

using namespace geodrop::test;
namespace fs = std::filesystem;

namespace {

const std::string scene = geodrop::source_path("cases/gravity_column.toml");
const std::string stiffness = "materials.soil.youngs_modulus=";

std::vector<std::string> ensemble(const fs::path& output, const std::vector<std::string>& more) {
  std::vector<std::string> words{"ensemble", scene, "--output", output.string(), "--jobs", "2"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

}  // namespace

TEST_CASE("An ensemble of elastic columns: mean settlement goes as 1/E, runs that are done are not made again") {
  const geodrop::TemporaryDirectory directory;
  const fs::path output = fs::path(directory / "columns");
  const std::vector<std::string> more{"--samples", "5", "--vary", stiffness + "6e6:14e6"};
  REQUIRE(run_program(ensemble(output, more)).code == 0);
  auto table = csv(output / "manifest.csv");
  REQUIRE(table.size() == 6);
  REQUIRE(table[0][5] == "displacement_mean_m");
  for (std::size_t i = 1; i < 6; ++i) {
    CHECK(table[i][2] == "done");
    CHECK(table[i][3] == "0");
    // 0.66 mm at E = 10 MPa, over some swings: the last one counts in part.
    CHECK(std::stod(table[i][1]) * std::stod(table[i][5]) == near(-6600, 0.05));
  }
  CHECK(csv(output / "correlations.csv")[2][1] == "1");
  const auto bands = csv(output / "bands.csv");
  CHECK(std::stod(bands[2][1]) < std::stod(bands[2][2]));
  CHECK(std::stod(bands[2][2]) < std::stod(bands[2][3]));

  const std::string manifest = geodrop::read_file(output / "manifest.csv");
  const auto made = fs::last_write_time(output / "run_002" / "summary.json");
  fs::remove_all(output / "run_004");
  REQUIRE(run_program(ensemble(output, more)).code == 0);
  CHECK(geodrop::read_file(output / "manifest.csv") == manifest);
  CHECK(fs::last_write_time(output / "run_002" / "summary.json") == made);
  CHECK(fs::exists(output / "run_004" / "summary.json"));

  const Outcome other = run_program(ensemble(output, {"--samples", "6", "--vary", stiffness + "6e6:14e6"}));
  CHECK(other.code == 2);
  CHECK(other.err.find("an ensemble of another design") != std::string::npos);
}

TEST_CASE("Keys joined by + have the same value in every run") {
  const geodrop::TemporaryDirectory directory;
  const fs::path output = fs::path(directory / "columns");
  const std::string both = "output.history_interval+output.frame_interval=0.1:0.2";
  REQUIRE(run_program(ensemble(output, {"--samples", "2", "--vary", both})).code == 0);
  const auto table = csv(output / "manifest.csv");
  REQUIRE(table.size() == 3);
  CHECK(table[0][1] == "output.history_interval+output.frame_interval");
  for (std::size_t i = 1; i < 3; ++i) {
    const std::string scene = geodrop::read_file(output / table[i][0] / "scene.toml");
    CHECK(scene.find("frame_interval = " + table[i][1]) != std::string::npos);
    CHECK(scene.find("history_interval = " + table[i][1]) != std::string::npos);
  }
}

TEST_CASE("Mistakes of an ensemble are told before the first run") {
  const geodrop::TemporaryDirectory directory;
  const fs::path output = fs::path(directory / "none");
  const auto told = [&](const std::string& vary) {
    const Outcome outcome = run_program(ensemble(output, {"--samples", "2", "--vary", vary}));
    CHECK(outcome.code == 2);
    CHECK_FALSE(fs::exists(output));
    return outcome.err;
  };
  CHECK(told(stiffness + "8e6").find("KEY=LOW:HIGH") != std::string::npos);
  CHECK(told(stiffness + "-1.0:8e6").find("youngs_modulus") != std::string::npos);
  CHECK(told("materials.soil.stiffness=1.0:2.0").find("stiffness") != std::string::npos);
}
