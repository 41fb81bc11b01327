// A scene's values as they come out of the reader, and the scene as run.
#include "base/units.hpp"
#include "measure/probes/probes.hpp"
#include "support/near.hpp"
#include "support/scene_files.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include <limits>
#include <variant>

using namespace geodrop;
using namespace geodrop::test;

namespace {

const std::string every_key = source_path("tests/reader/every_key.toml");

/// Two scenes from different files: only positions, path and the text as run may differ.
Scene without_places(Scene scene) {
  const auto clear = [](auto& list) {
    for (auto& element : list) element.at = {};
  };
  clear(scene.grid.refine);
  clear(scene.materials);
  clear(scene.bodies);
  clear(scene.membranes);
  clear(scene.rigid);
  clear(scene.contacts);
  clear(scene.still_fluids);
  clear(scene.anchors);
  clear(scene.viscous_boundaries);
  clear(scene.silent_sides);
  clear(scene.stages);
  clear(scene.pumps);
  clear(scene.exact);
  clear(scene.probes);
  clear(scene.results);
  clear(scene.expect);
  clear(scene.verify);
  clear(scene.variants);
  scene.file.clear();
  scene.as_run.clear();
  return scene;
}

template <class Model>
const Model& model_of(const Scene& scene, const std::string& name) {
  for (const MaterialSpec& material : scene.materials) {
    if (material.name == name) return std::get<Model>(material.model);
  }
  throw std::out_of_range(name);
}

}  // namespace

TEST_CASE("numerics as written") {
  const Scene scene = read_scene(every_key);
  CHECK(scene.file == every_key);
  CHECK(scene.title == "Every key");
  CHECK(scene.dimension == 2);
  CHECK(scene.gravity == Point{0, -9.81});
  CHECK(scene.grid.upper == Point{10, 10});
  CHECK(scene.grid.spacing == 0.5);
  REQUIRE(scene.grid.refine.size() == 1);
  const RefineSpec& zone = scene.grid.refine[0];
  CHECK(zone == RefineSpec{0, 4.0, 6.0, 0.04, 1.2, zone.at});
  CHECK(zone.at.line > 200);
  CHECK(scene.walls.lower == std::vector{WallKind::slip, WallKind::no_slip});  // left, bottom
  CHECK(scene.walls.upper == std::vector{WallKind::no_slip, WallKind::slip});  // right, top
  CHECK(scene.solver == SolverSpec{Transfer::blend, 10.0, 0.4, 0.0, MassMatrix::lumped, Weight::particle, true});
  CHECK(scene.time.end == 2.0);
  CHECK(scene.output == OutputSpec{0.1, 0.01, true, {"velocity", "stress"}});
  CHECK(scene.checkpoints == CheckpointSpec{60.0, 0.5});
}

TEST_CASE("materials as written; a sound speed becomes a bulk modulus") {
  const Scene scene = read_scene(every_key);
  REQUIRE(scene.materials.size() == 11);
  CHECK(model_of<NewtonianSpec>(scene, "water") == NewtonianSpec{1000, 3.6e6, 1e-3});
  CHECK(model_of<NewtonianSpec>(scene, "oil").bulk_modulus == 1e9);
  CHECK(model_of<NewtonianSpec>(scene, "oil").tension_cutoff == 1e5);
  CHECK(model_of<LinearElasticSpec>(scene, "steel") == LinearElasticSpec{7800, 2e11, 0.3});
  const auto& sand = model_of<MohrCoulombSpec>(scene, "sand");
  CHECK(sand == MohrCoulombSpec{1631, 2.8e6, 0.333, 1e3, 30, 5, 100, {}});
  CHECK(model_of<MohrCoulombSpec>(scene, "clay").void_memory);
  CHECK(*model_of<MohrCoulombSpec>(scene, "clay").undrained() == UndrainedSpec{0.4, 80e6});
}

