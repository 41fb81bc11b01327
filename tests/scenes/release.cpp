// Containers that leave a split barge.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "support/program.hpp"

using namespace geodrop::test;

namespace {

/// (W/2) tan(beta + theta - atan mu) of cases/release_barge.toml [N/m].
double exact_net_force(double theta_deg) {
  const double weight = 9.0 * 18e3, slope = (35 + theta_deg) * std::numbers::pi / 180;
  return weight / 2 * std::tan(slope - std::atan(0.3));
}

double last(const SceneRun& run, const std::string& column) { return run.column(column).back(); }

}  // namespace

TEST_CASE("A slowly opening barge: thrust of the soil less pull of the geotextile, by the balance of half the bag") {
  const SceneRun run("cases/release_barge.toml");
  for (const int theta : {5, 12, 20}) {
    CAPTURE(theta);
    const double force = run.result("net_force_" + std::to_string(theta) + "deg_N_m");
    CHECK(std::abs(force / exact_net_force(theta) - 1) < 0.02);
  }
  // Soil that opens and closes on the way remembers its voids: without that the bag would be a third larger.
  CHECK(std::abs(last(run, "bag.area_m2") / 9.0 - 1) < 0.03);
}

TEST_CASE("A container dropped at 1 rad/s: never faster than free fall, whole, and at rest on the ground") {
  const SceneRun run("cases/release_barge_fast.toml");
  CHECK(run.result("impact_velocity_m_s") < 12.53);
  CHECK(run.result("impact_velocity_m_s") > 12.0);
  CHECK(std::abs(last(run, "bag.area_m2") / 9.0 - 1) < 0.03);
  CHECK(last(run, "fill.velocity_rms_m_s") < 0.01);
  CHECK(last(run, "fill.lowest_m") > 1.0);  // on the ground, which is 1.5 m thick, not in it
}

TEST_CASE("A second container comes to rest partly on the first, partly on the ground") {
  const SceneRun run("cases/two_containers.toml");
  CHECK(last(run, "fill2.velocity_rms_m_s") < 0.02);
  CHECK(last(run, "fill.velocity_rms_m_s") < 0.02);
  CHECK(last(run, "fill2.leftmost_m") < last(run, "fill.rightmost_m"));  // over the first
  CHECK(last(run, "fill2.lowest_m") < 1.9);                              // and down beside it
  CHECK(last(run, "bag.bag2.normal_force_N_m") > 1e3);
  for (const char* bag : {"bag.area_m2", "bag2.area_m2"}) CHECK(std::abs(last(run, bag) / 9.0 - 1) < 0.03);
}
