// What is probably not what was meant: each doubt is raised by its value and not by the usual one.
#include "doubts/doubts.hpp"
#include "step/effort.hpp"
#include "support/near.hpp"
#include "support/program.hpp"
#include "support/scene_files.hpp"
#include "support/text.hpp"

#include <doctest/doctest.h>
#include <geodrop/reader/scene_reader.hpp>

#include <cmath>

using namespace geodrop;
using namespace geodrop::test;

namespace {

std::string joined(const Scene& scene) {
  std::string text;
  for (const std::string& doubt : doubts(scene)) text += doubt + "\n";
  return text;
}

std::string joined(const std::vector<std::string>& settings, const char* scene) {
  return joined(read_scene(source_path(scene), settings));
}

std::string main_case(const std::vector<std::string>& settings) {
  return joined(settings, "cases/dump_kekerdom_undrained.toml");
}

}  // namespace

TEST_CASE("The shipped cases of design raise no doubt") {
  for (const char* scene :
       {"cases/dump_kekerdom_undrained.toml", "cases/dump_barge_underwater.toml", "cases/geotube_556.toml",
        "cases/geotube_submerged.toml", "cases/two_containers.toml", "cases/sloshing.toml"})
    CHECK_MESSAGE(joined({}, scene) == "", scene);
}

TEST_CASE("Coupled soil around a sharp membrane that does not name it as its bed") {
  const char* scene = "cases/verification/bag_on_coupled_bed.toml";
  CHECK(!contains(joined({}, scene), ".bed does not name"));
  CHECK(contains(joined({"membranes.geotextile.bed=", "membranes.geotextile.bed_friction="}, scene),
                 "membranes.geotextile.bed does not name \"bed\", a coupled soil around"));
}

TEST_CASE("Units: t/m3, kN/m3, kN/m, kPa, MPa, radians are named, with what they would be") {
  CHECK(contains(main_case({"materials.sand.density=1.631"}), "in t/m3 it would be 1631 kg/m3"));
  CHECK(contains(main_case({"materials.subsoil.density=20.0", "bodies.bed.initial_stress={ type = 'zero' }"}),
                 "in kN/m3 it would be 2039 kg/m3"));
  CHECK(contains(main_case({"membranes.geotextile.axial_stiffness=1000.0"}), "in kN/m it would be 1e+06 N/m"));
  CHECK(contains(main_case({"membranes.geotextile.strength=120.0"}), "in kN/m it would be 1.2e+05 N/m"));
  CHECK(contains(main_case({"membranes.geotextile.mass_per_area=630.0"}), "in g/m2 it would be 0.63 kg/m2"));
  CHECK(contains(main_case({"materials.sand.cohesion=5.0", "materials.sand.tension_cutoff=0.0"}),
                 "in kPa it would be 5000 Pa"));
  CHECK(contains(main_case({"materials.sand.friction_angle_deg=0.52", "materials.subsoil.friction_angle_deg=30.0",
                            "bodies.container.initial_stress.effective_pressure=0.0"}),
                 "in radians it would be 29.79 degree"));
  CHECK(contains(main_case({"materials.sand.youngs_modulus=2800.0", "materials.sand.fluid_bulk_modulus=22.5e6"}),
                 "in kPa it would be 2.8e+06 Pa"));
  Scene scene = read_scene(source_path("cases/dump_kekerdom_undrained.toml"));
  for (MaterialSpec& material : scene.materials)
    if (auto* soil = std::get_if<MohrCoulombSpec>(&material.model)) soil->youngs_modulus = 2.8;
  CHECK(contains(joined(scene), "in MPa it would be 2.8e+06 Pa"));
  CHECK(contains(main_case({"membranes.geotextile.slack=5.0"}), "500 % of the drawn length"));
  CHECK(contains(main_case({"materials.water.viscosity=8900.0"}), "water has 1e-3"));
  CHECK(contains(joined({"gravity=[0.0, -981.0]"}, "cases/gravity_column.toml"), "on earth it is -9.81"));
  const std::string light = "materials.water.density=1.5";
  CHECK(contains(joined({light}, "cases/hydrostatic_column.toml"), "t/m3"));
  CHECK_FALSE(contains(joined({light, "gravity=[0.0, 0.0]", "bodies.0.initial_stress={ type = 'zero' }"},
                              "cases/hydrostatic_column.toml"),
                       "t/m3"));
}

