// What scenes with a sharp interface must have.
#include <doctest/doctest.h>

#include "support/scene_files.hpp"

using namespace geodrop;

namespace {

void check_refused(const std::vector<std::string>& overrides, const std::string& says) {
  const std::string error = scene_error(source_path("cases/dump_kekerdom_undrained.toml"), overrides);
  CAPTURE(error);
  CHECK(error.find(says) != std::string::npos);
}

}  // namespace

TEST_CASE("A sharp interface needs cells that are knot spans, their pressure on both sides, and a closed membrane") {
  CHECK(scene_error(source_path("cases/dump_kekerdom.toml")).empty());
  const std::string zones = "grid.refine=[{axis='x',from=-2.0,to=2.0,spacing=0.125}]";
  CHECK(scene_error(source_path("cases/dump_kekerdom.toml"), {zones}).empty());
  const std::string key = "membranes.geotextile.interface: found \"sharp\" ";
  check_refused({"grid.basis=gimp"}, key + "on a grid whose cells are not knot spans");
  check_refused({"solver.transfer=musl"}, key + "with solver.transfer = \"musl\"");
  check_refused({"bodies.container.pressure=particle"}, key + "around a body whose pressure is not that of cells");
  check_refused({"bodies.water.pressure=particle", "bodies.bed.pressure=particle"}, key + "with nothing around");
  // Water in the pores inside is not around.
  const std::string bag = scene_error(
      source_path("cases/dump_kekerdom.toml"),
      {"bodies.water.pressure=particle", "bodies.bed.pressure=particle", "bodies.bed.implicit_pore_pressure=false"});
  CHECK(bag.find(key + "with nothing around") != std::string::npos);
}

TEST_CASE("The consistent mass matrix is that beside membranes with a sharp one, and only then") {
  check_refused({"solver.mass_matrix=consistent"},
                "solver.mass_matrix: found \"consistent\" with a sharp membrane, whose rows are of the lumped mass; "
                "allowed: \"lumped\" or \"consistent_at_membranes\"");
  CHECK(scene_error(source_path("cases/ellipse_release.toml"), {"solver.mass_matrix=consistent_at_membranes"}).empty());
  const std::string none =
      scene_error(source_path("cases/sloshing.toml"), {"solver.mass_matrix=consistent_at_membranes"});
  CHECK(none.find("without a membrane with interface = \"sharp\"; allowed: \"lumped\" or \"consistent\"") !=
        std::string::npos);
}

TEST_CASE("Nothing but air may be around where water flows out into it") {
  const std::string scene = source_path("cases/verification/seepage_into_air.toml");
  CHECK(scene_error(scene).empty());
  const std::string tight = scene_error(scene, {"membranes.fabric.permittivity=0.0"});
  CHECK(tight.find("membranes.fabric.interface: found \"sharp\" with nothing around") != std::string::npos);
}

TEST_CASE("In space: a body inside, pressures of cells") {
  const std::string scene = source_path("cases/verification/sphere_release_3d.toml"), membrane = "membranes.skin.";
  const auto check = [&](const std::vector<std::string>& overrides, const std::string& says) {
    const std::string error = scene_error(scene, overrides);
    CAPTURE(error);
    CHECK(error.find(says) != std::string::npos);
  };
  CHECK(scene_error(scene).empty());
  const std::string key = membrane + "interface: found \"sharp\" ";
  CHECK(scene_error(scene, {"grid.refine=[{axis='x',from=-1.0,to=1.0,spacing=0.125}]"}).empty());
  check({"bodies.ball.shape={type='ellipsoid',centre=[0.0,0.0,0.0],semi_axes=[1.0,1.0,1.0]}"},
        key + "on an empty membrane");
  check({"bodies.ball.pressure=particle"}, key + "around a body whose pressure is not that of cells");
  check({"bodies.water.pressure=particle"}, key + "with nothing around");
  check({membrane + "shear=wall_law"}, membrane + "wall_friction");
  check({membrane + "bed=bad"}, membrane + "bed: found \"bad\"");
  check({membrane + "bed_friction=0.5"}, membrane + "bed_friction: found 0.5 without a bed");
  check({membrane + "drag_coefficient=1.2"}, membrane + "drag_coefficient");
}

