// Cells that would be too stiff for the step: S by hand and by the force of a pressure, and the share that they keep.
#include <doctest/doctest.h>

#include "grid/blocks.hpp"
#include "grid/cell_pressure.hpp"
#include "grid/momentum.hpp"
#include "support/near.hpp"
#include "support/random_particles.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double density = 1000, modulus = 4e6, dt = 1e-3;

template <int Dim>
std::array<int, Dim> stored(const std::array<int, Dim>& node) {
  std::array<int, Dim> out;
  for (int a = 0; a < Dim; ++a) out[a] = node[a] + GridLayout<Dim>::pad;
  return out;
}

/// A grid full of a material of one modulus, one pressure in all cells.
template <int Dim>
Grid<Dim> full_grid(const Scene& scene) {
  Grid<Dim> grid = make_grid<Dim>(scene);
  activate_all_blocks(grid);
  grid.largest_modulus = modulus;
  const GridLayout<Dim>& layout = grid.layout;
  for_each_node(layout, 0, [&](int flat, const std::array<int, Dim>& i) {
    double volume = 1;
    for (int a = 0; a < Dim; ++a)
      volume *= layout.h * layout.span_width(a, i[a]) * (i[a] == 0 || i[a] == layout.cells[a] ? 0.5 : 1.0);
    grid.cell_flags[flat] = cell_filled;
    grid.cell_volume[flat] = volume;
    grid.cell_pressure[flat] = 1e4;
    grid.sum[flat][3] = density * volume;
  });
  return grid;
}

/// S of one cell.
template <int Dim>
double swing_of(const Grid<Dim>& grid, const std::array<int, Dim>& cell) {
  return cell_swing<Dim>(grid, grid.layout.index(cell), 1, stored<Dim>(cell), dt)[0];
}

/// S of a cell from the forces that a pressure of 1 in it alone has on the nodes.
template <int Dim>
double swing_by_force(Grid<Dim> grid, int flat) {
  std::fill(grid.cell_pressure.begin(), grid.cell_pressure.end(), 0.0);
  grid.cell_pressure[flat] = 1;
  double sum = 0;
  for (const std::uint32_t block : grid.active_blocks)
    for_each_real_row_of_block(grid.layout, block, [&](int begin, int count, std::array<int, Dim> node) {
      const RowForce<Dim> force = cell_pressure_force<Dim>(grid, begin, count, node);
      for (int k = 0; k < count; ++k, ++node[0])
        for (int a = 0; a < Dim; ++a)
          sum += force[a][k] * force[a][k] / std::max(grid.sum[begin + k][3], light_mass<Dim>(grid, node));
    });
  return dt * dt * modulus * sum / grid.cell_volume[flat];
}

template <int Dim>
void check_random_masses(const Scene& scene) {
  Grid<Dim> grid = full_grid<Dim>(scene);
  Random random(11);
  for_each_node(grid.layout, 0, [&](int flat, const auto&) {
    grid.sum[flat][3] *= random.uniform(0, 1) < 0.2 ? 0 : std::pow(10, random.uniform(-4, 0));
    grid.cell_volume[flat] *= random.uniform(0.1, 1.5);
  });
  for_each_node(grid.layout, 0, [&](int flat, const std::array<int, Dim>& i) {
    CHECK(swing_of<Dim>(grid, i) == near(swing_by_force(grid, flat), 1e-11));
  });
}

}  // namespace

TEST_CASE("A full cell has S = (c dt/h)^2 / 2 in the plane and 3/8 of it in space") {
  constexpr double h = 0.25, courant2 = modulus / density * dt * dt / (h * h);
  const Grid<2> plane = full_grid<2>(box_scene<2>(9, h, WallKind::slip));
  CHECK(swing_of<2>(plane, {4, 5}) == near(courant2 / 2, 1e-13));
  const Grid<3> space = full_grid<3>(box_scene<3>(9, h, WallKind::slip));
  CHECK(swing_of<3>(space, {4, 5, 3}) == near(courant2 * 3 / 8, 1e-13));
}

TEST_CASE("S is what the force of a pressure in the cell does to the nodes, small-mass nodes at their limit") {
  for (const WallKind wall : {WallKind::slip, WallKind::no_slip}) {
    check_random_masses<2>(box_scene<2>(7, 0.25, wall));
    check_random_masses<2>(graded_scene<2>(7, 0.25, wall));
    check_random_masses<3>(box_scene<3>(4, 0.25, wall));
  }
}

