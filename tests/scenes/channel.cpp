// Viscous flow between no-slip walls: Poiseuille's start-up in the middle of a falling plug, tests/scenes/channel.toml.
#include <doctest/doctest.h>

#include <numbers>

#include "support/near.hpp"
#include "support/program.hpp"

using namespace geodrop::test;

namespace {

/// u nu / (g L^2) at x / L and t nu / L^2.
double startup(double x, double t) {
  double u = 0.5 * x * (1 - x);
  for (int n = 1; n < 100; n += 2) {
    const double k = n * std::numbers::pi;
    u -= 4 / (k * k * k) * std::sin(k * x) * std::exp(-k * k * t);
  }
  return u;
}

/// L2 error of the profile at the row nearest to t, relative to the profile.
double profile_error(const SceneRun& run, double t) {
  const std::vector<double> times = run.column("time_s");
  const auto row = static_cast<std::size_t>(std::lower_bound(times.begin(), times.end(), t - 1e-9) - times.begin());
  double difference = 0, size = 0;
  for (int k = 1; k <= 5; ++k) {
    const double exact = -0.08 * startup(0.1 * k, times.at(row));
    const double found = run.column("x" + std::to_string(k) + ".velocity_y_m_s").at(row);
    difference += (found - exact) * (found - exact);
    size += exact * exact;
  }
  return std::sqrt(difference / size);
}

}  // namespace

TEST_CASE("The series of the start-up has the values of the reference table") {
  CHECK(startup(0.1, 0.0225) == near(0.0125456646, 1e-8));
  CHECK(startup(0.3, 0.1125) == near(0.07061583649, 1e-8));
}

TEST_CASE("A viscous fluid begins to flow between no-slip walls as Poiseuille says") {
  const SceneRun coarse("tests/scenes/channel.toml", {"grid.spacing=0.1"}), fine("tests/scenes/channel.toml");
  REQUIRE(fine.outcome().code == 0);
  for (const double t : {0.0225, 0.045, 0.1125}) {
    const double e1 = profile_error(coarse, t), e2 = profile_error(fine, t);
    MESSAGE("t = ", t, ": error ", e1, " at h = L/10, ", e2, " at L/20");
    CHECK(e2 < 0.005);
  }
}
