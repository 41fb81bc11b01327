// From runs to verdicts.
#include "verify/judge.hpp"

#include "support/near.hpp"
#include "verify/work_precision.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using namespace geodrop;
using geodrop::test::near;

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

TEST_CASE("A result may be divided by another one before it is compared") {
  VerifySpec ratio = spec("width_m", 2.5, 0, 1);
  ratio.over = "height_m";
  CHECK(error_of(ratio, run(0.1, 5)) == near(0.2, 1e-12));  // 10 / 5 = 2, expected 2.5
  ratio.over = "depth_m";
  CHECK(std::isnan(error_of(ratio, run(0.1, 5))));
}

TEST_CASE("The last run meets the target, or not; an order that is asked for counts too") {
  const std::vector<VariantRun> runs{run(0.2, 4.4), run(0.1, 4.1)};  // errors 0.1, 0.025: order 2
  VerifySpec target = spec("height_m", 4, 0, 0.03);
  for (const VerifyMode mode : {VerifyMode::quick, VerifyMode::full}) {
    const auto verdict = [&] { return judge(scene({target}), runs, mode).at(0).verdict; };
    target.target = 0.03;
    CHECK(verdict() == Verdict::met);
    target.least_order = 1.9;
    CHECK(verdict() == Verdict::met);
    target.least_order = 2.1;
    CHECK(verdict() == Verdict::missed);
    target.least_order = 0;
    target.target = 0.02;
    CHECK(verdict() == Verdict::missed);
  }
  const VerifyRow row = judge(scene({target}), runs, VerifyMode::full).at(0);
  CHECK(row.scene == "tower");
  CHECK(row.values == std::vector<double>{4.4, 4.1});
  CHECK(row.order == near(2, 1e-12));
}

TEST_CASE("An order needs two spacings: quick runs of one are not judged by it, full ones miss it") {
  VerifySpec target = spec("height_m", 4, 0, 0.03);
  target.least_order = 1.9;
  const std::vector<VariantRun> one{run(0.1, 4.1)};
  const VerifyRow quick = judge(scene({target}), one, VerifyMode::quick).at(0);
  CHECK_FALSE(quick.judges_order);
  CHECK(quick.verdict == Verdict::met);
  CHECK(judge(scene({target}), {run(0.2, 4.4), run(0.1, 4.1)}, VerifyMode::quick).at(0).judges_order);
  CHECK(judge(scene({target}), one, VerifyMode::full).at(0).verdict == Verdict::missed);
}

TEST_CASE("A quick target that is looser than the target makes a row coarse, not met; a tighter one replaces it") {
  VerifySpec target = spec("height_m", 4, 0, 0.02);
  target.quick_target = 0.03;
  const auto verdict = [&](double value, VerifyMode mode) {
    return judge(scene({target}), {run(0.1, value)}, mode).at(0).verdict;
  };
  CHECK(verdict(4.04, VerifyMode::quick) == Verdict::met);     // error 0.01
  CHECK(verdict(4.10, VerifyMode::quick) == Verdict::coarse);  // 0.025
  CHECK(verdict(4.10, VerifyMode::full) == Verdict::missed);   // the quick target is nothing to a full run
  CHECK(verdict(4.16, VerifyMode::quick) == Verdict::missed);  // 0.04
  target.quick_target = 0.005;
  CHECK(verdict(4.04, VerifyMode::quick) == Verdict::missed);
  CHECK(verdict(4.04, VerifyMode::full) == Verdict::met);
}

TEST_CASE("A coarse row needs its order") {
  VerifySpec target = spec("height_m", 4, 0, 0.02);
  target.quick_target = 0.03;
  target.least_order = 2.1;
  CHECK(judge(scene({target}), {run(0.2, 4.4), run(0.1, 4.1)}, VerifyMode::quick).at(0).verdict == Verdict::missed);
}

