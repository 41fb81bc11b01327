// Water beside a rigid half-plane, ready for rows of a step.
#pragma once

#include <geodrop/step/pipeline.hpp>

#include <string>
#include <vector>

#include "cut/rigid_parts.hpp"
#include "grid/sort_particles.hpp"
#include "support/scene_files.hpp"

namespace geodrop::test {

/// Water beside a rigid half-plane, h = 0.125 m, its particles sorted and the parts of the rigid body found.
struct WaterAtPlane {
  Scene scene;
  State<2> state;
  Grids<2> grids;
  Grid<2>& grid = grids[0];
  Pipeline<2> pipeline;

  explicit WaterAtPlane(const std::vector<std::string>& settings = {})
      : scene(read_scene(source_path("tests/scenes/water_at_rigid_wall.toml"), settings)),
        state(build_state<2>(scene)),
        grids(make_grids<2>(scene)),
        pipeline(build_pipeline<2>(scene)) {
    sort_particles_if_due(state, grids);
    find_rigid_parts(state, grid);
  }
  /// Runs the rows of one step up to the one of this name.
  void run_until(const std::string& last, double dt = 0) {
    StepContext step{dt, state.t, state.step};
    for (Row<2>& row : pipeline) {
      if (row.name == last) return;
      row.run(state, grids, step);
    }
  }
  double cell(int i, int j) const { return grid.rigid_cells[grid.layout.index({i, j})]; }
  double spline(int i, int j) const { return grid.rigid_splines[grid.layout.index({i, j})]; }
};

/// Settings: the half-plane and the edge of the water at x [m].
inline std::vector<std::string> at(double x) {
  const std::string place = "[" + std::to_string(x) + ",0]";
  return {"rigid.paddle.shape.point=" + place, "bodies.water.shape.lower=" + place};
}

}  // namespace geodrop::test