TEST_CASE("grains, water and gas become a density and a pore fluid, by hand") {
  const Scene scene = read_scene(every_key);
  // 0.6 2650 + 0.4 0.2 1000
  CHECK(model_of<MohrCoulombSpec>(scene, "fill").density == near(1670, 1e-12));
  CHECK_FALSE(model_of<MohrCoulombSpec>(scene, "fill").undrained());
  const auto& silt = model_of<MohrCoulombSpec>(scene, "silt");
  CHECK(silt.density == 1950);
  REQUIRE(silt.undrained());
  CHECK(silt.undrained()->porosity == 0.4);
  CHECK(silt.undrained()->gas == PoreGasSpec{2.13e9, 2e5, 1e5});
  // 1 / (0.9 / 2.13e9 + 0.1 / 2e5): far below 20 K' n, which only a fluid without gas is held to
  CHECK(silt.undrained()->fluid_bulk_modulus == near(1.998311e6, 4e-7));
  const std::vector<std::string> undrained{"materials.fill.drainage=undrained", "materials.fill.saturation=1.0",
                                           "materials.fill.water_bulk_modulus=2.13e9",
                                           "materials.fill.gas_pressure=2e5"};
  const Scene saturated = read_scene(every_key, undrained);
  CHECK(model_of<MohrCoulombSpec>(saturated, "fill").density == near(1990, 1e-12));
  CHECK(model_of<MohrCoulombSpec>(saturated, "fill").undrained()->fluid_bulk_modulus == near(2.13e9, 1e-12));
  const Scene again = read_scene(
      every_key, {"materials.fill.grain_density=", "materials.fill.density=1670.0",
                  "materials.fill.porosity=", "materials.fill.saturation=", "materials.fill.fluid_density="});
  CHECK(model_of<MohrCoulombSpec>(again, "fill") == model_of<MohrCoulombSpec>(scene, "fill"));
}

TEST_CASE("silent sides as written") {
  const Scene scene = read_scene(every_key);
  REQUIRE(scene.silent_sides.size() == 1);
  SilentSideSpec side = scene.silent_sides[0];
  side.at = {};
  CHECK(side == SilentSideSpec{"open_sea", "sea", SilentSideSpec::Side::left, 2, 20, 10, {}});
}

TEST_CASE("bodies as written") {
  const Scene scene = read_scene(every_key);
  REQUIRE(scene.bodies.size() == 12);
  const BodySpec &sea = scene.bodies[0], &bed = scene.bodies[1], &bag = scene.bodies[2], &wedge = scene.bodies[3],
                 &bar = scene.bodies[4];
  CHECK(sea.shape == Shape{BoxShape{{0, 2}, {10, 7}}});
  CHECK(sea.minus == std::vector<std::string>{"bag"});
  CHECK(sea.particles_per_cell_axis == 3);
  CHECK(sea.jitter == 0.1);
  CHECK(sea.jitter_seed == 7);
  CHECK(sea.shift);
  CHECK(sea.shift_speed == 0.1);
  CHECK(sea.initial_velocity == InitialVelocity{UniformVelocitySpec{{0, 0}}});
  CHECK(sea.initial_stress == InitialStress{HydrostaticSpec{"water", 7}});
  CHECK(sea.at.line == 169);
  CHECK(bed.shape == Shape{HalfPlaneShape{{0, 2}, {0, 3}}});
  CHECK(bed.initial_stress == InitialStress{K0StressSpec{2, 0.5, HydrostaticSpec{"water", 7}}});
  CHECK(bag.shape == Shape{EllipseShape{{5, 4.5}, {0.6, 1.5}, 10}});
  CHECK(bag.layers == 12);
  CHECK(bag.pressure == PressureSupport::cell);
  CHECK(bag.initial_stress == InitialStress{FluidPressureSpec{{"water", 7}, 2000}});
  CHECK(wedge.shape == Shape{PolygonShape{{{1, 8}, {3, 8}, {1, 9.5}}}});
  CHECK(wedge.pressure == PressureSupport::particle);
  CHECK(wedge.initial_velocity == InitialVelocity{UniformVelocitySpec{{0, -1}}});
  CHECK(wedge.initial_stress == InitialStress{ZeroStressSpec{}});
  CHECK(bar.initial_velocity == InitialVelocity{BarFirstModeSpec{0.1, 1, 25}});
  const LinearVelocitySpec spin{{{0, -1}, {1, 0}}, {9.5, 9.25}};
  CHECK(scene.bodies[5].initial_velocity == InitialVelocity{spin});
  CHECK(scene.bodies[6].initial_velocity == InitialVelocity{PulseVelocitySpec{{0, 0.1}, 0, {5.25, 9.5}, 0.4}});
}

