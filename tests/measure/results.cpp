// Reductions on series whose numbers are known, and the table beside the expectations.
#include <geodrop/base/error.hpp>
#include <geodrop/measure/results.hpp>

#include "support/near.hpp"
#include "support/small_state.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

HistoryTable table_of(const std::vector<std::function<double(double)>>& columns, double dt, int rows) {
  HistoryTable history{{"time_s", "a", "b"}, {}};
  history.columns.resize(columns.size() + 1);
  for (int i = 0; i < rows; ++i) {
    history.rows.push_back({i * dt});
    for (const auto& column : columns) history.rows.back().push_back(column(i * dt));
  }
  return history;
}

ResultSpec spec_of(Reduction reduce) {
  ResultSpec spec;
  spec.name = "value_m";
  spec.column = "a";
  spec.reduce = reduce;
  spec.to = infinity;
  return spec;
}

}  // namespace

TEST_CASE("last, least, largest, mean, rms in a window of time, scaled") {
  const HistoryTable history = table_of({[](double t) { return t * t; }}, 1.0, 6);  // 0 1 4 9 16 25
  ResultSpec spec = spec_of(Reduction::last);
  CHECK(reduce(spec, history) == 25);
  spec.from = 1;
  spec.to = 3;
  CHECK(reduce(spec, history) == 9);
  spec.reduce = Reduction::min;
  CHECK(reduce(spec, history) == 1);
  spec.scale = -2;
  CHECK(reduce(spec, history) == -2);
  spec.reduce = Reduction::max;
  CHECK(reduce(spec, history) == -18);
  spec.scale = 1;
  spec.reduce = Reduction::mean;
  CHECK(reduce(spec, history) == near(14 / 3.0, 1e-12));
  spec.reduce = Reduction::rms;
  CHECK(reduce(spec, history) == near(std::sqrt(98 / 3.0), 1e-12));
}

TEST_CASE("rows without a value do not count, no rows give no number") {
  HistoryTable history = table_of({[](double t) { return t; }}, 1.0, 3);
  history.rows[2][1] = std::nan("");
  ResultSpec spec = spec_of(Reduction::mean);
  CHECK(reduce(spec, history) == 0.5);
  spec.from = 1.5;
  CHECK(std::isnan(reduce(spec, history)));
}

TEST_CASE("percentile is linear between neighbours") {
  const HistoryTable history = table_of({[](double t) { return 10 - t; }}, 1.0, 11);
  ResultSpec spec = spec_of(Reduction::percentile);
  spec.percentile = 95;
  CHECK(reduce(spec, history) == near(9.5, 1e-12));
  spec.percentile = 0;
  CHECK(reduce(spec, history) == 0);
  spec.percentile = 100;
  CHECK(reduce(spec, history) == 10);
}

TEST_CASE("period of a sine, with an offset and with damping") {
  const double period = 0.7, pi = std::numbers::pi;
  const ResultSpec spec = spec_of(Reduction::period);
  const auto sine = [&](double t) { return std::sin(2 * pi * t / period + 1); };
  // The crossings of rows 0.01 apart are found by straight lines: an error of (2 pi dt / T)^3 / 100 of a period at
  // most.
  CHECK(reduce(spec, table_of({sine}, 0.01, 1000)) == near(period, 1e-12));
  CHECK(reduce(spec, table_of({[&](double t) { return sine(t) + 0.4; }}, 0.01, 993)) == near(period, 1e-12));
  CHECK(reduce(spec, table_of({[&](double t) { return std::exp(-t) * sine(t); }}, 0.01, 400)) == near(period, 1e-12));
  CHECK(std::isnan(reduce(spec, table_of({sine}, 0.01, 60))));  // less than one period
  // One rising crossing between two falling ones, and the other way round.
  const auto short_sine = [&](double t) { return std::sin(2 * pi * t / period + 3); };
  CHECK(reduce(spec, table_of({short_sine}, 0.01, 75)) == near(period, 1e-12));
  CHECK(reduce(spec, table_of({[&](double t) { return -short_sine(t); }}, 0.01, 75)) == near(period, 1e-12));
}

TEST_CASE("first time below a level") {
  ResultSpec spec = spec_of(Reduction::first_time_below);
  spec.level = 2.5;
  const HistoryTable falling = table_of({[](double t) { return 4 - t; }}, 1.0, 6);
  CHECK(reduce(spec, falling) == near(1.5, 1e-12));
  spec.level = 5;
  CHECK(reduce(spec, falling) == 0);
  spec.level = -2;
  CHECK(std::isnan(reduce(spec, falling)));
}

TEST_CASE("rms difference at given times, between rows") {
  ResultSpec spec = spec_of(Reduction::rms_difference);
  spec.times = {0.5, 2.0};
  spec.values = {4, -1};
  const HistoryTable history = table_of({[](double t) { return 2 * t; }}, 1.0, 3);
  CHECK(reduce(spec, history) == near(std::sqrt((9 + 25) / 2.0), 1e-12));
  spec.times = {0.5, 2.1};
  CHECK(std::isnan(reduce(spec, history)));  // after the last row
}