TEST_CASE("A sharp membrane goes all around its body, once") {
  const std::string block = source_path("cases/verification/floating_block.toml");
  const auto told = [&](const std::string& points) { return scene_error(block, {"membranes.skin.points=" + points}); };
  CHECK(told("[[-1.0,0.8],[1.0,0.8],[1.0,1.8],[-1.0,1.8]]").empty());
  CHECK(told("[[-1.0,1.8],[1.0,1.8],[1.0,0.8],[-1.0,0.8]]").empty());
  CHECK(told("[[-1.0,0.8],[1.0,0.8],[1.0,1.8]]").find("a line around 1 m2 of \"block\", which has 2") !=
        std::string::npos);
  CHECK(told("[[-1.0,0.8],[1.0,1.8],[1.0,0.8],[-1.0,1.8]]").find("a line that crosses itself") != std::string::npos);
  CHECK(told("[[-1.0,0.8],[1.0,0.8],[0.0,0.8]]").find("a line around 0 m2") != std::string::npos);
}

TEST_CASE("A bed is a body that is there, and friction is on a bed") {
  check_refused({"membranes.geotextile.bed=bad"}, "membranes.geotextile.bed: found \"bad\"");
  check_refused({"membranes.geotextile.bed=container"},
                "membranes.geotextile.bed: found \"container\", which is inside");
  check_refused({"membranes.geotextile.bed=\"\""}, "membranes.geotextile.bed_friction: found 0.5 without a bed");
  check_refused({"membranes.geotextile.interface=mixture"}, "membranes.geotextile.bed");
}

TEST_CASE("What hinders water is said, once, and where there is water") {
  const std::string membrane = "membranes.geotextile.";
  check_refused({membrane + "shear=sticky"}, membrane + "shear: found \"sticky\"");
  check_refused({membrane + "wall_friction=0.004"}, membrane + "wall_friction");
  check_refused({membrane + "shear=wall_law"}, membrane + "wall_friction");
  check_refused({membrane + "shear=none"}, membrane + "roughness");
  check_refused({membrane + "shear=rough_wall", membrane + "roughness=0"}, membrane + "roughness: found 0");
  check_refused({membrane + "shear=no_slip", "materials.water.mixing_length=0.1"},
                membrane + "shear: found \"no_slip\" in a fluid with mixing_length = 0.1");
  const std::vector<std::string> dry = {"bodies.water.material=subsoil", "bodies.water.shift=false",
                                        "bodies.water.initial_stress={type='zero'}"};
  const auto refused_dry = [&](std::vector<std::string> overrides, const std::string& says) {
    overrides.insert(overrides.end(), dry.begin(), dry.end());
    check_refused(overrides, says);
  };
  refused_dry({membrane + "shear=wall_law", membrane + "wall_friction=0.004"},
              membrane + "shear: found \"wall_law\" without a fluid around");
  refused_dry({membrane + "shear=rough_wall", membrane + "roughness=0.003"},
              membrane + "shear: found \"rough_wall\" without a fluid around");
  refused_dry({membrane + "drag_coefficient=1.2"}, membrane + "drag_coefficient: found 1.2 without a fluid around");
}

TEST_CASE("Windows of results refer to events further up") {
  check_refused({"results.tension_fall_p95_N_m.before=time_to_sink_s"},
                "results.tension_fall_p95_N_m.before: found \"time_to_sink_s\"");
  check_refused({"results.tension_fall_p95_N_m.before=fall_velocity_max_m_s"},
                "results.tension_fall_p95_N_m.before: found \"fall_velocity_max_m_s\"");
}