TEST_CASE("Water: its surface, its speed of sound, a gap below it") {
  const std::string surface = main_case({"bodies.water.initial_stress.surface=10.0"});
  CHECK(contains(surface, "at 10 m is not where that fluid ends, 13 m"));
  CHECK(contains(main_case({"bodies.bed.initial_stress.fluid_surface=12.0"}), "bodies.bed.initial_stress"));
  // Water in the pores of a bag ends where the bag does, and has the pressure of that around.
  for (const char* bag : {"cases/dump_round_container.toml", "cases/dump_kekerdom_3d.toml"})
    CHECK_FALSE(contains(joined({}, bag), "is not where that fluid ends"));
  CHECK(contains(main_case({"materials.water.sound_speed=20.0"}), "a Mach number of 0.565"));  // sqrt(9.81 * 13) / 20
  const std::string gap = main_case({"bodies.water.shape.lower.1=0.5"});
  CHECK(contains(gap, "\"water\" begins"));
  CHECK(contains(gap, "above \"bed\""));
}

TEST_CASE("Gaps below water and beside it, in the plane and in space; a dam break is none") {
  const std::string shore = main_case({"bodies.water.shape.lower.0=-15.5"});
  CHECK(contains(shore, "\"water\" ends 0.5 m before the end of the domain along x"));
  const auto basin = [](const std::vector<std::string>& more) {
    std::vector<std::string> settings{"grid.upper=[4.0, 3.0, 2.5]", "bodies.water.shape.upper=[4.0, 3.0, 2.0]"};
    settings.insert(settings.end(), more.begin(), more.end());
    return joined(settings, "cases/hydrostatic_column_3d.toml");
  };
  CHECK(basin({}) == "");
  const std::string wall = basin({"bodies.water.shape.lower.1=0.2"});
  CHECK(contains(wall, "\"water\" ends 0.2 m before the end of the domain along y (at x = "));
  CHECK_FALSE(contains(wall, "along x"));
  const std::string ground = basin({"bodies.water.shape.lower.2=0.2"});
  CHECK(contains(ground, "\"water\" begins 0.2 m above the end of the domain (at x = "));
  const std::string rigid =
      "rigid=[{ name = 'quay', shape = { type = 'box', lower = [3.0, -1.0, -1.0], upper = [5.0, "
      "4.0, 4.0] } }]";
  CHECK(contains(basin({rigid, "bodies.water.shape.upper=[2.8, 3.0, 2.0]"}), "before a rigid surface along x"));
  CHECK(basin({"bodies.water.shape.lower.0=2.0"}) == "");                         // a dam break
  CHECK_FALSE(contains(joined({}, "cases/geotube_fluid_3d.toml"), "it will f"));  // its membrane holds it
}

TEST_CASE("Numbers out of scale, and output that fills the disk") {
  CHECK(contains(main_case({"solver.blend_rate=1e6"}), "solver.blend_rate = 1e+06 1/s is out of all scale"));
  CHECK(contains(main_case({"solver.courant=0.9"}), "solver.courant = 0.9 is above 0.5"));
  CHECK(contains(joined({"grid.refine=[]"}, "cases/dump_kekerdom.toml"),
                 "bodies.pore_water.shift moves few particles or none: the body is 2"));
  CHECK_FALSE(contains(joined({}, "cases/dump_kekerdom.toml"), ".shift"));
  CHECK(contains(joined({"bodies.water.shift=false"}, "cases/dump_kekerdom.toml"),
                 "bodies.water.shift_speed acts on nothing: shift is false"));
  const std::string frames = main_case({"output.frame_interval=1e-6"});  // of 7 s
  CHECK(contains(frames, "output.frame_interval = 1e-06 s asks for 7e+06 frames of about "));
  CHECK_FALSE(contains(frames, "GB"));  // the trial of `check` knows how many steps there are
  CHECK(contains(main_case({"output.frame_interval=100.0"}), "longer than the run"));
  CHECK(contains(main_case({"output.history_interval=1e-6"}), "rows of history.csv"));
  Scene far = read_scene(source_path("cases/elastic_bar.toml"));
  far.grid.lower[0] += 1e10;
  far.grid.upper[0] += 1e10;
  CHECK(contains(joined(far), "m from the origin, over 1e9 cells"));
}

