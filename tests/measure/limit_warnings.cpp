// Each limit is told once, at the row that passes it.
#include "measure/limit_warnings.hpp"

#include <geodrop/grid/graded_axis.hpp>

#include "base/text.hpp"
#include "support/small_state.hpp"
#include "support/text.hpp"

#include <doctest/doctest.h>

using namespace geodrop;
using geodrop::test::contains;

namespace {

/// The history of the small scene with one row per value of a column.
HistoryTable history_with(const Scene& scene, const std::string& column, const std::vector<double>& values) {
  HistoryTable history{history_columns(scene), {}};
  std::vector<double> row(history.columns.size(), 1e-9);
  for (const double value : values) {
    row[0] += 0.25;
    row[history.find(column)] = value;
    history.rows.push_back(row);
  }
  return history;
}

}  // namespace

TEST_CASE("A fluid beyond 0.3 of its wave speed") {
  const Scene scene = small_scene();  // sqrt(2e6 / 1000) = 44.7 m/s
  LimitWatch watch;
  HistoryTable history = history_with(scene, "bag.velocity_rms_m_s", {1, 13.4});
  CHECK(watch.look(scene, small_state(), history).empty());
  history = history_with(scene, "bag.velocity_rms_m_s", {1, 13.4, 13.5, 20});
  const auto warnings = watch.look(scene, small_state(), history);
  REQUIRE(warnings.size() == 1);
  CHECK(contains(warnings[0], "warning: bodies move at 0.302 of the wave speed of 'pool', by t = 0.75 s"));
  CHECK(watch.look(scene, small_state(), history).empty());
}

TEST_CASE("A fluid that is 10 % denser, in more than a splash") {
  const Scene scene = small_scene();
  const HistoryTable history = history_with(scene, "pool.velocity_rms_m_s", {0});
  State<2> state = small_state();
  state.t = 0.5;
  LimitWatch watch;
  state.bodies[1].J[0] = 0.5;  // soil may be
  state.bodies[0].J[0] = 0.92;
  CHECK(watch.look(scene, state, history).empty());
  state.bodies[0].J[0] = 0.9;
  const auto warnings = watch.look(scene, state, history);
  REQUIRE(warnings.size() == 1);
  CHECK(contains(warnings[0], "more than 1 % of 'pool' is over 10 % denser than without pressure, by t = 0.5 s"));
  CHECK(watch.look(scene, state, history).empty());
}

TEST_CASE("A closed membrane that encloses more than at the start, unless it is pumped up") {
  Scene scene = small_scene();
  scene.membranes[0].closed = true;
  HistoryTable history = history_with(scene, "skin.area_m2", {4, 4.039, 3.5, 4.0432});
  const auto warnings = LimitWatch().look(scene, small_state(), history);
  REQUIRE(warnings.size() == 1);
  CHECK(contains(warnings[0], "membrane 'skin' encloses 1.08 % more than at the start, by t = 1 s"));
  PumpSpec pump;
  pump.body = "bag";
  scene.pumps = {pump};
  CHECK(LimitWatch().look(scene, small_state(), history).empty());
}

TEST_CASE("A membrane of which a part has left the fine cells") {
  Scene scene = small_scene();
  scene.grid.refine = {{0, 0.0, 1.0, 0.125, 1.1, {}}};
  scene.grid.lower = {-8, -8, 0};
  scene.grid.upper = {8, 8, 0};
  scene.grid.spacing = 0.5;
  const HistoryTable history = history_with(scene, "pool.velocity_rms_m_s", {0});
  State<2> state = small_state();
  state.t = 0.5;
  const auto told_at = [&](double first, double last) {
    Array<double>& x = state.membranes[0].x[0];
    std::fill(x.begin(), x.end(), first);
    x.back() = last;
    return LimitWatch().look(scene, state, history);
  };
  CHECK(told_at(0.2, 0.9).empty());
  CHECK(told_at(0.2, 1.1).empty());   // cells there are hardly wider
  CHECK(told_at(-6.0, 6.0).empty());  // no part is in fine cells
  const AxisMap axis(scene.grid, 0);
  const auto warnings = told_at(0.2, 6.0);
  REQUIRE(warnings.size() == 1);
  CHECK(contains(warnings[0], "a part of membrane 'skin' has left the fine cells along x: " +
                                  format_number(axis.span_width(static_cast<int>(axis.to_grid(6) + 0.5)), 3) +
                                  " m wide at x = 6 m, " + format_number(axis.finest(), 3) +
                                  " m where they are finest, by t = 0.5 s"));
}