TEST_CASE("rigid bodies, contacts, still fluids and pumps as written") {
  const Scene scene = without_places(read_scene(every_key));
  const CapsuleShape wall{{9, 9}, {9.5, 9.5}, 0.05}, disc{{9, 9}, {9, 9}, 0.05};
  CHECK(scene.rigid == std::vector<RigidSpec>{{"ground", HalfPlaneShape{{0, 0.5}, {0, 2}}, {}, {}},
                                              {"wall", wall, HingeMotionSpec{{9, 9.5}, 0.1, 40}, {}},
                                              {"ram", disc, TranslationMotionSpec{{0, -1}}, {}},
                                              {"wheel", disc, TableMotionSpec{{0, 1}, {9, 9}, {0, 90}, {}}, {}},
                                              {"lift", disc, TableMotionSpec{{0, 1}, {}, {}, {{0, 0}, {0, 1}}}, {}},
                                              {"block", BoxShape{{9, 9}, {9.2, 9.1}}, {}, {}},
                                              {"ramp", PolygonShape{{{9, 9}, {9.2, 9}, {9.1, 9.1}}}, {}, {}},
                                              {"bent", PolylineShape{{{9, 9}, {9.2, 9}, {9.3, 9.1}}, 0.05}, {}, {}}});
  CHECK(scene.anchors == std::vector<AnchorSpec>{{"nail", "mat", {1, 8}, HeldSpec{}, {}},
                                                 {"rope", "mat", {2, 8}, AnchorLineSpec{{2.5, 9.5}, 1e4, 1.5}, {}}});
  CHECK(scene.contacts == std::vector<ContactSpec>{{{"geotextile", "ground"}, 0.3, 0.5, 0.25, {}}});
  CHECK(scene.still_fluids == std::vector<StillFluidSpec>{{"sleeve", "water", StillFluidSpec::Side::outside, 7, {}}});
  CHECK(scene.viscous_boundaries == std::vector<ViscousBoundarySpec>{{"edge", "wedge", {1, 8}, {3, 8}, 10, {}}});
  CHECK(scene.pumps == std::vector<PumpSpec>{{"sea", 0.1, 0.5, 1.5, {}}});
}

