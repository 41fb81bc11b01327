// Stress at the start: the still, weakly compressible fluid, K0 soil under water, a bag at the water's pressure.
#include <doctest/doctest.h>
#include <geodrop/step/pipeline.hpp>

#include "solutions/initial_stress.hpp"
#include "support/near.hpp"
#include "support/scene_files.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

/// 13 m of water over 2 m of subsoil as in the reference table (g = 9.81, gamma_soil = 20 kN/m3, K0 = 0.5).
Scene dump_scene(double bulk_modulus, decltype(MohrCoulombSpec::pores) pores) {
  Scene scene;
  scene.grid.lower = {0, -2};
  scene.grid.upper = {2, 14};
  scene.grid.spacing = 1;
  scene.walls.lower.assign(2, WallKind::slip);
  scene.walls.upper.assign(2, WallKind::slip);
  scene.gravity = {0, -9.81};
  scene.time.end = 1;
  scene.materials = {{"water", NewtonianSpec{1000, bulk_modulus, 0}, {}},
                     {"soil", MohrCoulombSpec{20000 / 9.81, 1e7, 1.0 / 3, 0, 30, 0, 0, pores}, {}}};
  BodySpec water, bed;
  water.name = "water";
  water.material = "water";
  water.shape = BoxShape{{0, 0}, {2, 13}};
  water.initial_stress = HydrostaticSpec{"water", 13};
  bed.name = "bed";
  bed.material = "soil";
  bed.shape = BoxShape{{0, -2}, {2, 0}};
  bed.initial_stress = K0StressSpec{0, 0.5, HydrostaticSpec{"water", 13}};
  water.initial_velocity = bed.initial_velocity = UniformVelocitySpec{{0, 0}};
  scene.bodies = {water, bed};
  return scene;
}

/// Value of `field` at height y, between the particles of two rows that lie on either side.
double at_height(const Body<2>& body, const Array<double>& field, double y) {
  double below = -1e9, above = 1e9, low = 0, high = 0;
  for (std::size_t p = 0; p < body.size(); ++p) {
    const double yp = body.x[1][p];
    if (yp <= y && yp > below) below = yp, low = field[p];
    if (yp > y && yp < above) above = yp, high = field[p];
  }
  return low + (high - low) * (y - below) / (above - below);
}

}  // namespace

TEST_CASE("Subsoil at rest 1 m below 13 m of water has the stresses of the reference table") {
  // u = 137.34, sigma'_v = 10.19, sigma'_h = 5.095 kPa. Real water is 3e-5 denser at the bed than the table's.
  const State<2> state = build_state<2>(dump_scene(2.13e9, UndrainedSpec{0.4, 2.13e9}));
  const Body<2>& bed = state.bodies[1];
  CHECK(at_height(bed, bed.pore_pressure, -1) == near(137.34e3, 8e-5));
  CHECK(at_height(bed, bed.stress[1], -1) == near(-10.19e3, 1e-9));
  CHECK(at_height(bed, bed.stress[0], -1) == near(-5.095e3, 1e-9));
  CHECK(at_height(bed, bed.stress[2], -1) == near(-5.095e3, 1e-9));
  CHECK(at_height(bed, bed.stress[3], -1) == 0);
  for (const double J : bed.J) CHECK(J == 1);
}

TEST_CASE("Drained soil carries the water's pressure in its skeleton: the total stress is that of the table") {
  const State<2> state = build_state<2>(dump_scene(2.13e9, {}));
  const Body<2>& bed = state.bodies[1];
  CHECK(bed.pore_pressure.empty());
  CHECK(at_height(bed, bed.stress[1], -1) == near(-147.53e3, 7e-5));
  CHECK(at_height(bed, bed.stress[0], -1) == near(-142.435e3, 8e-5));
}

TEST_CASE("K0 soil without water carries its whole weight") {
  Scene scene = dump_scene(2.13e9, {});
  scene.bodies[1].initial_stress = K0StressSpec{0, 0.4, {}};
  const Body<2> bed = build_state<2>(scene).bodies[1];
  CHECK(at_height(bed, bed.stress[1], -1) == near(-20e3, 1e-9));
  CHECK(at_height(bed, bed.stress[0], -1) == near(-8e3, 1e-9));
}

