// Which cells are filled and with what pressure, from particles; where shifting is allowed.
#include <doctest/doctest.h>

#include "grid/cell_pressure.hpp"
#include "grid/sort_particles.hpp"
#include "support/near.hpp"
#include "support/random_particles.hpp"
#include "transfer/transfer_stages.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

const Newtonian water{1000, 2e6, 0};

/// A box of `cells` cells full of water with four particles a cell (3D: eight).
template <int Dim>
struct Tank {
  Grid<Dim> grid;
  State<Dim> state;
  explicit Tank(int cells) : grid(make_grid<Dim>(box_scene<Dim>(cells, 0.5, WallKind::slip))) {
    state.bodies = {lattice_body<Dim>(grid.layout, water, 2)};
    state.bodies[0].pressure = PressureSupport::cell;
    state.drift = -1;
  }
  void average(bool shift = false) {
    sort_particles(state, grid);
    clear_grid(grid);
    sum_particles_in_cells(state, grid);
    average_cell_pressure(state, grid, shift);
  }
  bool filled(const std::array<int, Dim>& cell) const { return grid.cell_flags[grid.layout.index(cell)] & cell_filled; }
  bool shiftable(const std::array<int, Dim>& cell) const {
    return grid.cell_flags[grid.layout.index(cell)] & cell_shiftable;
  }
};

/// Removes the particles for which `gone` holds.
template <class F>
void remove_particles(Body<2>& body, F&& gone) {
  std::size_t n = 0;
  for (std::size_t p = 0; p < body.size(); ++p)
    if (!gone(body.x[0][p], body.x[1][p])) ++n;
  Body<2> left = blank_body<2>(body.material, n);
  left.pressure = body.pressure;
  for (std::size_t p = 0, q = 0; p < body.size(); ++p) {
    if (gone(body.x[0][p], body.x[1][p])) continue;
    for (int a = 0; a < 2; ++a) left.x[a][q] = body.x[a][p];
    left.mass[q] = body.mass[p];
    left.J[q++] = body.J[p];
  }
  body = left;
}

}  // namespace

TEST_CASE_TEMPLATE("A full box is filled up to its walls, with the pressure of its particles", Size,
                   std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
  constexpr int Dim = Size::value;
  Tank<Dim> tank(6);
  std::fill(tank.state.bodies[0].J.begin(), tank.state.bodies[0].J.end(), 0.99);
  tank.average(true);
  std::size_t not_filled = 0, not_shiftable = 0;
  double worst = 0;
  for_each_node(tank.grid.layout, 0, [&](int flat, const auto&) {
    not_filled += !(tank.grid.cell_flags[flat] & cell_filled);
    not_shiftable += !(tank.grid.cell_flags[flat] & cell_shiftable);
    worst = std::max(worst, std::abs(tank.grid.cell_pressure[flat] - 2e6 * (1 / 0.99 - 1)));
  });
  CHECK(not_filled == 0);
  CHECK(not_shiftable == 0);
  CHECK(worst < 1e-9);
}

TEST_CASE("The pressure of a cell is the mean of its particles, weighted by volume") {
  Tank<2> tank(6);
  Random random;
  Body<2>& body = tank.state.bodies[0];
  for (double& J : body.J) J = random.uniform(0.97, 1.0);
  for (double& m : body.mass) m *= random.uniform(0.9, 1.1);
  tank.average();
  double volume = 0, sum = 0;
  for (std::size_t p = 0; p < body.size(); ++p) {
    if (tank.grid.layout.base(0, body.x[0][p]) != 2 || tank.grid.layout.base(1, body.x[1][p]) != 3) continue;
    volume += body.mass[p] / 1000 * body.J[p];
    sum += body.mass[p] / 1000 * body.J[p] * 2e6 * (1 / body.J[p] - 1);
  }
  const int cell = tank.grid.layout.index({2, 3});
  CHECK(tank.grid.cell_volume[cell] == near(volume, 1e-13));
  CHECK(tank.grid.cell_pressure[cell] == near(sum / volume, 1e-12));
}