TEST_CASE("r squared") {
  ResultSpec spec = spec_of(Reduction::r_squared);
  spec.against = "b";
  CHECK(reduce(spec, table_of({[](double t) { return 3 - 2 * t; }, [](double t) { return t; }}, 1.0, 5)) ==
        near(1, 1e-12));
  // a = 0 1 0 over b = 0 1 2 has no slope; a = 0 1 0 1 over 0 1 2 3: sxy = 1, sxx = 5, syy = 1
  const auto zigzag = [](double t) { return std::fmod(t, 2.0); };
  CHECK(reduce(spec, table_of({zigzag, [](double t) { return t; }}, 1.0, 3)) == near_zero(1e-12));
  HistoryTable history = table_of({zigzag, [](double t) { return t; }}, 1.0, 4);
  CHECK(reduce(spec, history) == near(1 / 5.0, 1e-12));
  // A gap in either column leaves out the row of both.
  history.rows.push_back({4, std::nan(""), 7});
  history.rows.push_back({5, 7, std::nan("")});
  CHECK(reduce(spec, history) == near(1 / 5.0, 1e-12));
}

TEST_CASE("slope of the best straight line") {
  const ResultSpec spec = spec_of(Reduction::slope);
  CHECK(reduce(spec, table_of({[](double t) { return 3 - 2 * t; }}, 0.5, 5)) == near(-2, 1e-12));
  // 0 0 0 0 10 over 0..4: sum (t - 2) y = 20, sum (t - 2)^2 = 10
  CHECK(reduce(spec, table_of({[](double t) { return t > 3 ? 10.0 : 0.0; }}, 1.0, 5)) == near(2, 1e-12));
  CHECK(std::isnan(reduce(spec, table_of({[](double t) { return t; }}, 1.0, 1))));
}

TEST_CASE("windows that begin or end with an event") {
  Scene scene = small_scene();
  ResultSpec event = spec_of(Reduction::first_time_below), later = spec_of(Reduction::max), sooner = later;
  event.name = "event_s";
  event.level = 2.5;
  later.name = "later_m";
  later.after = "event_s";
  sooner.name = "sooner_m";
  sooner.reduce = Reduction::min;
  sooner.before = "event_s";
  scene.results = {event, later, sooner};
  const HistoryTable falling = table_of({[](double t) { return 4 - t; }}, 1.0, 6);
  auto results = reduce_all(scene, falling);
  CHECK(results[0].value == near(1.5, 1e-12));
  CHECK(results[1].value == 2);
  CHECK(results[2].value == 3);
  scene.results[0].level = -9;  // never
  results = reduce_all(scene, falling);
  CHECK(std::isnan(results[1].value));
  CHECK(results[2].value == -1);
}

TEST_CASE("expectations are met up to their tolerance") {
  Scene scene = small_scene();
  scene.results = {spec_of(Reduction::last)};
  scene.expect = {{"value_m", 2.5, 0.5, "by hand", {}}, {"value_m", 2.4, 0.5, "by hand", {}}};
  const HistoryTable history = table_of({[](double t) { return t; }}, 1.0, 4);
  const auto results = reduce_all(scene, history);
  const auto expectations = compare(scene, results);
  REQUIRE(expectations.size() == 2);
  CHECK(expectations[0].met);
  CHECK_FALSE(expectations[1].met);
  CHECK(results[0].unit == "m");
  CHECK(results_table(results, expectations) ==
        "result   value  unit  expected  tolerance  met  source\n"
        "value_m      3  m          2.5      +-0.5  yes  by hand\n"
        "value_m      3  m          2.4      +-0.5  NO   by hand\n");
  const Result share{"kinetic_ratio", 0.25, "1"};
  CHECK(results_table({share, {"shape_r_squared", 0.5, "1"}}, {{share, 0.25, 0.125, "by hand", true}}) ==
        "result           value  unit  expected  tolerance  met  source\n"
        "kinetic_ratio     0.25            0.25    +-0.125  yes  by hand\n"
        "shape_r_squared    0.5\n");
}

TEST_CASE("a result that is no number meets nothing") {
  Scene scene = small_scene();
  scene.expect = {{"gone_m", 0, infinity, "", {}}};
  CHECK_FALSE(compare(scene, {{"gone_m", std::nan(""), "m"}})[0].met);
}

TEST_CASE("a result of a column that is not there is the user's mistake") {
  Scene scene = small_scene();
  ResultSpec spec = spec_of(Reduction::last);
  spec.column = "bag.velocity_y_m_s";
  scene.results = {spec};
  CHECK_NOTHROW(check_results(scene));
  scene.results[0].column = "bag.velocty_y_m_s";
  scene.results[0].at = {12, 3};
  try {
    check_results(scene);
    FAIL("not refused");
  } catch (const SceneError& error) {
    REQUIRE(error.problems().size() == 1);
    CHECK(error.problems()[0].at.line == 12);
    CHECK(error.problems()[0].allowed.find("bag.velocity_y_m_s") != std::string::npos);
  }
}
