// Elastic columns and bars against closed forms, with the order of convergence where the reference allows it.
#include <doctest/doctest.h>

#include <cstdio>

#include "support/near.hpp"
#include "support/program.hpp"

using namespace geodrop::test;

namespace {

const std::string column = "cases/gravity_column.toml";
constexpr double static_value = 0.65991e-3;  ///< settlement of the point at rest [m]

std::string spacing(double h) { return "grid.spacing=" + std::to_string(h); }

/// rms difference from the exact undamped displacements, relative to the static value.
double column_error(double h, bool feather) {
  std::vector<std::string> settings{spacing(h)};
  if (feather) {
    // The reference is of small strain. At a hundredth of gravity the strain is 1e-5, and what is left is the scheme's.
    settings.insert(settings.end(), {"gravity.1=-0.0981",
                                     "results.displacement_rms_difference_m.values="
                                     "[-0.91109e-5, -1.19839e-5, -0.08456e-5, -0.48610e-5, -1.31657e-5]"});
  }
  const SceneRun run(column, settings);
  return run.result("displacement_rms_difference_m") / static_value * (feather ? 100 : 1);
}

}  // namespace

TEST_CASE("A column under sudden gravity swings as the exact one does, to 3 % of the static value") {
  CHECK(column_error(0.025, false) <= 0.03);
}

TEST_CASE("At small strain the error of the swinging column falls with the second order of the spacing") {
  const double coarse = column_error(0.05, true), fine = column_error(0.025, true);
  MESSAGE("error ", coarse, " at h = 0.05, ", fine, " at 0.025");
  CHECK(std::log2(coarse / fine) >= 1.7);
}

TEST_CASE("A damped column comes to rest at the static value, to 0.1 %") {
  const SceneRun run(column, {"solver.damping_rate=60"});
  // Not the table's value but the formula that it rounds: rho g (H y - y^2/2) / Ec.
  const double nu = 0.33, Ec = 10e6 * (1 - nu) / ((1 + nu) * (1 - 2 * nu)), y = 0.94309;
  const double settlement = 2000 * 9.81 * (y - y * y / 2) / Ec;
  CHECK(settlement == near(static_value, 0.0002));
  CHECK(run.result("displacement_end_m") == near(-settlement, 0.001));
}

TEST_CASE("A bar in its first mode has the exact period to 0.2 %, and keeps its swing") {
  const SceneRun run("cases/elastic_bar.toml");
  CHECK(run.result("period_s") == near(10, 0.002));
  CHECK(run.result("displacement_first_m") == near(0.11254, 0.007));
  // Nine periods later: measured 0.8 % less. Half of the swing would be gone with a blend rate of 1/s.
  CHECK(run.result("displacement_last_m") / run.result("displacement_first_m") > 0.97);
}