TEST_CASE("A known miss is guarded against getting worse, never met by it") {
  VerifySpec target = spec("height_m", 4, 0, 0.02);
  target.shortfall = "too coarse";
  target.guard = 0.03;
  const auto verdict = [&](double value, VerifyMode mode) {
    return judge(scene({target}), {run(0.1, value)}, mode).at(0).verdict;
  };
  for (const VerifyMode mode : {VerifyMode::quick, VerifyMode::full}) {
    CHECK(verdict(4.04, mode) == Verdict::met);      // error 0.01: no longer missed
    CHECK(verdict(4.10, mode) == Verdict::guarded);  // 0.025
    CHECK(verdict(4.16, mode) == Verdict::missed);   // 0.04
  }
  target.quick_target = 0.05;  // takes the place of the guard in quick runs
  CHECK(verdict(4.16, VerifyMode::quick) == Verdict::guarded);
  CHECK(verdict(4.16, VerifyMode::full) == Verdict::missed);
  VariantRun broken = run(0.1, 4.1);
  broken.status = RunStatus::failed;
  CHECK(judge(scene({target}), {broken}, VerifyMode::full).at(0).verdict == Verdict::missed);
}

TEST_CASE("Slack is what the last error is held to over that error") {
  VerifySpec target = spec("height_m", 4, 0, 0.07);
  const auto row = [&](double value) { return judge(scene({target}), {run(0.1, value)}, VerifyMode::full).at(0); };
  CHECK(slack(row(4.1)) == near(2.8, 1e-12));  // 0.07 / 0.025
  CHECK_FALSE(is_loose(row(4.1)));
  target.target = 0.08;
  CHECK(is_loose(row(4.1)));  // 3.2
  CHECK(std::isinf(slack(row(4))));
  CHECK(is_loose(row(4)));
  target.shortfall = "known";
  target.guard = 0.1;
  CHECK(slack(row(4.1)) == near(4, 1e-12));  // the guard's
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

TEST_CASE("A control has to miss the target of the row that it belongs to, and does not count as a resolution") {
  const std::vector<VerifySpec> specs{spec("height_m", 4, 0, 0.1), spec("width_m", 8, 0, 0.01)};
  const auto rows = [&](double value, const std::vector<std::string>& of) {
    VariantRun broken = control(value);
    broken.of = of;
    return judge(scene(specs), {run(0.1, 4), broken}, VerifyMode::full);
  };
  const std::vector<VerifyRow> width = rows(4.2, {"width_m"});  // 5 % of both: the target of the width is 1 %
  REQUIRE(width.size() == 3);
  CHECK(width[0].verdict == Verdict::met);
  CHECK(width[0].values.size() == 1);
  CHECK_FALSE(width[0].controlled);
  CHECK(width[1].controlled);
  CHECK(width[2].control);
  CHECK(width[2].result == "width_m");
  CHECK(width[2].what == "control: too soft");
  CHECK(width[2].verdict == Verdict::met);
  CHECK(rows(4.2, {"height_m"}).at(2).verdict == Verdict::missed);  // it misses another row's target
  const std::vector<VerifyRow> both = rows(4.2, {"height_m", "width_m"});
  REQUIRE(both.size() == 4);
  CHECK(both[2].verdict == Verdict::missed);
  CHECK(both[3].verdict == Verdict::met);
  CHECK(rows(4, {"width_m"}).at(2).verdict == Verdict::missed);
}

TEST_CASE("The control of a known miss has to miss its guard") {
  VerifySpec known = spec("height_m", 4, 0, 0.01);
  known.shortfall = "too coarse";
  known.guard = 0.1;
  const auto verdict = [&](double value) {
    return judge(scene({known}), {run(0.1, 4.2), control(value)}, VerifyMode::full).at(1).verdict;
  };
  CHECK(verdict(4.2) == Verdict::missed);  // as good as the run itself
  CHECK(verdict(4.6) == Verdict::met);
}

TEST_CASE("A control that breaks counts only if the scene says so, and breaks with that message") {
  const auto verdict = [](RunStatus status, const std::string& message, const std::string& breaks) {
    VariantRun broken = control(4.4);
    broken.status = status;
    broken.message = message;
    broken.breaks = breaks;
    return judge(scene({spec("height_m", 4, 0, 0.01)}), {run(0.1, 4), broken}, VerifyMode::full).at(1).verdict;
  };
  const std::string message = "particle id 2 has no volume left";
  CHECK(verdict(RunStatus::failed, message, "no volume left") == Verdict::met);
  CHECK(verdict(RunStatus::failed, message, "") == Verdict::missed);
  CHECK(verdict(RunStatus::failed, message, "energy grows") == Verdict::missed);
  CHECK(verdict(RunStatus::done, "", "no volume left") == Verdict::missed);  // it was to break
  CHECK(verdict(RunStatus::done, "", "") == Verdict::met);
}
