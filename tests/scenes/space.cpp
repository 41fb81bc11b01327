// Scenes in three dimensions against closed forms: water, elastic bars, soil at rest and loaded.
#include <doctest/doctest.h>

#include "support/near.hpp"
#include "support/program.hpp"

using namespace geodrop::test;

namespace {

bool all_met(const SceneRun& run) { return run.summary().find("\"met\": false") == std::string::npos; }

const std::string oedometer = "cases/oedometer_3d.toml";

}  // namespace

TEST_CASE("A jittered column of water in space keeps its pressure to 1.5 % of rho g H, and hardly moves") {
  const SceneRun run("cases/hydrostatic_column_3d.toml");
  REQUIRE(run.outcome().code == 0);
  CHECK(run.result("pressure_error_rms_ratio") <= 0.015);
  CHECK(run.result("velocity_rms_m_s") <= 0.02);
  CHECK(all_met(run));
  CHECK(run.column("still.pressure_error_max_Pa").front() < 1e-6);
  const std::vector<double> mass = run.column("total.mass_kg");
  CHECK(mass.back() == mass.front());
  // Weight over g of the column: p(bottom) over 1 m2, to the midpoint rule over jittered particles.
  CHECK(mass.front() == near(3.6e6 * std::expm1(1000 * 9.81 * 2 / 3.6e6) / 9.81, 9e-7));
}

TEST_CASE("An upright bar in its first mode has the exact period to 0.2 %, and keeps its swing") {
  const SceneRun run("cases/elastic_bar_3d.toml");
  REQUIRE(run.outcome().code == 0);
  CHECK(run.result("period_s") == near(10, 0.002));
  CHECK(run.result("displacement_first_m") == near(0.11254, 0.007));
  CHECK(run.result("displacement_last_m") / run.result("displacement_first_m") > 0.97);
}

TEST_CASE("A bar along y swings as one along z") {
  const SceneRun upright("cases/elastic_bar_3d.toml", {"time.end=20"});
  const SceneRun level("cases/elastic_bar_3d.toml",
                       {"time.end=20", "grid.upper=[2.5, 27.5, 2.5]", "walls.bottom=slip", "walls.front=no_slip",
                        "bodies.bar.shape.upper=[2.5, 25.0, 2.5]", "bodies.bar.initial_velocity.axis=y",
                        "probes.middle.position=[1.25, 12.5, 1.25]"});
  REQUIRE(level.outcome().code == 0);
  const std::vector<double> z = upright.column("middle.displacement_z_m"), y = level.column("middle.displacement_y_m");
  REQUIRE(z.size() == y.size());
  for (std::size_t k = 0; k < z.size(); ++k) CHECK(std::abs(z[k] - y[k]) < 1e-9);
}

TEST_CASE("An undrained bed under water stays at rest, with K0 in both horizontal directions") {
  const SceneRun run("cases/k0_bed_3d.toml");
  REQUIRE(run.outcome().code == 0);
  CHECK(all_met(run));
  CHECK(run.result("bed.skempton_b_ratio") >= 0.95);
  // The same from one side as from the other.
  CHECK(run.result("horizontal_stress_x_Pa") == near(run.result("horizontal_stress_y_Pa"), 1e-9));
}

TEST_CASE("Drained soil between smooth walls takes nu / (1 - nu) of a load to either side") {
  const SceneRun run(oedometer);
  REQUIRE(run.outcome().code == 0);
  CHECK(all_met(run));
  CHECK(run.result("vertical_stress_Pa") == near(-29.81e3, 0.0005));
  CHECK(run.result("horizontal_stress_x_Pa") == near(-15.886e3, 0.0004));
  CHECK(run.result("horizontal_stress_y_Pa") == near(-15.886e3, 0.0004));
}

TEST_CASE("Undrained soil hands nearly all of a load to its pores, and so to either side") {
  const SceneRun run(oedometer, {"materials.soil.drainage=undrained", "materials.soil.porosity=0.4",
                                 "materials.soil.fluid_bulk_modulus=12e6", "solver.damping_rate=240"});
  REQUIRE(run.outcome().code == 0);
  const double pores = 30e6, Ec = 1.5e6, q = 20e3;
  const double sideways = 0.6 * 9.81e3 + (pores + Ec / 2) / (pores + Ec) * q;
  CHECK(sideways == near(25.410e3, 2e-5));
  CHECK(run.result("vertical_stress_Pa") == near(-29.81e3, 3e-3));
  CHECK(run.result("horizontal_stress_x_Pa") == near(-sideways, 3e-3));
  CHECK(run.result("horizontal_stress_y_Pa") == near(-sideways, 3e-3));
}

TEST_CASE("A run in space writes its frames with three coordinates") {
  const SceneRun run("tests/scenes/run_up_3d.toml", {"time.end=0.001"});
  REQUIRE(run.outcome().code == 0);
  const std::string frame = geodrop::read_file(run.file("particles_000000.vtu"));
  CHECK(frame.find("Name=\"stress\" NumberOfComponents=\"6\"") != std::string::npos);
  CHECK(run.column("water.velocity_z_m_s").front() == near(-0.5, 1e-12));
  CHECK(run.column("water.velocity_y_m_s").front() == 0);
  CHECK(run.column("sand.backmost_m").front() == near(1.375, 1e-12));
  CHECK(run.column("sand.frontmost_m").front() == near(0.125, 1e-12));
  CHECK(run.column("sand.highest_m").front() == near(1.625, 1e-12));
  for (const char* axis : {"x", "y", "z"})
    CHECK(std::abs(run.column(std::string("sand.rotation_") + axis + "_deg").front()) < 1e-6);
}

TEST_CASE("A quarter of a sphere between planes of symmetry starts to fall in water as the whole sphere does") {
  const std::string scene = "cases/verification/sphere_release_3d.toml";
  const SceneRun whole(scene, {"grid.spacing=0.25"});
  const SceneRun quarter(scene,
                         {"grid.spacing=0.25", "grid.upper=[0.0, 0.0, 2.0]", "bodies.water.shape.upper=[0.0, 0.0, 2.0]",
                          "membranes.skin.ends_at=[\"right\", \"back\"]"});
  REQUIRE(quarter.outcome().code == 0);
  CHECK(4 * quarter.column("skin.volume_m3").front() == near(whole.column("skin.volume_m3").front(), 1e-8));
  CHECK(4 * quarter.column("total.mass_kg").front() == near(whole.column("total.mass_kg").front(), 1e-8));
  // Which nodes of the cloth are knots of the pressure hangs on the order of the nodes: other knots, 0.03 %.
  CHECK(quarter.result("initial_acceleration_m_s2") == near(whole.result("initial_acceleration_m_s2"), 1e-3));
}
