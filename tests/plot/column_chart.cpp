// Columns of several histories, and results of a sweep, as charts.
#include "plot/column_chart.hpp"
#include "plot/sweep_chart.hpp"
#include "support/scene_files.hpp"
#include "support/text.hpp"

#include <geodrop/base/error.hpp>

#include <doctest/doctest.h>

using namespace geodrop;
using geodrop::test::contains;

namespace {

using Values = std::vector<double>;

std::filesystem::path write_run(const TemporaryDirectory& directory, const std::string& name, const std::string& text) {
  const std::filesystem::path run = std::filesystem::path(directory / name);
  std::filesystem::create_directories(run);
  std::ofstream(run / "history.csv") << text;
  return run;
}

std::string message_of(const auto& call) {
  try {
    call();
  } catch (const SceneError& error) {
    return error.what();
  }
  return "nothing was refused";
}

const std::string manifest =
    "run,a.key,b.key,c.key,state,exit_code,height_m,force_N\n"
    "case_001,2.0,low,\"[1, 2]\",done,0,20,1\n"
    "case_002,1.0,low,\"[1, 2]\",done,0,10,2\n"
    "case_003,1.0,high,\"[1, 2]\",done,0,11,3\n"
    "case_004,3.0,high,\"[1, 2]\",failed,1,99,4\n"
    "case_005,4.0,high,\"[1, 2]\",waiting,,nan,nan\n";

const std::string stiff = "run,E,state,exit_code,height_m\ncase_001,2e6,done,0,1\ncase_002,4e7,done,0,2\n";

}  // namespace

TEST_CASE("Columns of two runs: a panel for each unit, a line for each run; a reference beside") {
  const TemporaryDirectory directory;
  const auto one = write_run(directory, "one", "time_s,bag.velocity_y_m_s,bag.height_m\n0,0,3\n1,-2,2\n");
  const auto two = write_run(directory, "two", "time_s,bag.velocity_y_m_s,bag.height_m\n0,0,5\n1,-4,4\n");
  std::ofstream(directory / "measured.csv") << "time_s,speed_m_s,mass_kg\n0.5,-1.5,7\n";
  const Chart chart =
      column_chart({{one, two / ""}, {"bag.velocity_y_m_s", "bag.height_m"}, "time_s", {directory / "measured.csv"}});
  REQUIRE(chart.panels.size() == 2);
  CHECK(chart.panels[0].x_label == "time [s]");
  CHECK(chart.panels[0].y_label == "value [m/s]");
  REQUIRE(chart.panels[0].series.size() == 3);
  CHECK(chart.panels[0].series[1].label == "two: bag velocity y");
  CHECK(chart.panels[0].series[1].y == Values{0, -4});
  CHECK(chart.panels[0].series[2].label == "measured: speed");
  CHECK(chart.panels[0].series[2].style == SeriesStyle::dashed);
  CHECK(chart.panels[1].y_label == "bag height [m]");  // all of one quantity: the axis names it
  CHECK(chart.panels[1].series[0].label == "one");
  const Chart phase = column_chart({{one}, {"bag.height_m"}, "bag.velocity_y_m_s", {}});
  CHECK(phase.panels[0].x_label == "bag velocity y [m/s]");
  CHECK(phase.panels[0].series[0].x == Values{0, -2});
  CHECK(contains(message_of([&] {
                   column_chart({{one}, {"bag.hight_m"}, "time_s", {}});
                 }),
                 "the nearest is \"bag.height_m\""));
  const auto advice = [&](const std::string& column) {
    return message_of([&] { column_chart({{one}, {column}, "time_s", {}}); });
  };
  CHECK(contains(advice("bag"), "a column of it, as bag.velocity_y_m_s, bag.height_m"));
  CHECK(contains(advice("xyz"), "its first line names them"));
}

TEST_CASE("A result over one key, and over two with a curve for each value; only of runs that are done") {
  const TemporaryDirectory directory;
  std::ofstream(directory / "manifest.csv") << manifest;
  const Chart two = sweep_chart({directory / "", {"a.key", "b.key"}, "height_m"});
  const auto& curves = two.panels.at(0).series;
  REQUIRE(curves.size() == 2);
  CHECK(curves[0].label == "b.key = low");
  CHECK(curves[0].x == Values{1, 2});  // in the order of the key
  CHECK(curves[0].y == Values{10, 20});
  CHECK(curves[1].y == Values{11});
  CHECK(curves[0].style == SeriesStyle::marked_line);
  CHECK(two.panels[0].y_label == "height [m]");
  const Chart one = sweep_chart({directory / "", {"a.key"}, "force_N"});
  REQUIRE(one.panels.at(0).series.size() == 1);
  CHECK(one.panels[0].series[0].style == SeriesStyle::points);  // b.key varies, too
  CHECK(contains(message_of([&] { sweep_chart({directory / "", {"a.kei"}, "height_m"}); }), "a.key"));
  CHECK(contains(message_of([&] { sweep_chart({directory / "", {"a.key"}, "heigt_m"}); }), "height_m"));
  CHECK(contains(message_of([&] { sweep_chart({directory / "", {"b.key"}, "height_m"}); }), "a key with numbers"));
  CHECK(contains(message_of([&] {
                   sweep_chart({directory / "none", {"b.key"}, "height_m"});
                 }),
                 "the manifest of a sweep"));
}

TEST_CASE("Axes and curves over keys of a scene have the keys' units") {
  const TemporaryDirectory directory;
  std::ofstream(directory / "manifest.csv")
      << "run,materials.sand.youngs_modulus,bodies.bag.shape.tilt_deg,state,exit_code,fall_velocity_max_m_s\n"
         "case_001,2e6,5,done,0,1\ncase_002,4e7,5,done,0,2\ncase_003,4e7,7,done,0,2\n";
  const Chart chart = sweep_chart(
      {directory / "", {"materials.sand.youngs_modulus", "bodies.bag.shape.tilt_deg"}, "fall_velocity_max_m_s"});
  CHECK(chart.panels.at(0).x_label == "materials.sand.youngs_modulus [MPa]");
  CHECK(chart.panels[0].series.at(0).x == Values{2, 40});
  CHECK(chart.panels[0].series[0].label == "bodies.bag.shape.tilt_deg = 5 degree");
  CHECK(chart.panels[0].y_label == "fall velocity max [m/s]");
  CHECK(chart.title == directory / "");  // no run has told the title of its scene
}

TEST_CASE("Large numbers along x stand in millions") {
  const TemporaryDirectory directory;
  std::ofstream(directory / "manifest.csv") << stiff;
  const Chart large = sweep_chart({directory / "", {"E"}, "height_m"});
  CHECK(large.panels.at(0).x_label == "E [1e6]");
  CHECK(large.panels[0].series.at(0).x == Values{2, 40});
}