TEST_CASE_TEMPLATE(
    "Still water with a still level has the pressure at the middle of its cell, wherever its particles are", Size,
    std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
  constexpr int Dim = Size::value;
  Tank<Dim> tank(6);  // 3 m
  Body<Dim>& body = tank.state.bodies[0];
  Newtonian still = water;
  still.unit_weight = 1e4;
  still.still_level = 3;
  body.material = still;
  for (double& y : body.x[Dim - 1]) y += 0.1;  // within the cells, which are half as wide at the walls
  tank.average();
  for (const auto& [row, depth] : {std::pair{0, 3 - 0.125}, {2, 2.0}, {6, 0.125}}) {
    std::array<int, Dim> cell;
    cell.fill(3);
    cell[Dim - 1] = row;
    CHECK(tank.grid.cell_pressure[tank.grid.layout.index(cell)] == near(1e4 * depth, 1e-12));
  }
}

TEST_CASE("Of a soil the mean pressure counts pores in and tension out") {
  Tank<2> tank(6);
  Body<2>& body = tank.state.bodies[0];
  body.material = MohrCoulomb{1000, 1e6, 1e6, 0, 0.5, 0.8, 0, 0, 1e7};
  body.pore_pressure.assign(body.size(), 4e3);
  const double sigma[4] = {-1e3, -2e3, -6e3, 500};
  for (int c = 0; c < 4; ++c) body.stress[c].assign(body.size(), sigma[c]);
  tank.average();
  CHECK(tank.grid.cell_pressure[tank.grid.layout.index({3, 3})] == near(7e3, 1e-12));
}

TEST_CASE("The cell at a level surface keeps its particles' own pressure; one cell deeper it is filled") {
  Tank<2> tank(10);
  // Surface at y = 2.5 = node 5: its cell is half full, and smoothed over 0, 1/2, 1: one half. The cell below:
  // 1/4 * 1/2 + 1/2 + 1/4 = 0.875.
  remove_particles(tank.state.bodies[0], [](double, double y) { return y > 2.5; });
  tank.average(true);
  CHECK_FALSE(tank.filled({5, 5}));
  CHECK(tank.grid.cell_pressure[tank.grid.layout.index({5, 5})] == 0);
  CHECK(tank.filled({5, 4}));
  CHECK_FALSE(tank.shiftable({5, 4}));
  CHECK(tank.shiftable({5, 3}));
  CHECK(tank.filled({0, 4}));  // also at the wall, which is no surface
  CHECK_FALSE(tank.filled({5, 7}));
}

TEST_CASE("The threshold is a smoothed fill ratio of 0.7") {
  for (const double share : {0.69, 0.71}) {
    Tank<2> tank(8);
    for (double& m : tank.state.bodies[0].mass) m *= share;
    tank.average();
    CHECK(tank.filled({4, 4}) == (share > 0.7));
    CHECK(tank.filled({0, 0}) == (share > 0.7));
  }
}

TEST_CASE("Smoothing sees the mirror image beyond a wall") {
  // Half cells 1/2 full along the left wall, full ones behind: 1/4 + 1/2 1/2 + 1/4 = 0.75. Without the image: at most
  // 0.625.
  Tank<2> tank(8);
  Body<2>& body = tank.state.bodies[0];
  for (std::size_t p = 0; p < body.size(); ++p)
    if (body.x[0][p] < 0.25) body.mass[p] *= 0.5;
  tank.average();
  CHECK(tank.filled({0, 4}));
}

TEST_CASE("Particles do not shift in the cells around a membrane") {
  Tank<2> tank(10);
  Membrane<2> membrane;
  membrane.x = {Array<double>{2.4, 2.6}, Array<double>{2.5, 2.5}};
  membrane.mass = {1, 1};
  tank.state.membranes = {membrane};
  tank.average(true);
  for (int i = 4; i <= 6; ++i)
    for (int j = 4; j <= 6; ++j) {
      CHECK(tank.filled({i, j}));
      CHECK_FALSE(tank.shiftable({i, j}));
    }
  CHECK(tank.shiftable({5, 7}));
  CHECK(tank.shiftable({7, 5}));
}