TEST_CASE("Pressure of a still fluid balances its own growing weight: dp/dy = -rho g") {
  const Scene scene = dump_scene(3.6e6, {});  // c = 60 m/s
  const HydrostaticSpec still{"water", 13};
  CHECK(still_fluid_pressure(scene, still, 13) == 0);
  CHECK(still_fluid_pressure(scene, still, 13.5) == 0);
  for (const double y : {0.1, 5.0, 12.9}) {
    constexpr double d = 1e-3;
    const double slope =
        (still_fluid_pressure(scene, still, y + d) - still_fluid_pressure(scene, still, y - d)) / (2 * d);
    const double density = 1000 * (1 + still_fluid_pressure(scene, still, y) / 3.6e6);
    CHECK(slope == near(-density * 9.81, 1e-9));
  }
}

TEST_CASE("Particles of the still fluid have its pressure, and together the mass that the bottom bears") {
  for (const double K : {3.6e6, 2.13e9}) {
    const Scene scene = dump_scene(K, {});
    const Body<2> water = build_state<2>(scene).bodies[0];
    double mass = 0;
    for (std::size_t p = 0; p < water.size(); ++p) {
      const double expected = K * std::expm1(1000 * 9.81 * (13 - water.x[1][p]) / K);
      CHECK(mean_pressure(water, p) == near(expected, 1e-9));
      CHECK(water.volume(p) == near(0.25, 1e-12));
      mass += water.mass[p];
    }
    // The exact weight over 2 m is p(bottom) 2 m / g; midpoints of 0.5 m slabs miss next to nothing of it.
    CHECK(mass * 9.81 / 2 == near(still_fluid_pressure(scene, {"water", 13}, 0), 2e-7));
  }
}

TEST_CASE("A bag at the fluid's pressure: isotropic, in the skeleton if drained, in the pores if not") {
  for (const auto& [undrained, effective] : {std::pair{false, 0.0}, {true, 0.0}, {true, 4000.0}}) {
    Scene scene =
        dump_scene(3.6e6, undrained ? decltype(MohrCoulombSpec::pores)(UndrainedSpec{0.4, 2e9}) : std::monostate{});
    scene.bodies[1].initial_stress = FluidPressureSpec{{"water", 13}, effective};
    const Body<2> bag = build_state<2>(scene).bodies[1];
    for (std::size_t p = 0; p < bag.size(); ++p) {
      const double expected = still_fluid_pressure(scene, {"water", 13}, bag.x[1][p]);
      for (int c = 0; c < 3; ++c)
        CHECK(bag.stress[c][p] == within(-effective - (undrained ? 0 : expected), 1e-12 * expected));
      CHECK(bag.stress[3][p] == 0);
      CHECK(mean_pressure(bag, p) == near(expected + effective, 1e-12));
      CHECK(bag.mass[p] == near(20000 / 9.81 * 0.25, 1e-12));
    }
  }
}

TEST_CASE("An enclosed fluid starts from the pressure that the scene tells, its weight taken apart or not") {
  const std::string tube = source_path("tests/scenes/tube.toml");
  const State<2> zero = build_state<2>(read_scene(tube));
  for (std::size_t p = 0; p < zero.bodies[0].size(); ++p) CHECK(std::abs(mean_pressure(zero.bodies[0], p)) < 1e-8);
  const Scene scene = read_scene(tube, {"bodies.fluid.initial_stress={type='hydrostatic',fluid='slurry',surface=2.0}"});
  const State<2> still = build_state<2>(scene);
  const Body<2>& fluid = still.bodies[0];
  REQUIRE(fluid.size() > 1000);
  constexpr double K = 1200.0 * 100 * 100;
  double highest = 0;
  for (std::size_t p = 0; p < fluid.size(); ++p) {
    const double depth = 2 - fluid.x[1][p];
    CHECK(mean_pressure(fluid, p) == near(K * std::expm1(1200 * 9.81 * depth / K), 1e-10));
    highest = std::max(highest, fluid.x[1][p]);
  }
  // What the volume ratio holds is what is left of it without the weight below the highest particle.
  CHECK(fluid.weightless_level == highest);
  CHECK(fluid.unit_weight == near(1200 * 9.81, 1e-14));
  for (std::size_t p = 0; p < fluid.size(); ++p)
    CHECK(K * (1 / fluid.J[p] - 1) == near(mean_pressure(fluid, p) - 1200 * 9.81 * (highest - fluid.x[1][p]), 1e-9));
}
