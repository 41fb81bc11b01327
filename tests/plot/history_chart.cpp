// The chart of a history: which lines are drawn, in which units, beside which references.
#include "plot/history_chart.hpp"
#include "support/near.hpp"
#include "support/text.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using namespace geodrop;
using geodrop::test::contains;
using geodrop::test::near;

namespace {

using Values = std::vector<double>;

constexpr double always = std::numeric_limits<double>::infinity();

const CsvTable history{{"time_s", "bag.position_y_m", "bed.position_y_m", "cloth.tension_gauge_N_m", "energy.total_J"},
                       {{0, 1, 2}, {9, 5, 1}, {-2, -2.01, -2}, {0, 20e3, 10e3}, {5e6, 6e6, 7e6}}};

/// A result that is the largest tension after a landing, in kN/m by its scale, and what is expected of it.
Scene scene_with_expectation() {
  Scene scene;
  MembraneSpec membrane;
  membrane.name = "cloth";
  membrane.strength = 120e3;
  scene.membranes.push_back(membrane);
  ResultSpec result;
  result.name = "speed_max_m_s";
  result.column = "bag.velocity_y_m_s";
  result.reduce = Reduction::min;
  result.scale = -2;
  result.after = "landing_s";
  result.to = 6;
  scene.results.push_back(result);
  result.name = "landing_s";
  result.reduce = Reduction::first_time_below;
  scene.results.push_back(result);
  for (const char* name : {"speed_max_m_s", "landing_s"}) {
    ExpectSpec expect;
    expect.result = name;
    expect.expected = 3;
    scene.expect.push_back(expect);
  }
  return scene;
}

}  // namespace

TEST_CASE("A history in units of fitting size; a line that hardly moves is named and not drawn") {
  const Chart chart = history_chart(history, "Bag", {});
  CHECK(chart.title == "Bag");
  REQUIRE(chart.panels.size() == 3);
  REQUIRE(chart.panels[0].series.size() == 1);
  CHECK(chart.panels[0].y_label == "position [m]");
  CHECK(chart.panels[0].series[0].label == "bag.position_y");
  CHECK(chart.panels[1].y_label == "tension [kN/m]");
  CHECK(chart.panels[1].series[0].y == Values{0, 20, 10});
  CHECK(chart.panels[2].y_label == "change of energy [MJ]");
  CHECK(chart.panels[2].series[0].y == Values{0, 1, 2});
  REQUIRE(chart.notes.size() == 1);
  CHECK(contains(chart.notes[0], "position_y of bed"));
}

TEST_CASE("Of lines that lie on one another the first is drawn, the others are named") {
  const Chart chart = history_chart({{"time_s", "bag.velocity_y_m_s", "pores.velocity_y_m_s", "other.velocity_y_m_s"},
                                     {{0, 1}, {0, 3}, {0, 3.001}, {0, 2.9}}},
                                    "Twins", {});
  REQUIRE(chart.panels.at(0).series.size() == 2);
  CHECK(chart.panels[0].series[1].label == "other.velocity_y");
  REQUIRE(chart.notes.size() == 1);
  CHECK(chart.notes[0] == "not drawn, as others cover them: velocity_y of pores");
}

TEST_CASE("A history in which nothing moves is drawn all the same") {
  const Chart chart = history_chart({{"time_s", "bag.position_y_m"}, {{0, 1}, {3, 3}}}, "Still", {});
  REQUIRE(chart.panels.size() == 1);
  CHECK(chart.panels[0].series.size() == 1);
  CHECK(chart.notes.empty());
}

TEST_CASE("A reference is drawn over its time beside its own column, or named where it would press the line flat") {
  const std::string tension = "cloth.tension_gauge_N_m";
  const Chart chart = history_chart(history, "Bag",
                                    {{tension, "near", 50e3, 0, always},
                                     {tension, "far", 70e3, 0, always},
                                     {tension, "short", 15e3, 0.5, 1},
                                     {tension, "later", 15e3, 3, always},
                                     {"energy.total_J", "energy", 6e6, 0, always},
                                     {"bed.position_y_m", "of what is not drawn", -2, 0, always}});
  const auto& series = chart.panels.at(1).series;
  REQUIRE(series.size() == 3);
  CHECK(series[1].label == "near");
  CHECK(series[1].x == Values{0, 2});
  CHECK(series[1].y == Values{50, 50});
  CHECK(series[1].style == SeriesStyle::dashed);
  CHECK(series[2].label == "short");
  CHECK(series[2].x == Values{0.5, 1});
  CHECK(series[2].style == SeriesStyle::marked_line);
  CHECK(chart.panels[2].series.at(1).y == Values{1, 1});  // of the change
  CHECK(chart.panels[0].series.size() == 1);
  REQUIRE(chart.notes.size() == 2);
  CHECK(chart.notes[1] == "beyond the scale: far");
}

TEST_CASE("References of a scene: strength, what factors leave of it, and what is expected of a value of a column") {
  const Scene scene = scene_with_expectation();
  TensionStrength factors{};
  CHECK(reference_lines(scene, factors, [](const std::string&) { return 4.0; }).size() == 2);
  factors.seam_efficiency = 0.5;
  const auto lines =
      reference_lines(scene, factors, [](const std::string& name) { return name == "landing_s" ? 4 : 0; });
  REQUIRE(lines.size() == 3);  // none of the time of landing
  CHECK(lines[0].column == "cloth.tension_gauge_N_m");
  CHECK(lines[0].name == "strength of cloth, 120 kN/m");
  CHECK(lines[0].value == 120e3);
  CHECK(lines[1].name == "allowable of cloth, 60.0 kN/m");
  CHECK(lines[1].value == near(60e3, 1e-12));
  CHECK(lines[2].column == "bag.velocity_y_m_s");
  CHECK(lines[2].name == "speed max expected, 3.00 m/s");
  CHECK(lines[2].value == -1.5);
  CHECK(lines[2].from == 4);
  CHECK(lines[2].to == 6);
  const auto never = reference_lines(scene, {}, [](const std::string&) { return std::nan(""); });
  CHECK(never.size() == 1);
}
