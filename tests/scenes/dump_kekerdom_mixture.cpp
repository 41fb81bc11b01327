// The main case, coarse and short: it runs, stays symmetric, keeps its mass, and starts to fall.
#include <doctest/doctest.h>

#include <algorithm>

#include "support/near.hpp"
#include "support/program.hpp"

using namespace geodrop::test;

namespace {

double largest(const std::vector<double>& values) {
  double result = 0;
  for (const double value : values) result = std::max(result, std::isnan(value) ? 1e300 : std::abs(value));
  return result;
}

}  // namespace

TEST_CASE("The container starts to fall upright: symmetric, whole, with its membrane") {
  const SceneRun run("cases/dump_kekerdom_mixture.toml", {"grid.spacing=0.5", "time.end=0.2"});
  REQUIRE(run.outcome().code == 0);
  CHECK(run.text("status") == "done");
  // The scene is its own mirror image, so only round-off may push the container aside or turn it.
  CHECK(largest(run.column("container.velocity_x_m_s")) < 1e-6);
  CHECK(largest(run.column("container.rotation_deg")) < 1e-6);
  CHECK(largest(run.column("total.momentum_x_kg_m_s")) < 1e-6 * 5e5);  // of 500 t at 1 m/s
  const std::vector<double> mass = run.column("total.mass_kg");
  CHECK(largest(mass) > 5e5);
  for (const double m : mass) CHECK(m == mass.front());
  // In still water the first acceleration is (m' - m_w) g / (m' + added mass), which for a slender ellipse falling
  // along its long axis is between half and all of (1 - 1000/1631) g = 3.8 m/s2.
  const double speed = -run.column("container.velocity_y_m_s").back();
  CHECK(speed > 0.2 * 0.5 * 3.8 * 0.8);
  CHECK(speed < 0.2 * 3.8);
  CHECK(largest(run.column("bed.velocity_rms_m_s")) < 0.02);
  // The water at the bottom is squeezed by 13 m of itself, B of the bed at least 0.95.
  CHECK(run.result("bed.skempton_b_ratio") >= 0.95);
  CHECK(run.result("water.density_rise_ratio") < 0.04);
  CHECK(run.result("water.mach_ratio") == near(speed / 60, 0.01));
}

TEST_CASE("With a container as heavy as the water around it the main case is at rest, bed and all") {
  // 1009.1 kg/m3 is what the water at c = 60 m/s weighs at the height of the container's centre; at nu = 0.49 it is as
  // stiff as water, or stiffer. With 1 % more it sinks with 0.018 m/s after 1 s.
  const SceneRun run("cases/dump_kekerdom_mixture.toml",
                     {"grid.spacing=0.5", "time.end=1", "materials.sand.density=1009.1",
                      "materials.sand.poissons_ratio=0.49", "membranes.geotextile.mass_per_area=0"});
  REQUIRE(run.outcome().code == 0);
  CHECK(largest(run.column("container.velocity_y_m_s")) < 0.006);  // measured 0.002
  CHECK(largest(run.column("bed.velocity_rms_m_s")) < 0.001);      // measured 0.0003
}
