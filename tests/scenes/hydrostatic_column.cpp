// Still water stays still: with jittered particles, on a lattice, and at the real bulk modulus.
#include <doctest/doctest.h>

#include "support/near.hpp"
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

TEST_CASE("Still water with a still level has its density at every depth and stays still, on any axes") {
  struct Column {
    std::string scene, level, cells;
    double mass, heavier;  ///< [kg], of it, and what its own weight adds without a level [-]
  };
  const double of_metre = 9.81 / (60 * 60) / 2;  // mean of rho g z / K over a metre
  for (const Column& column :
       {Column{scene, "5", "grid.refine=[]", 12500, 5 * of_metre},
        Column{scene, "5", "grid.refine=[{axis='y',from=2,to=3,spacing=0.125}]", 12500, 5 * of_metre},
        Column{"cases/hydrostatic_column_3d.toml", "2", "grid.refine=[]", 2000, 2 * of_metre}}) {
    CAPTURE(column.scene);
    CAPTURE(column.cells);
    const SceneRun run(column.scene, {"materials.water.still_level=" + column.level, column.cells});
    REQUIRE(run.outcome().code == 0);
    CHECK(run.column("total.mass_kg").back() == near(column.mass, 2e-5));
    CHECK(run.result("pressure_error_rms_ratio") <= 0.015);
    CHECK(run.result("velocity_rms_m_s") <= 0.02);
    const SceneRun denser_below(column.scene, {column.cells}, {"--until", "0.02"});
    CHECK(denser_below.column("total.mass_kg").back() == near(column.mass * (1 + column.heavier), 2e-4));
  }
}

TEST_CASE("Water with a still level sloshes as it does without, with the exact period and swing") {
  const SceneRun level("cases/sloshing.toml", {"materials.water.still_level=0.5"}), denser("cases/sloshing.toml");
  REQUIRE(level.outcome().code == 0);
  CHECK(level.summary().find("\"met\": false") == std::string::npos);
  // Of 0.69 J that the wave has; 3.94 J come of shifting, with and without.
  const double lost = level.column("energy.dissipated_J").back();
  CHECK(lost == within(denser.column("energy.dissipated_J").back(), 0.1));
}

TEST_CASE("A column at rest starts at rest: no pressure error in the first row, nothing lost later") {
  const SceneRun run(scene, {"time.end=1"});
  CHECK(run.column("still.pressure_error_max_Pa").front() < 1e-6);
  const std::vector<double> mass = run.column("total.mass_kg"), energy = run.column("energy.total_J");
  CHECK(mass.back() == mass.front());
  // Jitter leaves a few joules in motion and numerical dissipation takes them; 1e-4 of the energy is 15 J per m2.
  CHECK(std::abs(energy.back() - energy.front()) < 1e-4 * energy.front());
}