TEST_CASE("A body within a membrane has four cells across") {
  const std::string coarse = joined({"grid.spacing=0.5"}, "cases/dump_kekerdom_mixture.toml");
  CHECK(contains(coarse,
                 "bodies.container is 2.03 cells wide: a body within a membrane has to have at least four; "
                 "take grid.spacing = 0.25 [m]"));
  CHECK_FALSE(contains(joined({}, "cases/dump_kekerdom_mixture.toml"), "cells wide"));
  const char* const zone = "grid.refine=[{axis='x',from=-2.0,to=2.0,spacing=0.25}]";
  CHECK_FALSE(contains(joined({"grid.spacing=0.5", zone}, "cases/dump_kekerdom_mixture.toml"), "cells wide"));
  CHECK(contains(
      joined({"grid.spacing=0.5", "grid.refine=[{axis='x',from=-2.0,to=2.0,spacing=0.4}]"},
             "cases/dump_kekerdom_mixture.toml"),
      "2.54 cells wide: a body within a membrane has to have at least four; take a finer zone of grid.refine"));
  CHECK(contains(joined({"bodies.container.shape.semi_axes=[0.6, 0.45]"}, "cases/dump_kekerdom_mixture.toml"),
                 "3.6 cells high"));
  // The bed of dump_kekerdom_skin.toml is one cell deep, in a skin only.
  CHECK_FALSE(
      contains(joined({"grid.spacing=0.5", "bodies.bed.shape.lower=[-8.0,-0.5]"}, "cases/dump_kekerdom_skin.toml"),
               "bodies.bed is"));
}

TEST_CASE("A seed of offsets that are zero is doubted") {
  const char* const scene = "cases/hydrostatic_column.toml";
  CHECK(contains(joined({"bodies.water.jitter=0.0"}, scene),
                 "bodies.water.jitter_seed = 1 changes nothing: bodies.water.jitter is 0"));
  CHECK_FALSE(contains(joined({}, scene), "jitter_seed"));
  CHECK_FALSE(contains(joined({"bodies.water.jitter=0.0", "bodies.water.jitter_seed=0"}, scene), "jitter_seed"));
}

TEST_CASE("The spacing that the doubt about shift advises is accepted, and raises it no more") {
  using Settings = std::vector<std::string>;
  const std::pair<const char*, Settings> cases[] = {
      {"cases/dump_kekerdom.toml", {"grid.refine=[]"}},
      {"cases/verification/fall_free_slip.toml", {"grid.spacing=0.5", "bodies.water.shape.upper.1=1.7"}},
      {"cases/hydrostatic_column_3d.toml", {"bodies.water.shift=true", "bodies.water.shape.upper.2=0.3"}}};
  for (const auto& [scene, settings] : cases) {
    CAPTURE(scene);
    const std::string advised = joined(settings, scene), before = "take grid.spacing = ";
    const std::size_t at = advised.find(before);
    REQUIRE(at != std::string::npos);
    const std::size_t from = at + before.size();
    Settings changed = settings;
    changed.push_back("grid.spacing=" + advised.substr(from, advised.find(' ', from) - from));
    CAPTURE(changed.back());
    CHECK_FALSE(contains(joined(changed, scene), ".shift moves few"));
  }
  const auto in_zone = [](const std::string& spacing) {  // of a body 1.3 m wide
    return joined({"grid.refine=[{axis='x',from=-1.5,to=1.5,spacing=" + spacing + "}]"}, "cases/dump_kekerdom.toml");
  };
  CHECK(contains(in_zone("0.4"),
                 "cells across, and only cells with full neighbours on all sides are evened out; take a "
                 "finer zone of grid.refine"));
  CHECK_FALSE(contains(in_zone("0.0625"), ".shift moves few"));
}

