// What rigid bodies take of cells and splines, and the shift that particles on their surface do not do.
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

/// Water beside a rigid half-plane, h = 0.125 m, its particles sorted and its rigid share found.
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
    find_rigid_share(state, grid);
  }
  /// Runs the rows of one step before the one of this name.
  void run_until(const std::string& last) {
    StepContext step{0, state.t, state.step};
    for (Row<2>& row : pipeline) {
      if (row.name == last) return;
      row.run(state, grids, step);
    }
  }
  double cell(int i, int j) const { return grid.rigid_cells[grid.layout.index({i, j})]; }
  double spline(int i, int j) const { return grid.rigid_splines[grid.layout.index({i, j})]; }
};

/// The half-plane and the edge of the water at x [m].
std::vector<std::string> at(double x) {
  const std::string place = "[" + std::to_string(x) + ",0]";
  return {"rigid.paddle.shape.point=" + place, "bodies.water.shape.lower=" + place};
}

}  // namespace

TEST_CASE("A plane along the grid has its exact share of each cell, and shares of splines add up to its area") {
  for (const double x : {0.5, 0.53, 0.61}) {
    CAPTURE(x);
    const Ready it(at(x));
    const double h = it.grid.layout.h;
    double cells = 0;
    for (int i = 3; i <= 6; ++i) {
      const double share = std::clamp(x / h - (i - 0.5), 0.0, 1.0);
      CHECK(it.cell(i, 4) == within(share, 1e-12));
      CHECK(it.cell(i, 0) == within(share, 1e-12));
      cells += share;
    }
    // All splines of a row hold the area of its cells: those of nodes 2 and 3, whole but for what nodes 4 to 6 have.
    double splines = 0;
    for (int i = 2; i <= 8; ++i) splines += it.spline(i, 4) / (h * h);
    CHECK(splines == near(1 + cells, 1e-9));
  }
}

TEST_CASE("Cells that the surface cuts leave the pressure to particles, and shift as their neighbours do") {
  Ready it(at(0.53));
  it.run_until("particles_to_grid");
  const auto flags = [&](int i, int j) { return it.grid.cell_flags[it.grid.layout.index({i, j})]; };
  CHECK((flags(4, 3) & cell_filled) == 0);
  CHECK((flags(4, 3) & cell_shiftable) != 0);
  CHECK((flags(5, 3) & cell_filled) != 0);
  CHECK((flags(5, 3) & cell_shiftable) != 0);
  // Without the plane that is a free surface.
  std::fill(it.grid.rigid_cells.begin(), it.grid.rigid_cells.end(), 0.0);
  average_cell_pressure(it.state, it.grid, true);
  CHECK((flags(5, 3) & cell_shiftable) == 0);
}

TEST_CASE("A uniform pressure of particles and the contact that bears it leave no force on any node") {
  Ready it({"bodies.water.pressure=particle", "gravity=[0,0]", "bodies.water.initial_stress={type=\"zero\"}"});
  constexpr double pressure = 1e4, depth = 1e-7;
  const double bulk = 1000 * 40.0 * 40.0;
  Body<2>& water = it.state.bodies[0];
  for (double& J : water.J) J = 1 / (1 + pressure / bulk);
  for (std::size_t p = 0; p < water.size(); ++p) {
    water.x[0][p] -= depth;
    water.mass[p] /= water.J[p];  // volumes stay those of the lattice
  }
  RigidContact<2>& contact = it.state.rigid_contacts[0];
  contact.stiffness = pressure / depth;
  for (double& width : contact.half_width) width = 0.125 / 4;
  it.run_until("fold_walls");
  const double scale = pressure * it.grid.layout.h;
  for (int i = 2; i <= 7; ++i) {
    CAPTURE(i);
    for (int a = 0; a < 2; ++a) CHECK(std::abs(it.grid.force[it.grid.layout.index({i, 4})][a]) < 0.01 * scale);
  }
}

TEST_CASE("What touches does not shift along the normal, what does not touch shifts as it would") {
  Ready it(at(0.53));
  it.run_until("hold_shift");
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
  const auto before = water.x;
  constexpr double dt = 1e-3, v0 = 1;
  hold_shift(it.state, it.grid, dt);
  int moved = 0;
  for (std::size_t p = 0; p < water.size(); ++p) {
    CHECK(water.x[1][p] == before[1][p]);
    if (water.x[0][p] == before[0][p]) continue;
    ++moved;
    CHECK(water.id[p] == contact.points[0]);
    // The shift would be -h dt v0 dphi/dx = -dt v0 0.01.
    CHECK(water.x[0][p] - before[0][p] == near(dt * v0 * 0.01, 1e-6));
  }
  CHECK(moved == 1);
}