TEST_CASE("membranes, probes and results as written") {
  const Scene scene = read_scene(every_key);
  REQUIRE(scene.membranes.size() == 4);
  CHECK(scene.membranes[0].points.empty());
  CHECK(scene.membranes[0].axial_stiffness == 1e6);
  CHECK(scene.membranes[0].slack == 0.01);
  CHECK(scene.membranes[0].segments_per_cell == 3);
  CHECK(scene.membranes[2].contents_friction == -1);
  CHECK(std::isinf(scene.membranes[1].contents_friction));
  CHECK(scene.membranes[1].gauge_length == 0.2);
  CHECK(scene.membranes[0].contents_friction == 0.3);
  CHECK(scene.membranes[0].gauge_length == 0.5);
  CHECK(scene.membranes[0].interface == Interface::sharp);
  CHECK(scene.membranes[0].shear == Shear::wall_law);
  CHECK(scene.membranes[0].wall_friction == 0.01);
  CHECK(scene.membranes[0].drag_coefficient == 1.0);
  CHECK(scene.membranes[1].interface == Interface::mixture);
  CHECK(scene.membranes[2].shear == Shear::rough_wall);
  CHECK(scene.membranes[2].roughness == 0.003);
  CHECK_FALSE(scene.membranes[1].closed);
  CHECK(scene.membranes[1].points == std::vector<Point>{{1, 8}, {3, 8}});
  REQUIRE(scene.probes.size() == 10);
  CHECK(std::get<TracerSpec>(scene.probes[0].probe) == TracerSpec{"point", {5, 4.5}});
  const auto& still = std::get<HydrostaticProbeSpec>(scene.probes[1].probe);
  CHECK(still.name == "still");
  CHECK(still.body == "sea");
  CHECK(still.still == HydrostaticSpec{"water", 7});
  CHECK(still.tips_of == "geotextile");
  CHECK(std::get<ExactProbeSpec>(scene.probes[2].probe) == ExactProbeSpec{"error", "pad"});
  CHECK(std::get<GeotubeProbeSpec>(scene.probes[3].probe) == GeotubeProbeSpec{"tube", "geotextile", "water", 1.0});
  CHECK(std::get<SectionProbeSpec>(scene.probes[4].probe) == SectionProbeSpec{"middle", "wedge", 2.0});
  CHECK(std::get<SpanProbeSpec>(scene.probes[5].probe) == SpanProbeSpec{"under", "mat", {1, 8}, {3, 8}});
  CHECK(std::get<StressProbeSpec>(scene.probes[6].probe) == StressProbeSpec{"squeeze", "bed"});
  CHECK(std::get<FrontProbeSpec>(scene.probes[7].probe) == FrontProbeSpec{"heap", "bed", 0.02});
  CHECK(std::get<ExtremesProbeSpec>(scene.probes[8].probe) == ExtremesProbeSpec{"worst", "bed"});
  CHECK(std::get<RegionProbeSpec>(scene.probes[9].probe) == RegionProbeSpec{"box", "water", {1, 1}, {2, 3}});
  REQUIRE(scene.stages.size() == 2);
  CHECK(scene.stages[0].damping_rate == 2);
  CHECK(scene.stages[0].damping_ramp == 0.01);
  CHECK(scene.stages[1].from == 0.02);
  CHECK(scene.stages[1].places == std::vector<std::string>{"bar"});
  CHECK(scene.stages[1].moves == std::vector<std::string>{"wall"});
  CHECK(scene.stages[1].removes == std::vector<std::string>{"ram"});
  REQUIRE(scene.exact.size() == 7);
  CHECK(scene.exact[0].body == "pad");
  CHECK(std::get<AxisAlignedMmsSpec>(scene.exact[0].solution) == AxisAlignedMmsSpec{0.05, 1.0});
  CHECK(std::get<TaylorGreenSpec>(scene.exact[1].solution) == TaylorGreenSpec{1.0, 1.0});
  CHECK(std::get<UniformMotionSpec>(scene.exact[2].solution) == UniformMotionSpec{{0.0, -1.0}, {1.1, 1.0}});
  CHECK(std::get<BarFirstModeSpec>(scene.exact[3].solution) == BarFirstModeSpec{0.1, 1, 25.0});
  CHECK(std::get<GeneralizedVortexSpec>(scene.exact[4].solution) == GeneralizedVortexSpec{0.1, 1.0, 0.25, 3.0});
  CHECK(std::get<OscillatingDropSpec>(scene.exact[5].solution) == OscillatingDropSpec{0.5, 2.0, 1.5});
  CHECK(std::get<LambDipoleSpec>(scene.exact[6].solution) == LambDipoleSpec{0.5, 0.1, {8.25, 7.5}});
  REQUIRE(scene.results.size() == 11);
  using enum Reduction;
  const std::vector<Reduction> kinds{last,           min,       max,  mean, rms, percentile, period, first_time_below,
                                     rms_difference, r_squared, slope};
  for (std::size_t i = 0; i < kinds.size(); ++i) CHECK(scene.results[i].reduce == kinds[i]);
  CHECK(scene.results[0].from == 0.5);
  CHECK(scene.results[0].to == 1.5);
  CHECK(scene.results[0].scale == -1);
  CHECK(scene.results[1].from == 0);
  CHECK(scene.results[1].to == std::numeric_limits<double>::infinity());
  CHECK(scene.results[5].percentile == 95);
  CHECK(scene.results[7].level == 2);
  CHECK(scene.results[8].times == std::vector{0.5, 1.0});
  CHECK(scene.results[8].values == std::vector{4.0, 3.0});
  CHECK(scene.results[9].against == "energy.kinetic_J");
  CHECK(scene.results[10].after == "landing_s");
  CHECK(scene.results[10].before == "landing_s");
  REQUIRE(scene.expect.size() == 2);
  CHECK(scene.expect[1].expected == 4.5);
  CHECK(scene.expect[1].source == "computed");
}