TEST_CASE("Unit weights and densities of the calculators") {
  CHECK(contains(doubt_unit_weight("--unit-weight", 12), "in kN/m3 it would be 1.2e+04 N/m3"));
  CHECK(contains(doubt_unit_weight("--unit-weight", 1.2), "in t/m3 it would be 1.177e+04 N/m3"));
  CHECK(doubt_unit_weight("--unit-weight", 12e3).empty());
  CHECK(contains(doubt_density("--density", 1.99), "1990 kg/m3"));
  CHECK(doubt_density("--density", 1990).empty());
  const Outcome tube = run_program({"geotube", "--perimeter", "9.2", "--unit-weight", "12", "--area", "5.56"});
  CHECK(tube.code == 0);
  CHECK(contains(tube.err, "warning: --unit-weight = 12 N/m3 is unusual"));
}

TEST_CASE("Each calculator doubts densities, stiffness and strength, and the usual ones not") {
  using Words = std::vector<std::string>;
  const auto check_parts = [](const std::string& said, const Words& parts) {
    for (const std::string& part : parts) CHECK_MESSAGE(contains(said, part), part);
  };
  const auto warnings = [](Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run_program(words);
    CHECK(outcome.code == 0);
    return outcome.err;
  };
  const Words fall{"fall", "--semi-axes", "3.3", "0.5", "--terminal-velocity", "3.3", "--fall-height", "13"};
  CHECK(warnings(fall, {"--density", "1631", "--water-density", "1000", "--stiffness", "1e6"}).empty());
  check_parts(warnings(fall, {"--density", "1.6", "--water-density", "1", "--stiffness", "1000"}),
              {"warning: --density = 1.6 kg/m3 is unusual; in t/m3 it would be 1600 kg/m3",
               "warning: --water-density = 1 kg/m3",
               "warning: --stiffness = 1000 N/m is unusual; in kN/m it would be 1e+06 N/m"});
  const Words release{"release", "--perimeter", "18.3", "--area", "10.8", "--opening-width", "3"};
  CHECK(warnings(release, {"--density", "1990", "--water-density", "0", "--strength", "120e3"}).empty());
  check_parts(warnings(release, {"--density", "1.99", "--water-density", "1", "--strength", "120"}),
              {"warning: --density = 1.99 kg/m3", "warning: --water-density = 1 kg/m3",
               "warning: --strength = 120 N/m is unusual; in kN/m it would be 1.2e+05 N/m"});
  const Words tube{"geotube", "--perimeter", "9.2", "--unit-weight", "12e3", "--area", "5.56"};
  CHECK(warnings(tube, {"--stiffness", "1e6", "--strength", "120e3"}).empty());
  const Outcome rests = run_program({"geotube", "--perimeter", "9.2", "--unit-weight", "12e3", "--area", "5.56",
                                     "--stiffness", "1000", "--strength", "120"});
  CHECK(rests.code == 2);  // so soft a tube cannot be, and the doubt says why
  check_parts(rests.err, {"warning: --stiffness = 1000 N/m", "warning: --strength = 120 N/m"});
}

TEST_CASE("The effort of a run comes from a trial; check tells doubts and effort, a run keeps its doubts") {
  const Scene scene = read_scene(source_path("cases/gravity_column.toml"));
  const Effort effort = estimate_effort(scene, 1);
  CHECK(effort.particles == 640);
  CHECK(effort.steps > 1000);
  CHECK(effort.seconds > 0);
  CHECK(effort.output_bytes == near(0.7 * 11.01 * 640 * 130, 1e-6));  // a compressed frame each 0.1 s of 1.001 s
  const std::vector<std::string> words{"check", source_path("cases/gravity_column.toml"),
                                       "--set", "materials.soil.density=2.0",
                                       "--set", "materials.soil.youngs_modulus=1e4"};
  const Outcome check = run_program(words);
  CHECK(check.code == 0);
  CHECK(contains(check.out, "no mistakes found; 1 body, 0 membranes\n"));
  CHECK(contains(check.out, "a run: 640 particles"));
  CHECK(contains(effort_in_words({.particles = 640, .steps = 15700}), "about 15700 steps"));
  const Outcome broken =
      run_program({"check", source_path("cases/gravity_column.toml"), "--set", "gravity=[0.0,-1e9]"});
  CHECK(contains(broken.out, "a run: its first steps break: "));
  const SceneRun run("cases/dump_kekerdom_mixture.toml",
                     {"grid.spacing=0.5", "time.end=0.01", "membranes.geotextile.strength=120.0"});
  CHECK(contains(run.summary(), "membranes.geotextile.strength = 120 N/m is unusual"));
}
