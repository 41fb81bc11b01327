// The shift that particles on the surface of a rigid body do not do.
#include "contact/shift_at_rigid.hpp"

#include <doctest/doctest.h>
#include <geodrop/step/pipeline.hpp>

#include <cmath>
#include <numbers>
#include <numeric>

#include "grid/cell_pressure.hpp"
#include "grid/sort_particles.hpp"
#include "support/near.hpp"
#include "support/scene_files.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

/// Water beside a rigid half-plane, h = 0.125 m, its particles sorted.
struct Ready {
  Scene scene;
  State<2> state;
  Grids<2> grids;
  Grid<2>& grid = grids[0];
  Pipeline<2> pipeline;

  explicit Ready(const std::vector<std::string>& settings = {})
      : scene(read_scene(source_path("tests/scenes/water_at_rigid_wall.toml"), settings)),
        state(build_state<2>(scene)),
        grids(make_grids<2>(scene)),
        pipeline(build_pipeline<2>(scene)) {
    sort_particles_if_due(state, grids);
  }
  /// Runs the rows of one step before the one of this name.
  void run_until(const std::string& last) {
    StepContext step{0, state.t, state.step};
    for (Row<2>& row : pipeline) {
      if (row.name == last) return;
      row.run(state, grids, step);
    }
  }
};

/// The half-plane and the edge of the water at x [m].
std::vector<std::string> at(double x) {
  const std::string place = "[" + std::to_string(x) + ",0]";
  return {"rigid.paddle.shape.point=" + place, "bodies.water.shape.lower=" + place};
}

}  // namespace

TEST_CASE("What touches does not shift along the normal, what does not touch shifts as it would") {
  Ready it(at(0.53));
  it.run_until("held_shift");
  Body<2>& water = it.state.bodies[0];
  RigidContact<2>& contact = it.state.rigid_contacts[0];
  for (std::size_t k = 0; k < it.grid.velocity.size(); ++k)  // fuller to the right and upwards
    it.grid.velocity[k][3] = 0.01 * static_cast<double>(k % it.grid.layout.stride[1] + k / it.grid.layout.stride[1]);
  for (std::size_t p = 0; p < water.size(); ++p) water.v[0][p] = water.v[1][p] = 0;
  std::size_t touching = 0;
  for (std::size_t p = 0; p < water.size(); ++p)
    if (water.x[0][p] < 0.55 && std::abs(water.x[1][p] - 0.5) < 0.05) touching = p;
  water.x[0][touching] -= 1e-3;
  contact.points = {water.id[touching]};
  contact.side = {0};
  contact.slip = {0};
  const auto before = water.x, before_v = water.v;
  for (std::size_t p = 0; p < water.size(); ++p) water.affine[2][p] = 3;  // dv_y/dx [1/s]
  constexpr double dt = 1e-3, v0 = 1;
  find_held_shifts(it.state, it.grid, dt);
  CHECK(water.x == before);
  hold_shifts(it.state, it.grid);
  int moved = 0;
  for (std::size_t p = 0; p < water.size(); ++p) {
    CHECK(water.x[1][p] == before[1][p]);
    if (water.x[0][p] == before[0][p]) continue;
    ++moved;
    CHECK(water.id[p] == contact.points[0]);
    // The shift would be -h dt v0 dphi/dx = -dt v0 0.01, and v would follow by the shear.
    CHECK(water.x[0][p] - before[0][p] == near(dt * v0 * 0.01, 1e-6));
    CHECK(water.v[1][p] - before_v[1][p] == near(3 * dt * v0 * 0.01, 1e-6));
    CHECK(water.v[0][p] == before_v[0][p]);
  }
  CHECK(moved == 1);
}