TEST_CASE("what verify judges by, and the runs that it makes, as written; without them none") {
  const Scene scene = without_places(read_scene(every_key));
  VerifySpec verify;
  verify.result = "last_m_s";
  verify.over = "percentile_m_s";
  verify.what = "velocity at the end";
  verify.expected = 3.3;
  verify.kind = ReferenceKind::regression;
  verify.scale = 2;
  verify.target = 0.01;
  verify.quick_target = 0.02;
  verify.least_order = 1.5;
  verify.source = "measured";
  verify.shortfall = "not tried yet";
  verify.guard = 0.05;
  verify.loose = "tried once";
  CHECK(scene.verify == std::vector<VerifySpec>{verify});
  const VariantSpec coarse{"coarse", {"grid.spacing=1.0"}, VerifyMode::full, true, {"last_m_s"}, "no volume left", {}};
  CHECK(scene.variants == std::vector<VariantSpec>{coarse});
  const Scene defaults = read_scene(every_key, {"variants.0.set=", "variants.0.in=", "variants.0.control=",
                                                "variants.0.of=", "variants.0.breaks=", "verify.0.kind="});
  CHECK(defaults.verify.at(0).kind == ReferenceKind::reference);
  CHECK(defaults.variants.at(0).set.empty());
  CHECK(defaults.variants.at(0).in == VerifyMode::both);
  CHECK_FALSE(defaults.variants.at(0).control);
}

TEST_CASE("the scene as run reads back as the same scene") {
  const std::vector<std::string> paths{every_key, source_path("cases/hydrostatic_column.toml"),
                                       source_path("cases/gravity_column.toml"), source_path("cases/elastic_bar.toml"),
                                       source_path("cases/dump_kekerdom_mixture.toml")};
  for (const std::string& path : paths) {
    CAPTURE(path);
    const Scene scene = read_scene(path, {"title=\"a \\\"quoted\\\" back\\\\slash\\n\"", "grid.spacing=0.05"});
    const TemporaryDirectory directory;
    const std::filesystem::path copy = directory / "scene.toml";
    std::ofstream(copy) << scene.as_run;
    const Scene again = read_scene(copy);
    CHECK(without_places(again) == without_places(scene));
    CHECK(again.as_run == scene.as_run);
    CHECK(again.grid.spacing == 0.05);
  }
}

TEST_CASE("units are the ends of names") {
  CHECK(unit_of_name("fall_velocity_max_m_s") == "m/s");
  CHECK(unit_of_name("container.velocity_y_m_s") == "m/s");
  CHECK(unit_of_name("geotextile.seepage_m2_s") == "m2/s");
  CHECK(unit_of_name("gate.flow_x_m3_s") == "m3/s");
  CHECK(unit_of_name("tension_N_m") == "N/m");
  CHECK(unit_of_name("initial_acceleration_m_s2") == "m/s2");
  CHECK(unit_of_name("density_kg_m3") == "kg/m3");
  CHECK(unit_of_name("height_m") == "m");
  CHECK(unit_of_name("pressure_error_ratio") == "1");
  CHECK(unit_of_name("mean_stress_r_squared") == "1");
  CHECK(unit_of_name("height").empty());
  CHECK(unit_of_name("_m").empty());
}
