// The golden list of stages of each shipped case: a scene pays for what it names and for nothing else.
#include <doctest/doctest.h>
#include <geodrop/step/pipeline.hpp>

#include "support/scene_files.hpp"

using namespace geodrop;

namespace {

using Names = std::vector<std::string>;

/// Without the time step, which each has, and the watch over energies, see tests/step/energy_watch.
Names stages(const std::string& scene_file, const std::vector<std::string>& overrides = {}) {
  Names names;
  for (const Row<2>& row : build_pipeline<2>(read_scene(source_path(scene_file), overrides)))
    if (row.name != "stable_dt" && row.name != "energy_watch") names.push_back(row.name);
  return names;
}

const Names elastic = {"sort_particles", "clear_grid",        "particles_to_grid", "fold_walls",
                       "momentum",       "grid_to_particles", "grid_to_tracers"};
const Names water = {"sort_particles", "clear_grid",  "cell_pressure", "particles_to_grid", "fold_walls",
                     "momentum",       "volume_rate", "crowding",      "grid_to_particles", "spread_particles"};

}  // namespace

TEST_CASE("Water has cell pressure, and neither membranes nor tracers") {
  CHECK(stages("cases/hydrostatic_column.toml") == water);
}

TEST_CASE("Water crowds where it shifts with a speed of its own") {
  for (const std::string setting : {"bodies.water.shift=false", "bodies.water.shift_speed=0.0"}) {
    CAPTURE(setting);
    const Names rows = stages("cases/hydrostatic_column.toml", {setting});
    CHECK(std::count(rows.begin(), rows.end(), "crowding") == 0);
  }
}

TEST_CASE("Elastic solids with particle pressure have no stage of cells") {
  CHECK(stages("cases/elastic_bar.toml") == elastic);
  CHECK(stages("cases/gravity_column.toml") == elastic);
}

TEST_CASE("A sharp interface adds its stages") {
  CHECK(stages("cases/ellipse_release.toml") ==
        Names{"even_out_nodes",     "sort_particles",    "clear_grid",        "cut_cells",       "cell_pressure",
              "interface_pressure", "even_out_volumes",  "particles_to_grid", "slide_membranes", "membranes_to_grid",
              "interface_force",    "fold_walls",        "momentum",          "join_interfaces", "volume_rate",
              "interface_rate",     "grid_to_particles", "grid_to_membranes", "keep_sides",      "limit_unseen"});
}

TEST_CASE("A sharp skin moves apart from cloth; only blended velocities have a part that nodes do not see") {
  const Names block = stages("cases/verification/floating_block.toml"), bag = stages("cases/ellipse_release.toml");
  CHECK(std::count(block.begin(), block.end(), "move_skins") == 1);
  CHECK(std::count(bag.begin(), bag.end(), "move_skins") == 0);
  CHECK(std::count(block.begin(), block.end(), "limit_unseen") == 0);  // transfer = "tpic"
}

TEST_CASE("Drag of a membrane is a stage where its coefficient is not 0") {
  const std::string scene = "cases/ellipse_release.toml";
  const Names without = stages(scene), with = stages(scene, {"membranes.0.drag_coefficient=1.0"});
  CHECK(std::count(without.begin(), without.end(), "model_drag") == 0);
  CHECK(std::count(with.begin(), with.end(), "model_drag") == 1);
  CHECK(with.size() == without.size() + 2);  // with the loads that it begins from
}

TEST_CASE("As a mixture the main case has membranes on top of cell pressure") {
  CHECK(stages("cases/dump_kekerdom_mixture.toml") ==
        Names{"sort_particles", "clear_grid", "cell_pressure", "filter_checkerboard", "particles_to_grid",
              "membranes_to_grid", "fold_walls", "momentum", "volume_rate", "crowding", "grid_to_particles",
              "spread_particles", "grid_to_membranes"});
}

TEST_CASE("A body force is a stage of its own, for manufactured solutions only") {
  CHECK(stages("cases/verification/mms_axis_aligned.toml") == Names{"sort_particles", "clear_grid", "particles_to_grid",
                                                                    "body_force", "fold_walls", "momentum",
                                                                    "grid_to_particles"});
  CHECK(stages("cases/verification/taylor_green.toml") == water);
}

TEST_CASE("The consistent mass matrix is a stage after the momentum; MUSL gives velocity back after both") {
  const std::vector<std::string> consistent{"solver.mass_matrix=consistent"};
  CHECK(stages("cases/verification/ring_tension.toml", consistent) ==
        Names{"sort_particles", "clear_grid", "particles_to_grid", "fold_walls", "momentum", "mass_correction",
              "grid_to_particles"});
  CHECK(stages("cases/gravity_column.toml", {"solver.mass_matrix=consistent", "solver.transfer=musl"}) ==
        Names{"sort_particles", "clear_grid", "particles_to_grid", "fold_walls", "momentum", "mass_correction",
              "remap_velocity", "grid_to_particles", "grid_to_tracers"});
}

TEST_CASE("A viscous boundary is a stage before the momentum and one after the particles have moved") {
  CHECK(stages("cases/verification/viscous_boundary.toml") ==
        Names{"sort_particles", "clear_grid", "particles_to_grid", "boundaries_to_grid", "fold_walls", "momentum",
              "grid_to_particles", "grid_to_boundaries", "grid_to_tracers"});
}

