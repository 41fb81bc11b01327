// Waves that leave through silent sides, water that rests between them, and a fall that does not notice them.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "support/near.hpp"
#include "support/program.hpp"

using namespace geodrop::test;

namespace {

double reflected(const std::vector<std::string>& changes = {}) {
  const SceneRun run("cases/verification/silent_side.toml", changes);
  const double share = run.result("reflected_ratio") / run.result("incident_ratio");
  MESSAGE((changes.empty() ? "as it is" : changes.front()), ": ", share);
  return share;
}

/// Both components beside and above the pulse.
std::vector<double> velocities(const SceneRun& run) {
  std::vector<double> all;
  for (const char* name :
       {"beside.velocity_x_m_s", "beside.velocity_y_m_s", "above.velocity_x_m_s", "above.velocity_y_m_s"}) {
    const std::vector<double> one = run.column(name);
    all.insert(all.end(), one.begin(), one.end());
  }
  return all;
}

/// rms of the difference over that of the second.
double difference(const std::vector<double>& a, const std::vector<double>& b) {
  double square = 0, whole = 0;
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) {
    square += std::pow(a[k] - b[k], 2);
    whole += b[k] * b[k];
  }
  return std::sqrt(square / whole);
}

}  // namespace

TEST_CASE("A plane pulse leaves through a silent side; a wall sends it back") {
  CHECK(reflected() < 0.03);                                      // 2.6 %
  CHECK(reflected({"absorbing_layers.right.width=4.0"}) < 0.02);  // 1.5 %
  CHECK(reflected({"grid.spacing=0.125"}) < 0.02);                // 1.4 %
  CHECK(reflected({"absorbing_layers=[]"}) > 0.95);               // 99 %
  // The column beyond is lighter than the wave is long: 1 - exp(-4 m / (2 L)) of its front at most.
  const double column = reflected({"absorbing_layers.right.water_beyond=8.0"});
  CHECK(column > 0.1);
  CHECK(column < 0.24);
}

TEST_CASE("A round pulse: what comes back, against water so wide that nothing does") {
  const SceneRun silent("tests/scenes/round_pulse.toml", {}),
      closed("tests/scenes/round_pulse.toml", {"absorbing_layers=[]"});
  const SceneRun wide("tests/scenes/round_pulse.toml",
                      {"absorbing_layers=[]", "grid.lower.0=-24", "grid.upper.0=24", "bodies.water.shape.lower.0=-24",
                       "bodies.water.shape.upper.0=24"});
  const std::vector<double> reference = velocities(wide);
  const double of_silent = difference(velocities(silent), reference),
               of_closed = difference(velocities(closed), reference);
  MESSAGE("silent ", of_silent, ", closed ", of_closed);
  CHECK(of_closed > 0.9);
  CHECK(of_silent < 0.3 * of_closed);  // waves along the sides, off the surface and the bottom, leave in part only
}

TEST_CASE("Still water between silent sides stays still for 5 s") {
  const SceneRun run("tests/scenes/round_pulse.toml",
                     {"bodies.pulse.initial_stress.surface=15.0", "grid.spacing=0.5", "time.end=5.0"});
  REQUIRE(run.outcome().code == 0);
  for (const double speed : run.column("water.velocity_rms_m_s")) CHECK(speed < 0.01);
  const std::vector<double> mass = run.column("total.mass_kg");
  CHECK(std::abs(mass.back() / mass.front() - 1) < 1e-3);
}

TEST_CASE("The fall between silent sides 16 m apart is that in water 40 m wide") {
  const auto sides = [](const char* side) {
    return std::string("{name='") + side + "',body='water',side='" + side +
           "',width=2.0,water_beyond=8.0,rest_time=2.0}";
  };
  const std::string scene = "cases/verification/fall_free_slip.toml";
  const std::vector<std::string> short_fall{"time.end=1.01"};
  std::vector<std::string> silent = short_fall, wide = short_fall;
  silent.push_back("absorbing_layers=[" + sides("left") + "," + sides("right") + "]");
  for (const char* key : {"grid.", "bodies.water.shape."}) {
    wide.push_back(std::string(key) + "lower.0=-20.0");
    wide.push_back(std::string(key) + "upper.0=20.0");
  }
  const SceneRun one(scene, silent), other(scene, wide);
  for (const char* name : {"velocity_at_0_5_m_s", "velocity_at_1_0_m_s"})
    CHECK(one.result(name) == near(other.result(name), 0.005));  // 0.23, 0.08 %; closed: 1.0, 0.9 %
}
