// Still water stays still: with jittered particles, on a lattice, and at the real bulk modulus.
#include <doctest/doctest.h>

#include "support/program.hpp"

using namespace geodrop::test;

namespace {

const std::string scene = "cases/hydrostatic_column.toml";

}  // namespace

TEST_CASE("A jittered column keeps its pressure to 1.5 % of rho g H, and hardly moves") {
  const SceneRun run(scene);
  REQUIRE(run.outcome().code == 0);
  CHECK(run.result("pressure_error_rms_ratio") <= 0.015);
  CHECK(run.result("velocity_rms_m_s") <= 0.02);
  CHECK(run.summary().find("\"met\": false") == std::string::npos);
}

TEST_CASE("A jittered column keeps its pressure to 1.5 % on every basis") {
  // At h = 0.25 m: 0.80 % (bspline2), 0.76 % (gimp), 0.61 % (linear).
  for (const std::string basis : {"gimp", "linear"}) {
    const SceneRun run(scene, {"grid.basis=" + basis});
    CAPTURE(basis);
    REQUIRE(run.outcome().code == 0);
    CHECK(run.result("pressure_error_rms_ratio") <= 0.015);
    CHECK(run.result("velocity_rms_m_s") <= 0.02);
  }
}

TEST_CASE("A column on a lattice keeps its pressure to 1 %") {
  const SceneRun run(scene, {"bodies.water.jitter=0"});
  CHECK(run.result("pressure_error_rms_ratio") <= 0.01);
  CHECK(run.result("velocity_rms_m_s") <= 0.02);
}

TEST_CASE("A jittered column of real water keeps its pressure to 1.5 %") {
  std::vector<std::string> settings{"materials.water.sound_speed=", "materials.water.bulk_modulus=2.13e9",
                                    "time.end=2"};
  for (const std::string result : {"pressure_error_rms_Pa", "pressure_error_rms_ratio", "velocity_rms_m_s"})
    settings.push_back("results." + result + ".from=1");
  const SceneRun run(scene, settings);
  CHECK(run.result("pressure_error_rms_ratio") <= 0.015);
  CHECK(run.result("velocity_rms_m_s") <= 0.02);
}

TEST_CASE("A column at rest starts at rest: no pressure error in the first row, nothing lost later") {
  const SceneRun run(scene, {"time.end=1"});
  CHECK(run.column("still.pressure_error_max_Pa").front() < 1e-6);
  const std::vector<double> mass = run.column("total.mass_kg"), energy = run.column("energy.total_J");
  CHECK(mass.back() == mass.front());
  // Jitter leaves a few joules in motion and numerical dissipation takes them; 1e-4 of the energy is 15 J per m2.
  CHECK(std::abs(energy.back() - energy.front()) < 1e-4 * energy.front());
}