TEST_CASE("Cell pressure is a choice of the body") {
  const Names with_cells = stages("cases/gravity_column.toml", {"bodies.column.pressure=cell"});
  CHECK(std::count(with_cells.begin(), with_cells.end(), "cell_pressure") == 1);
  CHECK(std::count(with_cells.begin(), with_cells.end(), "volume_rate") == 1);
  CHECK(stages("cases/hydrostatic_column.toml", {"bodies.water.pressure=particle", "bodies.water.shift=false"}) ==
        Names{"sort_particles", "clear_grid", "particles_to_grid", "fold_walls", "momentum", "grid_to_particles"});
}

TEST_CASE("A geotube at rest: cut cells in place of whole ones, contact, and two criteria of rest") {
  CHECK(stages("cases/geotube_556.toml", {"bodies.fluid.pressure=enclosed"}) ==
        Names{"even_out_nodes", "sort_particles", "clear_grid", "enclosed_cells", "particles_to_grid", "enclosed_force",
              "clear_loads", "membrane_contact", "slide_membranes", "enclosed_load", "membranes_to_grid", "fold_walls",
              "momentum", "out_of_balance", "enclosed_rate", "grid_to_particles", "grid_to_membranes",
              "kinetic_damping"});
  const Names pumped = stages("tests/scenes/tube.toml");
  CHECK(std::count(pumped.begin(), pumped.end(), "pumps") == 1);
  CHECK(std::count(pumped.begin(), pumped.end(), "kinetic_damping") == 1);
  const Names free =
      stages("tests/scenes/tube.toml",
             {"relaxation.damping=none", "relaxation.kinetic_ratio=", "relaxation.out_of_balance_ratio=", "contacts=[]",
              "bodies.fluid.pressure=cell"});
  for (const char* name : {"enclosed_cells", "clear_loads", "enclosed_load", "enclosed_force", "out_of_balance",
                           "enclosed_rate", "kinetic_damping"})
    CHECK(std::count(free.begin(), free.end(), name) == 0);
}

TEST_CASE("Rigid contact: loads for membranes, a stage for bare particles, one for what moves") {
  CHECK(stages("tests/scenes/ramp.toml") == Names{"sort_particles", "clear_grid", "particles_to_grid", "clear_loads",
                                                  "membrane_contact", "particle_contact", "membranes_to_grid",
                                                  "fold_walls", "momentum", "grid_to_particles", "grid_to_membranes",
                                                  "move_rigid_bodies"});
  const Names still = stages("tests/scenes/ramp.toml",
                             {"rigid.gate.motion={type='none'}", "rigid.ram.motion={type='none'}",
                              "rigid.wheel.motion={type='none'}", "contacts=[{between=['skin','ramp'],friction=0.3}]"});
  for (const char* name : {"particle_contact", "move_rigid_bodies"})
    CHECK(std::count(still.begin(), still.end(), name) == 0);
}

TEST_CASE("Bodies that part from each other add loads on their skins; stages in time begin the step") {
  Names names{"sort_particles",    "clear_grid", "particles_to_grid", "clear_loads",       "membrane_contact",
              "membranes_to_grid", "fold_walls", "momentum",          "grid_to_particles", "grid_to_membranes"};
  CHECK(stages("tests/scenes/block_on_slab.toml") == names);
  names.insert(names.begin(), "scene_stages");
  CHECK(stages("tests/scenes/block_on_slab.toml", {"stages=[{name='all',from=0.0}]"}) == names);
  const Names free = stages("tests/scenes/block_on_slab.toml", {"contacts=[]"});
  CHECK(std::count(free.begin(), free.end(), "clear_loads") == 0);
}

TEST_CASE("Grid arrays of features that a case does not use have length zero") {
  const Grid<2> column = make_grid<2>(read_scene(source_path("cases/gravity_column.toml")));
  CHECK(column.cell_volume.empty());
  CHECK(column.cell_pressure.empty());
  CHECK(column.volume_rate.empty());
  CHECK(column.cell_flags.empty());
  CHECK_FALSE(column.velocity_change.empty());  // blend
  CHECK(column.mass_correction.empty());
  CHECK(column.enclosed.empty());
  const Grid<2> tube = make_grid<2>(read_scene(source_path("tests/scenes/tube.toml")));
  CHECK(tube.enclosed.size() == 1);
  CHECK(tube.cell_pressure.empty());
  CHECK_FALSE(tube.velocity_change.empty());  // relaxation
  const Grid<2> still = make_grid<2>(read_scene(source_path("cases/hydrostatic_column.toml")));
  CHECK(still.force.empty());
  CHECK(still.velocity_change.empty());  // tpic
  CHECK_FALSE(still.cell_flags.empty());
}

TEST_CASE("A step runs every stage once, in order, and then advances the clock") {
  const Scene scene = read_scene(source_path("cases/hydrostatic_column.toml"));
  State<2> state = build_state<2>(scene);
  Grids<2> grid = make_grids<2>(scene);
  std::vector<int> order;
  Pipeline<2> pipeline;
  for (int k = 0; k < 3; ++k)
    pipeline.push_back({"row", {}, {}, true, [&order, k](State<2>& s, Grids<2>&, StepContext& step) {
                          order.push_back(k);
                          CHECK(step.step == 0);
                          CHECK(s.t == 0);
                          step.dt += 0.5;
                        }});
  advance(pipeline, state, grid);
  CHECK(order == std::vector<int>{0, 1, 2});
  CHECK(state.t == 1.5);
  CHECK(state.step == 1);
}
