// Which bodies move with which velocity field, and what the grids of the fields hold.
#include <geodrop/scene/velocity_fields.hpp>

#include <doctest/doctest.h>
#include <geodrop/grid/grid.hpp>
#include <geodrop/step/pipeline.hpp>

#include <algorithm>
#include <set>

#include "support/scene_files.hpp"

using namespace geodrop;

namespace {

using Overrides = std::vector<std::string>;

/// Slab, block and a bystander that nothing touches.
Scene three_bodies(const std::string& contacts) {
  const TemporaryDirectory directory;
  const std::filesystem::path path = directory / "scene.toml";
  std::ofstream(path) << read_file(source_path("tests/scenes/block_on_slab.toml")) << R"(
[[bodies]]
name = "bystander"
material = "elastic"
shape = { type = "box", lower = [6.0, 2.0], upper = [7.0, 3.0] }
pressure = "particle"
initial_stress = { type = "zero" }
)";
  return read_scene(path, {"contacts=" + contacts});
}

Scene block_on_slab(const Overrides& overrides = {}) {
  return read_scene(source_path("tests/scenes/block_on_slab.toml"), overrides);
}

}  // namespace

TEST_CASE("Bodies without contact between them share one field") {
  for (const char* file :
       {"cases/dump_kekerdom_mixture.toml", "cases/hydrostatic_column.toml", "tests/scenes/run_up.toml"}) {
    CAPTURE(file);
    const Scene scene = read_scene(source_path(file));
    CHECK(velocity_fields(scene) == std::vector<int>(scene.bodies.size(), 0));
    CHECK(count_velocity_fields(scene) == 1);
    CHECK(make_grids<2>(scene).size() == 1);
  }
}

TEST_CASE("Contact with rigid ground parts a body from no other") {
  const Scene scene = read_scene(source_path("tests/scenes/block.toml"));
  CHECK(velocity_fields(scene) == std::vector<int>{0});
  CHECK(make_grids<2>(scene).size() == 1);
}

TEST_CASE("Bodies that touch have a field each, whatever the order of their names") {
  for (const char* between : {"['skin','ground']", "['ground','skin']"}) {
    const Scene scene = block_on_slab({std::string("contacts.0.between=") + between});
    const std::vector<int> fields = velocity_fields(scene);
    REQUIRE(fields.size() == 2);
    CHECK(std::set<int>(fields.begin(), fields.end()) == std::set<int>{0, 1});
    CHECK(count_velocity_fields(scene) == 2);
  }
}

TEST_CASE("Air around a sharp interface has number 0, without a body") {
  const Scene scene = read_scene(source_path("cases/verification/seepage_into_air.toml"));
  CHECK(velocity_fields(scene) == std::vector<int>{1, 2});
  const Grids<2> grids = make_grids<2>(scene);
  REQUIRE(grids.size() == 3);
  CHECK(!grids[0].cell_volume.empty());
}

TEST_CASE("All others share number 0") {
  const Scene scene = three_bodies("[{between=['skin','ground'],friction=0.1}]");
  const std::vector<int> fields = velocity_fields(scene);
  REQUIRE(fields.size() == 3);
  CHECK(fields[2] == 0);
  CHECK(std::set<int>(fields.begin(), fields.end()) == std::set<int>{0, 1, 2});
  CHECK(count_velocity_fields(scene) == 3);
  CHECK(make_grids<2>(scene).size() == 3);
}

TEST_CASE("Own folds part a body from itself, not from others") {
  const Scene scene = three_bodies("[{between=['skin','skin'],friction=0.1}]");
  CHECK(velocity_fields(scene) == std::vector<int>{0, 0, 0});
  CHECK(make_grids<2>(scene).size() == 1);
}

TEST_CASE("The grids of all fields have one layout, and know their numbers") {
  const Scene scene = block_on_slab();
  const Grids<2> grids = make_grids<2>(scene);
  REQUIRE(grids.size() == 2);
  for (int f = 0; f < 2; ++f) {
    CHECK(grids[f].field == f);
    CHECK(grids[f].layout.nodes() == GridLayout<2>(scene.grid, scene.walls).nodes());
    CHECK(grids[f].sum.size() == static_cast<std::size_t>(grids[f].layout.nodes()));
    CHECK(grids[f].velocity.size() == grids[f].sum.size());
  }
}

TEST_CASE("Bodies, membranes and tracers of a state carry the number of their field") {
  const Scene scene =
      block_on_slab({"probes=[{name='rider',type='tracer',position=[2.0,1.5]},"
                     "{name='deep',type='tracer',position=[2.0,0.5]}]"});
  const std::vector<int> fields = velocity_fields(scene);
  const State<2> state = build_state<2>(scene);
  for (int b = 0; b < 2; ++b) {
    CHECK(state.bodies[b].field == fields[b]);
    CHECK(state.membranes[b].field == fields[b]);  // "ground" is of "slab", "skin" of "block"
  }
  CHECK(state.tracers[0].field == fields[1]);
  CHECK(state.tracers[1].field == fields[0]);
}

TEST_CASE("Arrays of cells exist in the fields of bodies with cell pressure only") {
  const Scene scene = block_on_slab({"bodies.slab.pressure=cell"});
  const std::vector<int> fields = velocity_fields(scene);
  const Grids<2> grids = make_grids<2>(scene);
  const Grid<2>&slab = grids[fields[0]], &block = grids[fields[1]];
  CHECK_FALSE(slab.cell_volume.empty());
  CHECK_FALSE(slab.cell_pressure.empty());
  CHECK_FALSE(slab.volume_rate.empty());
  CHECK_FALSE(slab.cell_flags.empty());
  CHECK(block.cell_volume.empty());
  CHECK(block.cell_pressure.empty());
  CHECK(block.volume_rate.empty());
  CHECK(block.cell_flags.empty());
}

TEST_CASE("Nodal pressure and cut cells exist in the fields of their bodies only") {
  const Scene simplices = block_on_slab(
      {"grid.basis=tri3", "solver.transfer=musl", "solver.blend_rate=100", "bodies.block.pressure=nodal"});
  Grids<2> grids = make_grids<2>(simplices);
  std::vector<int> fields = velocity_fields(simplices);
  for (const auto* array :
       {&grids[fields[1]].node_volume, &grids[fields[1]].node_pressure, &grids[fields[1]].node_rate})
    CHECK_FALSE(array->empty());
  for (const auto* array :
       {&grids[fields[0]].node_volume, &grids[fields[0]].node_pressure, &grids[fields[0]].node_rate})
    CHECK(array->empty());

  const Scene tube =
      block_on_slab({"materials.slurry={model='newtonian',density=1200.0,sound_speed=60.0,viscosity=1.0}",
                     "bodies.block.material=slurry", "bodies.block.pressure=enclosed",
                     "membranes.skin.axial_stiffness=1e5", "membranes.skin.mass_per_area=0.5", "gravity=[0.0,-9.81]"});
  grids = make_grids<2>(tube);
  fields = velocity_fields(tube);
  CHECK(grids[fields[1]].enclosed.size() == 1);
  CHECK(grids[fields[0]].enclosed.empty());
}
