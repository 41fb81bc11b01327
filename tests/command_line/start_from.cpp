// Runs that start from the end of another, through the program.
#include <doctest/doctest.h>

#include "support/near.hpp"
#include "support/program.hpp"
#include "support/text.hpp"

using namespace geodrop::test;
namespace fs = std::filesystem;

namespace {

const std::string tube = geodrop::source_path("cases/verification/pressurised_tube.toml");

Outcome run(const fs::path& output, const std::vector<std::string>& settings) {
  std::vector<std::string> words{"run",       tube, "--output", output.string(),
                                 "--threads", "1",  "--set",    "grid.spacing=0.3"};
  for (const std::string& setting : settings) words.insert(words.end(), {"--set", setting});
  return run_program(words);
}

/// A column of the history of a run.
std::vector<double> column(const fs::path& output, const std::string& name) {
  const auto table = csv(output / "history.csv");
  const auto at = static_cast<std::size_t>(std::find(table[0].begin(), table[0].end(), name) - table[0].begin());
  REQUIRE(at < table[0].size());
  std::vector<double> values;
  for (std::size_t i = 1; i < table.size(); ++i) values.push_back(std::stod(table[i][at]));
  return values;
}

}  // namespace

TEST_CASE("A tube that one run has pumped up keeps its tension in the next, on other cells too") {
  const geodrop::TemporaryDirectory directory;
  const fs::path first = fs::path(directory / "first");
  REQUIRE(run(first, {}).code == 0);
  const double tension = column(first, "skin.tension_mean_N_m").back();
  CHECK(tension == near(4880.88, 0.003));  // J (sqrt(1.1) - 1)
  const std::string from = "start_from=\"" + first.string() + '"';
  for (const char* spacing : {"grid.spacing=0.3", "grid.spacing=0.2"}) {
    CAPTURE(spacing);
    const fs::path next = fs::path(directory / "next");
    const Outcome outcome = run(next, {from, spacing, "pumps=", "time.end=0.3"});
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(column(next, "time_s").front() == 0);
    CHECK(column(next, "skin.tension_mean_N_m").back() == near(tension, 2e-3));
    CHECK(column(next, "skin.area_m2").front() == near(column(first, "skin.area_m2").back(), 1e-9));
    CHECK(column(next, "total.mass_kg").back() == near(column(first, "total.mass_kg").back(), 1e-12));
  }
}

TEST_CASE(
    "A tube that falls in one run falls on in the next, with its geotextile, and a run that was stopped goes on") {
  const geodrop::TemporaryDirectory directory;
  const fs::path first = fs::path(directory / "first"), next = fs::path(directory / "next");
  const std::vector<std::string> falls{"gravity=[0.0, -1.0]", "pumps=", "solver.damping_rate=0.0", "time.end=0.2"};
  REQUIRE(run(first, falls).code == 0);
  const double reached = column(first, "fluid.velocity_y_m_s").back();
  // The polygon of the geotextile, which carries the weight of the water, is 0.06 % smaller than the disc of water.
  CHECK(reached == near(-column(first, "time_s").back(), 1e-3));
  std::vector<std::string> more = falls;
  more.push_back("start_from=\"" + first.string() + '"');
  REQUIRE(run(next, more).code == 0);
  CHECK(column(next, "fluid.velocity_y_m_s").front() == near(reached, 1e-12));
  CHECK(column(next, "fluid.velocity_y_m_s").back() == near(reached - column(next, "time_s").back(), 1e-3));

  const fs::path again = fs::path(directory / "again");
  std::vector<std::string> words{"run",       tube, "--output", again.string(),
                                 "--threads", "1",  "--set",    "grid.spacing=0.3"};
  for (const std::string& setting : more) words.insert(words.end(), {"--set", setting});
  std::vector<std::string> part = words;
  part.insert(part.end(), {"--until", "0.1"});
  REQUIRE(run_program(part).code == 75);
  words.push_back("--resume");
  REQUIRE(run_program(words).code == 0);
  CHECK(column(again, "fluid.velocity_y_m_s") == column(next, "fluid.velocity_y_m_s"));
}

TEST_CASE("Water in pores is there once") {
  const geodrop::TemporaryDirectory directory;
  const std::string bag = geodrop::source_path("cases/verification/saturated_bag_rests.toml");
  const std::string first = directory / "first", next = directory / "next";
  std::vector<std::string> words{"run", bag, "--threads", "1", "--set", "grid.spacing=0.2", "--set", "time.end=0.01"};
  words.insert(words.end(), {"--output", first});
  REQUIRE(run_program(words).code == 0);
  words.back() = next;
  words.insert(words.end(), {"--set", "start_from=\"" + first + '"'});
  REQUIRE(run_program(words).code == 0);
  CHECK(column(next, "total.mass_kg").front() == near(column(first, "total.mass_kg").back(), 1e-12));
}

TEST_CASE("What cannot be started from is refused in words") {
  const geodrop::TemporaryDirectory directory;
  const fs::path first = fs::path(directory / "first"), next = fs::path(directory / "next");
  const std::string from = "start_from=\"" + first.string() + '"';
  const Outcome none = run(next, {from});
  CHECK(none.code == 2);
  CHECK(none.err.find("start_from: found \"" + first.string() + "\", which is no run directory") != std::string::npos);
  REQUIRE(run(first, {"time.end=0.01"}).code == 0);
  const Outcome other =
      run(next, {from, "membranes.skin.closed=false", "membranes.skin.points=[[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]]",
                 "bodies.fluid.pressure=cell", "pumps="});
  CHECK(other.code == 2);
  CHECK(other.err.find("closed in one of the scenes only") != std::string::npos);
  CHECK_FALSE(fs::exists(next));
}