TEST_CASE("Only cells with S above 1 lose pressure, down to sqrt(1/S), and their rate takes the same share") {
  for (const bool graded : {false, true}) {
    const Scene scene = graded ? graded_scene<2>(9, 0.25, WallKind::slip) : box_scene<2>(9, 0.25, WallKind::slip);
    Grid<2> grid = full_grid<2>(scene);
    const int light = grid.layout.index({3, 3});
    grid.cell_volume[light] *= 0.05;
    for (int n : {-1, 0, 1})
      for (int m : {-1, 0, 1}) grid.sum[grid.layout.index({3 + n, 3 + m})][3] *= 0.01;
    std::vector<double> swing(grid.layout.nodes());
    for_each_node(grid.layout, 0, [&](int flat, const std::array<int, 2>& i) { swing[flat] = swing_of<2>(grid, i); });
    CHECK(swing[light] > 4);
    soften_light_cells(grid, dt);
    int kept = 0;
    for_each_node(grid.layout, 0, [&](int flat, const std::array<int, 2>&) {
      const double share = std::min(1.0, std::sqrt(1 / swing[flat]));
      kept += share == 1;
      CHECK(grid.cell_pressure[flat] == near(1e4 * share, 1e-13));
      CHECK(grid.volume_rate[flat] == near(share, 1e-13));
    });
    CHECK(kept > 50);
  }
}

TEST_CASE("Where bodies differ in rho c^2 a cell has the mean of its own") {
  Grid<2> grid = full_grid<2>(box_scene<2>(9, 0.25, WallKind::slip));
  const std::array<int, 2> cell{4, 4};
  const int flat = grid.layout.index(cell);
  const double of_one = swing_of<2>(grid, cell);
  grid.cell_modulus.assign(grid.layout.nodes(), 0.0);
  grid.cell_modulus[flat] = 0.001 * modulus * grid.cell_volume[flat];
  CHECK(swing_of<2>(grid, cell) == near(0.001 * of_one, 1e-13));
}

TEST_CASE("Parts of cells beside a sharp interface keep their pressure, which has joined the force already") {
  Grid<2> grid = full_grid<2>(box_scene<2>(9, 0.25, WallKind::slip));
  for (Vec4& sum : grid.sum) sum[3] *= 1e-3;
  PartCell<2> part;
  part.flat = grid.layout.index({3, 3});
  grid.part_cells.push_back(part);
  soften_light_cells(grid, 10 * dt);
  CHECK(grid.cell_pressure[part.flat] == 1e4);
  CHECK(grid.cell_pressure[grid.layout.index({4, 4})] < 5e3);
}

TEST_CASE("Parts that share a pressure swing as one: slopes at a common node add up, and all take sqrt(1/S)") {
  Grid<2> grid = full_grid<2>(box_scene<2>(9, 0.25, WallKind::slip));
  const int host = grid.layout.index({3, 3}), guest = grid.layout.index({4, 3}), alone = grid.layout.index({7, 7});
  constexpr int centre = 4, left = 3;  // of the 3 x 3 nodes around a cell, x fastest
  PartCell<2> one{host, host}, other{guest, host}, third{alone, alone};
  one.slope[centre] = {0.1, 0.0};
  other.slope[left] = {0.1, 0.05};  // the same node
  third.slope[centre] = {0.05, 0.05};
  grid.part_cells = {one, other, third};
  for (const int cell : {host, guest}) grid.cell_volume[cell] = 0.001;
  const double mass = 5, all = 0.002;
  grid.sum[host][3] = mass;
  const double swing = dt * dt * modulus / all * (0.2 * 0.2 + 0.05 * 0.05) / mass;
  CHECK(swing > 10);
  soften_light_parts(grid, dt);
  for (std::size_t k : {0, 1}) {
    CHECK(grid.part_cells[k].share == near(std::sqrt(1 / swing), 1e-13));
    CHECK(grid.cell_pressure[grid.part_cells[k].flat] == near(1e4 * std::sqrt(1 / swing), 1e-13));
  }
  CHECK(grid.part_cells[2].share == 1);
  CHECK(grid.cell_pressure[alone] == 1e4);
}
