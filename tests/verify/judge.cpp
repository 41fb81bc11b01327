// From runs to verdicts.
#include "verify/judge.hpp"
#include "verify/work_precision.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "support/near.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

VerifySpec spec(const std::string& result, double expected, double scale, double target) {
  VerifySpec one;
  one.result = result;
  one.expected = expected;
  one.scale = scale;
  one.target = target;
  return one;
}

VariantRun run(double spacing, double value) {
  VariantRun one;
  one.spacing = spacing;
  one.results = {{"height_m", value, "m"}, {"width_m", 2 * value, "m"}};
  return one;
}

VariantRun control(double value) {
  VariantRun one = run(0.1, value);
  one.name = "too soft";
  one.control = true;
  return one;
}

Scene scene(const std::vector<VerifySpec>& specs) {
  Scene one;
  one.file = "cases/tower.toml";
  one.verify = specs;
  return one;
}

}  // namespace

TEST_CASE("Errors are relative to the scale, or to what is expected") {
  CHECK(error_of(spec("height_m", 4, 0, 1), run(0.1, 5)) == near(0.25, 1e-12));
  CHECK(error_of(spec("height_m", -4, 0, 1), run(0.1, -5)) == near(0.25, 1e-12));
  CHECK(error_of(spec("height_m", 4, 2, 1), run(0.1, 5)) == near(0.5, 1e-12));
  CHECK(error_of(spec("width_m", 4, 0, 1), run(0.1, 5)) == near(1.5, 1e-12));
  CHECK(std::isnan(error_of(spec("depth_m", 4, 0, 1), run(0.1, 5))));
  VariantRun broken = run(0.1, 4);
  broken.status = RunStatus::failed;
  CHECK(std::isnan(error_of(spec("height_m", 4, 0, 1), broken)));
}

TEST_CASE("The order is the slope over all spacings") {
  CHECK(observed_order({0.4, 0.2, 0.1}, {0.16, 0.04, 0.01}) == near(2, 1e-12));
  CHECK(observed_order({0.4, 0.2}, {0.2, 0.4}) == near(-1, 1e-12));
  CHECK(observed_order({0.4, 0.2, 0.1}, {0.4, 0.4, 0.1}) == near(1, 1e-12));  // least squares: not the last pair's 2
  CHECK(std::isnan(observed_order({0.1, 0.1}, {0.2, 0.4})));
  CHECK(std::isnan(observed_order({0.1}, {0.2})));
  CHECK(std::isnan(observed_order({0.2, 0.1}, {0.2, 0.0})));
  CHECK(std::isnan(observed_order({0.2, 0.1}, {std::numeric_limits<double>::quiet_NaN(), 0.1})));
}

TEST_CASE("The last run meets the target, or not; an order that is asked for counts too") {
  std::vector<VariantRun> runs{run(0.2, 4.4), run(0.1, 4.1)};  // errors 0.1, 0.025: order 2
  VerifySpec target = spec("height_m", 4, 0, 0.03);
  VerifyMode mode = VerifyMode::full;
  const auto verdict = [&] { return judge(scene({target}), runs, mode).at(0).verdict; };
  CHECK(verdict() == Verdict::met);
  target.least_order = 1.9;
  CHECK(verdict() == Verdict::met);
  target.least_order = 2.1;
  CHECK(verdict() == Verdict::missed);
  mode = VerifyMode::quick;
  CHECK(verdict() == Verdict::met);  // an order is asked for by full only
  target.quick_target = 0.02;
  CHECK(verdict() == Verdict::missed);
  mode = VerifyMode::full;
  target.least_order = 0;
  target.target = 0.02;
  CHECK(verdict() == Verdict::missed);
  target.shortfall = "too coarse";
  CHECK(verdict() == Verdict::known);
  mode = VerifyMode::quick;
  CHECK(verdict() == Verdict::missed);  // by the quick target, which no shortfall excuses
  target.quick_target = 0;
  CHECK(verdict() == Verdict::known);
  mode = VerifyMode::full;
  target.target = 0.03;
  CHECK(verdict() == Verdict::met);
  runs.back().status = RunStatus::failed;
  CHECK(verdict() == Verdict::known);
  const VerifyRow row = judge(scene({target}), {run(0.2, 4.4), run(0.1, 4.1)}, mode).at(0);
  CHECK(row.scene == "tower");
  CHECK(row.values == std::vector<double>{4.4, 4.1});
  CHECK(row.order == near(2, 1e-12));
}

TEST_CASE("A picture for each scene with four spacings, the others by the handful; none of controls") {
  const auto rows_of = [](const std::vector<double>& spacings, const std::vector<VariantRun>& runs) {
    std::vector<VerifyRow> rows(1);
    rows[0].scene = "tower" + std::to_string(spacings.size());
    for (std::size_t i = 0; i < spacings.size(); ++i) {
      rows[0].runs.push_back(&runs[i]);
      rows[0].errors.push_back(0.1);
    }
    return rows;
  };
  const std::vector<VariantRun> runs{run(0.4, 1), run(0.2, 2), run(0.1, 3), run(0.05, 4)};
  std::vector<VerifyRow> rows = rows_of({0.4, 0.2, 0.1, 0.05}, runs);
  for (int k = 0; k < 7; ++k) rows.push_back(rows_of({0.4, 0.2, 0.1}, runs)[0]);
  rows.push_back(rows_of({0.4, 0.2}, runs)[0]);
  rows.push_back(rows[0]);
  rows.back().control = true;
  const std::vector<WorkPicture> pictures = work_precision_pictures(rows);
  REQUIRE(pictures.size() == 3);
  CHECK(pictures[0].name == "work_precision_tower4");
  CHECK(pictures[0].chart.panels[0].series.size() == 1);
  CHECK(pictures[1].name == "work_precision_others_1");
  CHECK(pictures[1].chart.panels[0].series.size() == 6);
  CHECK(pictures[2].chart.panels[0].series.size() == 1);
}

TEST_CASE("A control is met if a target is missed by it, also by breaking, and does not count as a resolution") {
  const std::vector<VerifySpec> specs{spec("height_m", 4, 0, 0.1), spec("width_m", 8, 0, 0.01)};
  const auto rows = [&](const VariantRun& broken) {
    return judge(scene(specs), {run(0.1, 4), broken}, VerifyMode::full);
  };
  REQUIRE(rows(control(4.2)).size() == 3);
  CHECK(rows(control(4.2))[0].verdict == Verdict::met);
  CHECK(rows(control(4.2))[0].values.size() == 1);
  const VerifyRow missed = rows(control(4.2))[2];  // 5 % of both: the width's target is missed by more
  CHECK(missed.control);
  CHECK(missed.verdict == Verdict::met);
  CHECK(missed.result == "width_m");
  CHECK(missed.what == "control: too soft");
  CHECK(rows(control(4.0))[2].verdict == Verdict::missed);
  VariantRun broken = control(4.0);
  broken.status = RunStatus::failed;
  CHECK(rows(broken)[2].verdict == Verdict::met);
}
