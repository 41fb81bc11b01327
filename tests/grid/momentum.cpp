// Momentum on the nodes: kept to round-off with light nodes too; gravity; walls.
#include "grid/momentum.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numeric>
#include <type_traits>

#include "grid/neighbourhood.hpp"
#include "support/near.hpp"
#include "support/random_particles.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double dt = 0.01;

/// Random mass, momentum and force on the nodes `margin` and more away from the walls; every third one light.
template <int Dim>
struct Nodes {
  Grid<Dim> grid;
  State<Dim> state;
  std::array<double, Dim> gravity{};

  Nodes(int cells, int margin, WallKind wall, Transfer transfer)
      : grid(make_grid<Dim>(box_scene<Dim>(cells, 0.5, wall, transfer))) {
    activate_all_blocks(grid);
    Random random;
    for_each_node(grid.layout, 0, [&](int flat, const std::array<int, Dim>& i) {
      for (int a = 0; a < Dim; ++a)
        if (i[a] < margin || i[a] > cells - margin) return;
      const double mass =
          grid.light_mass * (random.uniform(0, 1) < 0.33 ? random.uniform(1e-9, 1) : random.uniform(1, 60));
      grid.sum[flat][3] = mass;
      for (int a = 0; a < Dim; ++a) {
        grid.sum[flat][a] = mass * random.uniform(-2, 2);
        if (!grid.force.empty()) grid.force[flat][a] = random.uniform(-50, 50);
      }
      if (random.uniform(0, 1) < 0.7) grid.cell_pressure[flat] = random.uniform(0, 300);
    });
  }
  void update() { update_momentum<Dim>(grid, gravity, dt); }
};

/// |sum m v' - sum (m v + dt f)| / sum m |v'|; cell pressures away from the walls push with no resultant.
template <int Dim>
double momentum_error(Transfer transfer) {
  Nodes<Dim> nodes(12, 4, WallKind::slip, transfer);
  // Cells of the outermost nodes would push on nodes without mass.
  for_each_node(nodes.grid.layout, 0, [&](int flat, const std::array<int, Dim>& i) {
    for (int a = 0; a < Dim; ++a)
      if (i[a] <= 4 || i[a] >= 8) nodes.grid.cell_pressure[flat] = 0;
  });
  nodes.update();
  double worst = 0, size = 0;
  for (int a = 0; a < Dim; ++a) {
    double before = 0, after = 0;
    for_each_node(nodes.grid.layout, 0, [&](int flat, const auto&) {
      before += nodes.grid.sum[flat][a] + (nodes.grid.force.empty() ? 0.0 : dt * nodes.grid.force[flat][a]);
      after += nodes.grid.sum[flat][3] * nodes.grid.velocity[flat][a];
      size += std::abs(nodes.grid.sum[flat][3] * nodes.grid.velocity[flat][a]);
    });
    worst = std::max(worst, std::abs(after - before));
  }
  return worst / size;
}

}  // namespace

TEST_CASE("Momentum is kept to round-off, light nodes and cell pressure included") {
  CHECK(momentum_error<2>(Transfer::tpic) < 1e-13);
  CHECK(momentum_error<2>(Transfer::blend) < 1e-13);
  CHECK(momentum_error<3>(Transfer::tpic) < 1e-13);
  CHECK(momentum_error<3>(Transfer::blend) < 1e-13);
}

TEST_CASE("A heavy node takes v + dt (f / m + g), and the change is what was added") {
  Nodes<2> nodes(12, 4, WallKind::slip, Transfer::blend);
  Grid<2>& grid = nodes.grid;
  std::fill(grid.cell_pressure.begin(), grid.cell_pressure.end(), 0.0);
  std::fill(grid.sum.begin(), grid.sum.end(), Vec4{});
  const int node = grid.layout.index({6, 6});
  grid.sum[node] = Vec4{300, -600, 0, 200};
  std::fill(grid.force.begin(), grid.force.end(), Vec4{});
  grid.force[node] = Vec4{4e3, 1e3, 0, 0};
  nodes.gravity = {1, -10};
  nodes.update();
  CHECK(grid.velocity[node][0] == near(1.5 + dt * (20 + 1), 1e-14));
  CHECK(grid.velocity[node][1] == near(-3 + dt * (5 - 10), 1e-14));
  CHECK(grid.velocity_change[node][0] == near(0.21, 1e-14));
  CHECK(grid.velocity_change[node][1] == near(-0.05, 1e-14));
}

