// Outlines of bags at the ends of runs, in one picture.
#include "plot/outlines_chart.hpp"
#include "support/near.hpp"
#include "support/program.hpp"
#include "support/scene_files.hpp"
#include "support/text.hpp"

#include <geodrop/base/error.hpp>

#include <doctest/doctest.h>

#include <filesystem>
#include <numbers>

using namespace geodrop;
using namespace geodrop::test;

namespace {

/// Of a closed line.
double area_of(const ChartSeries& line) {
  double area = 0;
  for (std::size_t i = 1; i < line.x.size(); ++i) area += (line.x[i - 1] * line.y[i] - line.x[i] * line.y[i - 1]) / 2;
  return area;
}

std::string message_of(const std::filesystem::path& directory) {
  try {
    outlines_chart({directory});
  } catch (const SceneError& error) {
    return error.what();
  }
  return "nothing was refused";
}

}  // namespace

TEST_CASE("Outlines of the runs of a sweep are those of the scene, whole and in their places; skins are not drawn") {
  const TemporaryDirectory directory;
  const std::string scene = directory / "bag.toml", sweep = directory / "sweep";
  REQUIRE(run_program({"new", directory / "bag"}).code == 0);
  REQUIRE(run_program({"sweep", scene, "--vary", "bodies.bag.shape.centre.0=-1.0,1.0", "--set", "grid.spacing=0.25",
                       "--set", "time.end=0.002", "--output", sweep})
              .code == 0);
  const Chart chart = outlines_chart({sweep});
  CHECK(contains(chart.notes.at(0), "2 runs"));
  REQUIRE(chart.panels.size() == 1);
  CHECK(chart.panels[0].aspect == Aspect::equal);
  REQUIRE(chart.panels[0].series.size() == 3);
  const ChartSeries& middles = chart.panels[0].series[2];
  for (int run = 0; run < 2; ++run) {
    const ChartSeries& line = chart.panels[0].series[run];
    CHECK(line.x.front() == line.x.back());
    CHECK(line.y.front() == line.y.back());
    CHECK(area_of(line) == near(std::numbers::pi * 1.0 * 0.5, 0.02));  // semi-axes of the ellipse
    CHECK(middles.x[run] == within(run == 0 ? -1.0 : 1.0, 0.02));
    CHECK(middles.y[run] == within(4.5, 0.02));
  }
  const Outcome drawn = run_program({"plot", sweep, "--outlines"});
  CHECK(drawn.code == 0);
  CHECK(std::filesystem::exists(sweep + "/outlines.svg"));
  CHECK(contains(run_program({"plot", sweep, "--outlines", "--columns", "time_s"}).err, "excludes"));
}

TEST_CASE("Runs without a geotextile, and sweeps of which none is done, have no outlines") {
  const TemporaryDirectory directory;
  const std::string run = directory / "bar", sweep = directory / "sweep";
  REQUIRE(
      run_program({"run", source_path("cases/elastic_bar.toml"), "--set", "time.end=0.001", "--output", run}).code ==
      0);
  CHECK(contains(message_of(run), "no membrane with a stiffness"));
  std::filesystem::create_directories(sweep);
  std::ofstream(sweep + "/manifest.csv") << "run,a.key,state,exit_code,height_m\ncase_001,1,failed,1,2\n";
  CHECK(contains(message_of(sweep), "no run that is done"));
}
