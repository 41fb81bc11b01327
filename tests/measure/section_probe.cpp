// Forces over a section: exact for uniform stress and tension, and what the grid itself adds up otherwise.
#include "measure/probes/section_probe.hpp"

#include <doctest/doctest.h>
#include <geodrop/measure/history.hpp>
#include <geodrop/step/pipeline.hpp>

#include <algorithm>
#include <cmath>

#include "support/near.hpp"
#include "support/random_particles.hpp"
#include "support/scene_files.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

/// The block of 2 m x 1 m from x = 1 m on, closely wrapped; cells of 0.125 m.
Scene block_on_slab(std::vector<std::string> overrides = {}) {
  overrides.push_back("membranes.skin.axial_stiffness=1e5");
  overrides.push_back("membranes.skin.mass_per_area=0.5");
  return read_scene(source_path("tests/scenes/block_on_slab.toml"), overrides);
}

constexpr int block = 1;
SectionForces over(double x, const Scene& scene, const State<2>& state) {
  return section_forces(scene, {"cut", "block", x}, state);
}

/// Random stress in the block, and random tension in its membrane, which is crumpled.
void tear_at(State<2>& state) {
  test::Random random;
  for (auto& component : state.bodies[block].stress)
    for (double& s : component) s = random.uniform(-1e4, 1e4);
  for (double& rest : state.membranes[1].rest_length) rest *= random.uniform(0.95, 1.0);
  for (auto& component : state.membranes[1].x)
    for (double& x : component) x += random.uniform(-0.01, 0.01);
}

const std::vector<double> sections{2.0, 2.03, 2.0625, 2.1249, 1.5};  // on nodes, between them, in the middle

}  // namespace

TEST_CASE("A block under uniform stress: stress times height over every section, on all bases") {
  for (const char* basis : {"bspline2", "gimp", "linear"}) {
    CAPTURE(basis);
    const Scene scene = block_on_slab({std::string("grid.basis=") + basis});
    State<2> state = build_state<2>(scene);
    Body<2>& body = state.bodies[block];
    body.stress[0].assign(body.size(), -1000.0);
    body.stress[1].assign(body.size(), 300.0);  // no matter
    for (const double x : sections) {
      CAPTURE(x);
      CHECK(over(x, scene, state).soil == near(1000.0 * 1.0, 1e-9));
    }
    for (const double x : {0.5, 3.5}) CHECK(over(x, scene, state).soil == 0);  // beside it
    // Of the body that the probe names only.
    state.bodies[0].stress[0].assign(state.bodies[0].size(), -1e6);
    CHECK(over(2.0, scene, state).soil == near(1000.0, 1e-9));
  }
}

TEST_CASE("A closed membrane under uniform tension pulls twice over its middle, whichever way it runs") {
  const Scene scene = block_on_slab();
  State<2> state = build_state<2>(scene);
  Membrane<2>& skin = state.membranes[1];
  skin.tension.assign(skin.segments(), 500.0);
  for (const double x : sections) CHECK(over(x, scene, state).membrane == near(1000.0, 1e-9));
  for (auto& component : skin.x) std::reverse(component.begin(), component.end());
  for (const double x : sections) CHECK(over(x, scene, state).membrane == near(1000.0, 1e-9));
  state.membranes[0].tension.assign(state.membranes[0].segments(), 1e6);  // of the other body
  CHECK(over(2.0, scene, state).membrane == near(1000.0, 1e-9));
}

TEST_CASE("Soil less membrane is the sum of the forces on the nodes right of the section, half of those on it") {
  for (const char* basis : {"bspline2", "gimp", "linear"}) {
    CAPTURE(basis);
    const Scene scene =
        block_on_slab({"solver.transfer=blend", "solver.blend_rate=10", std::string("grid.basis=") + basis});
    State<2> state = build_state<2>(scene);
    tear_at(state);
    Grids<2> grids = make_grids<2>(scene);
    StepContext step;
    for (Row<2>& row : build_pipeline<2>(scene)) {
      if (row.name == "fold_walls") break;
      if (row.name != "stable_dt" && row.name != "membrane_contact") row.run(state, grids, step);
      step.dt = 1e-4;
    }
    const Grid<2>& grid = grids[state.bodies[block].field];
    for (const double cut : {1.2, 2.0, 2.03, 2.7}) {
      CAPTURE(cut);
      double sum = 0, size = 0;
      test::for_each_node(grid.layout, 0, [&](int flat, const std::array<int, 2>& i) {
        const double x = grid.layout.node(0, i[0]), force = grid.force[flat][0];
        size += std::abs(force);
        sum += x > cut ? force : x == cut ? 0.5 * force : 0;
      });
      const SectionForces forces = over(cut, scene, state);
      CHECK(forces.membrane > 0);
      CHECK(std::abs(forces.soil - forces.membrane - sum) < 1e-12 * size);
    }
  }
}

TEST_CASE("A probe of a scene writes both columns") {
  const Scene scene = block_on_slab({"probes=[{name='cut',type='section',body='block',x=2.03}]"});
  State<2> state = build_state<2>(scene);
  state.bodies[block].stress[0].assign(state.bodies[block].size(), -1000.0);
  state.membranes[1].tension.assign(state.membranes[1].segments(), 500.0);
  HistoryTable table{history_columns(scene), {}};
  const std::vector<double> row = history_row(scene, state, table);
  CHECK(row.at(table.find("cut.soil_force_N_m")) == near(1000, 1e-9));
  CHECK(row.at(table.find("cut.membrane_force_N_m")) == near(1000, 1e-9));
}