TEST_CASE("A light node is not thrown away by a force that belongs to its neighbourhood") {
  Nodes<2> nodes(12, 4, WallKind::slip, Transfer::blend);
  Grid<2>& grid = nodes.grid;
  std::fill(grid.cell_pressure.begin(), grid.cell_pressure.end(), 0.0);
  std::fill(grid.sum.begin(), grid.sum.end(), Vec4{});
  std::fill(grid.force.begin(), grid.force.end(), Vec4{});
  const int light = grid.layout.index({6, 6}), heavy = grid.layout.index({7, 6});
  grid.sum[light][3] = 1e-6 * grid.light_mass;
  grid.sum[heavy][3] = 50 * grid.light_mass;
  const double force = grid.light_mass / dt;  // alone it would give 1e6 m/s
  grid.force[light][0] = force;
  nodes.update();
  // Takes m / light_mass of the impulse on its own mass, i.e. 1 m/s, and shares the rest with 50 light masses.
  CHECK(grid.velocity[light][0] == near(1 + 1.0 / 50, 6e-8));
  CHECK(grid.velocity[heavy][0] == near(1.0 / 50, 3e-6));
}

TEST_CASE("What pushes a node without mass, as a skin beyond the particles does, pushes its neighbourhood") {
  Nodes<2> nodes(12, 4, WallKind::slip, Transfer::blend);
  Grid<2>& grid = nodes.grid;
  std::fill(grid.cell_pressure.begin(), grid.cell_pressure.end(), 0.0);
  std::fill(grid.sum.begin(), grid.sum.end(), Vec4{});
  std::fill(grid.force.begin(), grid.force.end(), Vec4{});
  const int empty = grid.layout.index({6, 6}), heavy = grid.layout.index({7, 7}), far = grid.layout.index({4, 2});
  grid.sum[heavy][3] = 50 * grid.light_mass;
  grid.force[empty][1] = grid.light_mass / dt;
  grid.force[far][1] = grid.light_mass / dt;  // nothing near that could move
  nodes.update();
  CHECK(grid.velocity[heavy][1] == near(1.0 / 50, 1e-14));
  CHECK(grid.velocity[empty][1] == 0);
  CHECK(grid.velocity[far][1] == 0);
}

TEST_CASE("On a slip wall the normal velocity is zero and the tangential one is free; ghosts are mirror images") {
  Nodes<3> nodes(6, 0, WallKind::slip, Transfer::blend);
  nodes.gravity = {0.3, -9, 2};
  nodes.update();
  const GridLayout<3>& layout = nodes.grid.layout;
  for (const auto* field : {&nodes.grid.velocity, &nodes.grid.velocity_change})
    for (int axis = 0; axis < 3; ++axis)
      for (const int wall : {0, 6}) {
        std::array<int, 3> at{3, 2, 4}, ghost, mirror;
        at[axis] = wall;
        ghost = mirror = at;
        ghost[axis] = wall == 0 ? -1 : 7;
        mirror[axis] = wall == 0 ? 1 : 5;
        const Vec4 &w = (*field)[layout.index(at)], &g = (*field)[layout.index(ghost)],
                   &m = (*field)[layout.index(mirror)];
        for (int c = 0; c < 3; ++c) {
          CHECK((c == axis ? w[c] == 0 : w[c] != 0));
          CHECK(g[c] == (c == axis ? -m[c] : m[c]));
        }
      }
}

