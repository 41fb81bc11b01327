// A belt over a drum that turns under it, against Euler and Eytelwein.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "support/near.hpp"
#include "support/program.hpp"

using namespace geodrop::test;

namespace {

/// T_left / T_right from the sums of the contact forces, the strap on the drum taken off.
double tension_ratio(const SceneRun& run) {
  REQUIRE(run.outcome().code == 0);
  const auto normal = run.column("belt.drum.normal_force_y_N_m"), along = run.column("belt.drum.friction_force_y_N_m"),
             friction = run.column("belt.drum.friction_force_N_m"), t = run.column("time_s");
  const double strap = 20 * 9.81 * std::numbers::pi / 2 * (0.6 * 0.6 - 0.5 * 0.5);
  double sum = 0, difference = 0;
  for (std::size_t k = 0; k < t.size(); ++k) {
    if (t[k] < 1.2) continue;
    sum += normal[k] + along[k] - strap;
    difference += friction[k];
  }
  return (sum + difference) / (sum - difference);
}

}  // namespace

TEST_CASE("Friction takes exp(mu pi) off a belt over half a turn of a drum, and adds it if the drum turns back") {
  const double exact = std::exp(0.3 * std::numbers::pi);
  CHECK(tension_ratio(SceneRun("cases/capstan.toml", {}, {"--verify"})) == near(exact, 0.03));
  const SceneRun back("cases/capstan.toml", {"rigid.drum.motion.rate=1.0"});
  CHECK(tension_ratio(back) == near(1 / exact, 0.03));
}
