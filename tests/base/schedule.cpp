// What is due at an interval of time: each multiple once, and never a loop that does not end.
#include "base/schedule.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using geodrop::Schedule;

TEST_CASE("Each multiple of an interval is due once, at the first time at or after it") {
  Schedule schedule(0.1);
  int passed = 0;
  for (int step = 0; step <= 1000; ++step) {
    const double t = 0.01 * step;
    if (!schedule.due(t)) continue;
    CHECK(step % 10 == 0);
    schedule.pass(t);
    CHECK_FALSE(schedule.due(t));
    ++passed;
  }
  CHECK(passed == 101);
}

TEST_CASE("What was missed is due once, and an interval of 0 never") {
  Schedule schedule(0.25);
  schedule.pass(1.6);
  CHECK_FALSE(schedule.due(1.7499));
  CHECK(schedule.due(1.75));
  schedule.pass(0.1);  // an earlier time changes nothing
  CHECK_FALSE(schedule.due(1.7499));
  CHECK_FALSE(Schedule(0).due(1));
}

TEST_CASE("Intervals far below the time pass at once") {
  // At t / interval beyond 2^53 one more is the same number.
  for (const double interval : {1e-16, 1e-19, 1e-300, std::numeric_limits<double>::denorm_min()}) {
    CAPTURE(interval);
    Schedule schedule(interval);
    schedule.pass(9.0);
    CHECK(schedule.due(10.0) == std::isfinite(10.0 / interval));
  }
}