TEST_CASE("On a no-slip wall all velocity is zero; ghosts move the other way") {
  Nodes<2> nodes(6, 0, WallKind::no_slip, Transfer::tpic);
  nodes.gravity = {0.3, -9};
  nodes.update();
  const auto& v = nodes.grid.velocity;
  const GridLayout<2>& layout = nodes.grid.layout;
  for (int i = 0; i <= 6; ++i)
    for (const auto& at : {std::array<int, 2>{i, 0}, {i, 6}, {0, i}, {6, i}})
      for (int c = 0; c < 2; ++c) CHECK(v[layout.index(at)][c] == 0);
  for (int c = 0; c < 2; ++c) {
    CHECK(v[layout.index({-1, 2})][c] == -v[layout.index({1, 2})][c]);
    CHECK(v[layout.index({2, 7})][c] == -v[layout.index({2, 5})][c]);
    CHECK(v[layout.index({1, 2})][c] != 0);
  }
}

TEST_CASE("On graded axes a node is light by what its own spline holds") {
  Scene scene = graded_scene<2>(12, 0.5, WallKind::slip, Transfer::blend);
  scene.bodies[0].pressure = PressureSupport::particle;
  Grid<2> grid = make_grid<2>(scene);
  State<2> state;
  activate_all_blocks(grid);
  const std::array<int, 2> fine{grid.layout.base(0, 1.65), grid.layout.base(1, 2.7)};
  const double own = grid.light_mass * grid.layout.spline_width(0, fine[0]) * grid.layout.spline_width(1, fine[1]);
  CHECK(own < 0.1 * grid.light_mass);
  const int node = grid.layout.index(fine);
  grid.sum[node][3] = 2 * own;
  grid.force[node][0] = 1;
  grid.sum[node + 1][3] = 1e3 * own;  // takes what a light node cannot
  update_momentum<2>(grid, {0, 0}, dt);
  CHECK(grid.velocity[node][0] == near(dt / (2 * own), 1e-12));
  // Half as heavy as light, it keeps half of its impulse, and with it the velocity of a light node.
  grid.sum[node][3] = 0.5 * own;
  update_momentum<2>(grid, {0, 0}, dt);
  CHECK(grid.velocity[node][0] == near(dt / own, 0.0015));
}

TEST_CASE_TEMPLATE(
    "Weight by cells: the volume of filled cells is weighed, not the particles; elsewhere the particles are", Dim,
    std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
  constexpr int dim = Dim::value;
  constexpr double g = -10;
  Scene scene = box_scene<dim>(10, 0.5, WallKind::slip, Transfer::tpic);
  scene.solver.weight = Weight::cell;
  scene.bodies[0].shift = false;
  Grid<dim> grid = make_grid<dim>(scene);
  activate_all_blocks(grid);
  constexpr int surface = 7;  // the first row of cells without particles
  const auto crowd_at = [](const std::array<int, dim>& i) {
    return std::accumulate(i.begin(), i.end(), 0) % 2 == 0 ? 1.2 : 0.9;
  };
  for_each_node(grid.layout, 0, [&](int flat, const std::array<int, dim>& i) {
    const double volume = crowd_at(i) * node_measure<dim>(grid, stored_cell(grid.layout, flat));
    (dim == 2 ? grid.sum[flat][2] : grid.force[flat][3]) = volume;
    grid.sum[flat][3] = 1000 * volume;
    grid.cell_volume[flat] = i[dim - 1] < surface ? std::pow(0.5, dim) : 0.0;
    grid.cell_flags[flat] = i[dim - 1] < surface ? cell_filled : 0;
  });
  std::array<double, dim> gravity{};
  gravity[dim - 1] = g;
  const auto check = [&](Weight weight, auto&& expected) {
    update_momentum<dim>(grid, gravity, dt, weight);
    for_each_node(grid.layout, 0, [&](int flat, const std::array<int, dim>& i) {
      if (i[dim - 1] == 0 || i[dim - 1] == 10) return;  // held by a wall
      CHECK(grid.velocity[flat][dim - 1] == near(expected(i) * dt * g, 1e-12));
    });
  };
  check(Weight::particle, [](const auto&) { return 1.0; });
  // The cells in reach of a node are those of its own number and of one below and above.
  const auto by_cells = [&](const auto& i) { return i[dim - 1] < surface - 1 ? 1 / crowd_at(i) : 1.0; };
  check(Weight::cell, by_cells);
  std::array<int, dim> across;  // a cell with a part across a sharp interface
  across.fill(5);
  across[dim - 1] = 3;
  grid.taken.assign(grid.cell_volume.size(), 0.0);
  grid.taken[grid.layout.index(across)] = 0.1;
  check(Weight::cell, [&](const auto& i) {
    for (int a = 0; a < dim; ++a)
      if (std::abs(i[a] - across[a]) > 1) return by_cells(i);
    return 1.0;
  });
}

