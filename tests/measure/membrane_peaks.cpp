// A membrane beyond its strength is told once, and its largest tension is told at the end.
#include "measure/membrane_peaks.hpp"

#include <geodrop/files/output.hpp>

#include "base/json.hpp"
#include "support/scene_files.hpp"
#include "support/small_state.hpp"

#include <doctest/doctest.h>

using namespace geodrop;

namespace {

Scene scene_with_strength(double strength) {
  Scene scene = small_scene();
  scene.membranes[0].strength = strength;
  return scene;
}

/// HistoryRow of a state whose membrane was pulled to `peak` [N/m] since the row before.
std::vector<double> row_at(const Scene& scene, double t, double peak, const HistoryTable& earlier) {
  State<2> state = small_state();
  state.t = t;
  state.membranes[0].gauge.peak = peak;
  state.membranes[0].gauge.peak_time = t - 0.125;
  state.membranes[0].gauge.peak_at = {4, 5};
  return history_row(scene, state, earlier);
}

HistoryTable history_of(const Scene& scene, const std::vector<double>& peaks) {
  HistoryTable history{history_columns(scene), {}};
  for (const double peak : peaks)
    history.rows.push_back(row_at(scene, 0.25 * static_cast<double>(history.rows.size()), peak, history));
  return history;
}

}  // namespace

TEST_CASE("the first row beyond the strength gives one warning with membrane, tension, strength, time and place") {
  const Scene scene = scene_with_strength(500);
  CHECK(strength_warnings(scene, history_of(scene, {400, 500})).empty());
  const std::vector<std::string> warnings = strength_warnings(scene, history_of(scene, {400, 450, 625.5}));
  REQUIRE(warnings.size() == 1);
  CHECK(
      warnings[0] ==
      "warning: membrane skin exceeds its strength: tension 625.5 N/m, strength 500 N/m, by t = 0.5 s, near (4, 5) m; "
      "it does not tear, the run goes on");
  CHECK(strength_warnings(scene, history_of(scene, {400, 600, 700})).empty());  // told before
  const Scene unknown = scene_with_strength(0);
  CHECK(strength_warnings(unknown, history_of(unknown, {700})).empty());
}

TEST_CASE("the peak is the largest of all rows, at the first row that has it") {
  const Scene scene = scene_with_strength(500);
  const std::vector<Fact> facts = membrane_peaks(scene, history_of(scene, {400, 625.5, 350, 625.5}));
  REQUIRE(facts.size() == 2);
  CHECK(facts[0].name == "skin.tension_gauge_N_m");
  CHECK(facts[0].value == 625.5);
  CHECK(facts[1].name == "skin.time_of_peak_s");
  CHECK(facts[1].value == 0.125);
  CHECK(membrane_peaks(scene, {history_columns(scene), {}}).empty());
}

TEST_CASE("the run's log and summary tell of the membrane") {
  const TemporaryDirectory directory;
  const Scene scene = scene_with_strength(250);  // the state's peak is 300
  RunOptions options;
  options.directory = directory / "run";
  Output<2> output(scene, options);
  State<2> state = small_state();
  state.membranes[0].gauge.peak = 300;
  state.membranes[0].gauge.peak_time = 0.5;
  output.start(Frame<2>(state));
  state.t = 1;
  output.finish(Frame<2>(state), {});
  const std::string log = read_file(directory / "run/run.log"), warning = "warning: membrane skin exceeds its strength";
  CHECK(log.find(warning) != std::string::npos);
  CHECK(log.find(warning) == log.rfind(warning));
  const Json facts = Json::parse(read_file(directory / "run/summary.json")).at("facts");
  CHECK(facts.at("skin.tension_gauge_N_m").at("value") == 300);
  CHECK(facts.at("skin.time_of_peak_s").at("value") == 0.5);
}
