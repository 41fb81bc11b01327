// Containers that land on others.
#include <doctest/doctest.h>

#include <cmath>

#include "support/program.hpp"

using namespace geodrop::test;

namespace {

/// Of a second container on the first one.
void check_stack(const std::string& scene, double least_between_centres) {
  CAPTURE(scene);
  const SceneRun run(scene, {"grid.spacing=0.5", "time.end=5"});
  REQUIRE(run.outcome().code == 0);
  CHECK(run.result("time_to_touch_s") > 1.5);
  const double first = run.column("first.position_y_m").back(), second = run.column("second.position_y_m").back();
  CHECK(second - first > least_between_centres);
  CHECK(std::abs(run.column("second.velocity_y_m_s").back()) < 0.5);
  CHECK(run.result("strays_m2") == 0);
}

}  // namespace

TEST_CASE("A second container lands on the first one and lies on it") {
  check_stack("tests/scenes/second_undrained.toml", 1);
}

TEST_CASE("So does one with pore water, flatter, on one with pore water") {
  check_stack("cases/dump_second_underwater.toml", 0.9);
}