TEST_CASE_TEMPLATE("A wall is a mirror: nodes of small mass beside it share impulses as in twice the domain", Dimension,
                   std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
  constexpr int Dim = Dimension::value, middle = 6;
  Nodes<Dim> whole(2 * middle, 2, WallKind::slip, Transfer::blend), half(middle, 0, WallKind::slip, Transfer::blend);
  const auto place = [](const GridLayout<Dim>& layout, std::array<int, Dim> i, bool image) {
    if (image) i[0] = 2 * middle - i[0];
    return layout.index(i);
  };
  const auto each = [&](auto&& f) {  // nodes of the half
    for_each_node(whole.grid.layout, 0, [&](int, const std::array<int, Dim>& i) {
      for (int a = 0; a < Dim; ++a)
        if (i[a] > middle) return;
      f(i, place(half.grid.layout, i, false), place(whole.grid.layout, i, false), place(whole.grid.layout, i, true));
    });
  };
  // Along the other axes both end alike, at i = 0, and the nodes from `middle` on have no mass.
  for_each_node(whole.grid.layout, 0, [&](int flat, const std::array<int, Dim>& i) {
    for (int a = 1; a < Dim; ++a)
      if (i[a] >= middle - 1)
        whole.grid.sum[flat] = whole.grid.force[flat] = Vec4{}, whole.grid.cell_pressure[flat] = 0;
  });
  each([&](const std::array<int, Dim>& i, int of_half, int of_whole, int image) {
    for (Array<Vec4> Grid<Dim>::*field : {static_cast<Array<Vec4> Grid<Dim>::*>(&Grid<Dim>::sum),
                                          static_cast<Array<Vec4> Grid<Dim>::*>(&Grid<Dim>::force)}) {
      Vec4 value = (whole.grid.*field)[of_whole];
      if (i[0] == middle) value[0] = 0;
      (whole.grid.*field)[of_whole] = value;
      (half.grid.*field)[of_half] = i[0] == middle ? Vec4(0.5 * value) : value;
      value[0] = -value[0];
      (whole.grid.*field)[image] = value;
    }
    half.grid.cell_pressure[of_half] = whole.grid.cell_pressure[image] = whole.grid.cell_pressure[of_whole];
  });
  whole.update();
  half.update();
  int light = 0;
  each([&](const std::array<int, Dim>& i, int of_half, int of_whole, int) {
    CAPTURE(i[0]);
    const double mass = whole.grid.sum[of_whole][3];
    if (mass > 0 && mass < whole.grid.light_mass) ++light;
    const Vec4 seen = carried_velocity<Dim>(half.grid, of_half, stored_cell(half.grid.layout, of_half));
    const Vec4 expected = carried_velocity<Dim>(whole.grid, of_whole, stored_cell(whole.grid.layout, of_whole));
    for (int a = 0; a < Dim; ++a) {
      CHECK(half.grid.velocity[of_half][a] == within(whole.grid.velocity[of_whole][a], 1e-11));
      if (i[0] < middle || a > 0) CHECK(seen[a] == within(expected[a], 1e-11));
    }
  });
  CHECK(light > 3);
}
