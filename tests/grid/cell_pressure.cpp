// Cell pressure and volume rate: an adjoint pair; a uniform pressure pushes nothing; a linear field has its divergence.
#include "grid/cell_pressure.hpp"

#include <doctest/doctest.h>

#include "grid/blocks.hpp"
#include "support/near.hpp"
#include "support/random_particles.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

/// A small box in which every cell touches a wall or its neighbour does, or a larger one with an interior.
template <int Dim>
struct Box {
  Grid<Dim> grid;
  State<Dim> state;

  Box(int cells, WallKind wall) : Box(box_scene<Dim>(cells, 0.25, wall)) {}
  explicit Box(const Scene& scene) : grid(make_grid<Dim>(scene)) {
    activate_all_blocks(grid);
    for_each_node(grid.layout, 0, [&](int flat, const auto&) { grid.volume_rate[flat] = 1; });  // no cell is softened
  }

  /// Cell pressure's force on all nodes [N].
  std::vector<Vec4> forces() const {
    std::vector<Vec4> out(grid.layout.nodes(), Vec4{});
    for (const std::uint32_t block : grid.active_blocks)
      for_each_real_row_of_block(grid.layout, block, [&](int begin, int count, const std::array<int, Dim>& node) {
        const RowForce<Dim> row = cell_pressure_force<Dim>(grid, begin, count, node);
        for (int k = 0; k < count; ++k)
          for (int a = 0; a < Dim; ++a) out[begin + k][a] = row[a][k];
      });
    return out;
  }

  bool on_wall(const std::array<int, Dim>& i, int axis) const {
    return i[axis] == 0 || i[axis] == grid.layout.cells[axis];
  }
};

/// sum f . v = sum P V D for random pressures, masses and velocities that the walls allow, some cells softened, P
/// before that; returned relative to sum |f . v|.
template <int Dim>
double adjoint_error(Box<Dim> box, unsigned seed) {
  const WallKind wall = box.grid.layout.lower_wall[0];
  Random random(seed);
  Grid<Dim>& grid = box.grid;
  for_each_node(grid.layout, 0, [&](int flat, const std::array<int, Dim>& i) {
    const bool filled = random.uniform(0, 1) < 0.8;
    grid.cell_flags[flat] = filled ? cell_filled : 0;
    grid.cell_pressure[flat] = filled ? random.uniform(-1e3, 1e4) : 0;
    grid.cell_volume[flat] = random.uniform(0.001, 0.1);
    grid.sum[flat][3] = random.uniform(0, 1) < 0.5 ? 60 : 1;
    bool stuck = false;
    for (int a = 0; a < Dim; ++a) stuck = stuck || (box.on_wall(i, a) && wall == WallKind::no_slip);
    for (int a = 0; a < Dim; ++a) grid.velocity[flat][a] = stuck || box.on_wall(i, a) ? 0 : random.uniform(-1, 1);
  });
  const Array<double> pressure = grid.cell_pressure;
  soften_light_cells(grid, 0.1);
  const auto softened = [](double share) { return share > 0 && share < 1; };
  REQUIRE(std::count_if(grid.volume_rate.begin(), grid.volume_rate.end(), softened) > 0);
  const auto force = box.forces();
  cell_volume_rate(grid);
  double power = 0, size = 0, stored = 0;
  for_each_node(grid.layout, 0, [&](int flat, const auto&) {
    for (int a = 0; a < Dim; ++a) {
      power += force[flat][a] * grid.velocity[flat][a];
      size += std::abs(force[flat][a] * grid.velocity[flat][a]);
    }
    stored += pressure[flat] * grid.cell_volume[flat] * grid.volume_rate[flat];
  });
  REQUIRE(size > 0);
  return std::abs(power - stored) / size;
}

template <int Dim>
double adjoint_error(int cells, WallKind wall, unsigned seed) {
  return adjoint_error<Dim>(Box<Dim>(cells, wall), seed);
}

/// Largest force of a pressure of 1e5 Pa in all cells on a node, along the axes along which the node can move [N].
template <int Dim>
double push_of_uniform_pressure(Box<Dim> box) {
  for_each_node(box.grid.layout, 0, [&](int flat, const auto&) { box.grid.cell_pressure[flat] = 1e5; });
  const auto force = box.forces();
  double largest = 0;
  for_each_node(box.grid.layout, 0, [&](int flat, const std::array<int, Dim>& i) {
    for (int a = 0; a < Dim; ++a)
      if (!box.on_wall(i, a)) largest = std::max(largest, std::abs(force[flat][a]));
  });
  return largest;
}

/// Largest error of the volume rate of a velocity linear in space, in full cells away from the upper walls, which do
/// not move with the field [1/s].
template <int Dim>
double divergence_error(Box<Dim> box) {
  Grid<Dim>& grid = box.grid;
  const GridLayout<Dim>& layout = grid.layout;
  const double rate[3] = {2.0, -0.5, 0.75};
  double trace = 0;
  for (int a = 0; a < Dim; ++a) trace += rate[a];
  for_each_node(layout, 0, [&](int flat, const std::array<int, Dim>& i) {
    grid.cell_flags[flat] = cell_filled;
    double volume = 1;
    for (int a = 0; a < Dim; ++a) {
      grid.velocity[flat][a] = rate[a] * layout.node(a, i[a]);  // zero on the lower walls only
      volume *= layout.h * layout.span_width(a, i[a]) * (box.on_wall(i, a) ? 0.5 : 1.0);
    }
    grid.cell_volume[flat] = volume;
  });
  cell_volume_rate(grid);
  double largest = 0;
  for_each_node(layout, 0, [&](int flat, const std::array<int, Dim>& i) {
    bool below_upper = true;
    for (int a = 0; a < Dim; ++a) below_upper = below_upper && i[a] < layout.cells[a] - 1;
    if (below_upper) largest = std::max(largest, std::abs(grid.volume_rate[flat] - trace));
  });
  return largest;
}

}  // namespace

TEST_CASE("The power of the cell pressure is the volume rate that the pressure sees") {
  for (const WallKind wall : {WallKind::slip, WallKind::no_slip})
    for (const int cells : {3, 4, 7, 40}) {
      CAPTURE(cells);
      CHECK(adjoint_error<2>(cells, wall, 3) < 1e-13);
    }
  for (const WallKind wall : {WallKind::slip, WallKind::no_slip})
    for (const int cells : {3, 9}) {
      CAPTURE(cells);
      CHECK(adjoint_error<3>(cells, wall, 4) < 1e-13);
    }
}

TEST_CASE_TEMPLATE("A uniform pressure between slip walls pushes no node that can move", Size,
                   std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
  constexpr int Dim = Size::value;
  CHECK(push_of_uniform_pressure(Box<Dim>(9, WallKind::slip)) < 1e-15 * 1e5);
  CHECK(push_of_uniform_pressure(Box<Dim>(graded_scene<Dim>(9, 0.25, WallKind::slip))) < 1e-15 * 1e5);
}

TEST_CASE("A pressure that grows linearly pushes each interior node by -grad p times its volume") {
  Box<2> box(20, WallKind::slip);
  const double h = box.grid.layout.h, slope[2] = {300, -700};
  for_each_node(box.grid.layout, 0, [&](int flat, const std::array<int, 2>& i) {
    box.grid.cell_pressure[flat] = h * (slope[0] * i[0] + slope[1] * i[1]);
  });
  const auto force = box.forces();
  const int node = box.grid.layout.index({9, 11}), beside_wall = box.grid.layout.index({9, 2});
  for (int a = 0; a < 2; ++a) {
    CHECK(force[node][a] == near(-slope[a] * h * h, 1e-11));
    CHECK(force[beside_wall][a] == near(-slope[a] * h * h, 1e-11));
  }
}

TEST_CASE_TEMPLATE("A velocity linear in space has its divergence in every full cell, also at the walls it respects",
                   Size, std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
  constexpr int Dim = Size::value;
  CHECK(divergence_error(Box<Dim>(9, WallKind::slip)) < 1e-13);
  CHECK(divergence_error(Box<Dim>(graded_scene<Dim>(9, 0.25, WallKind::slip))) < 1e-13);
}

TEST_CASE("A cell that is not filled has no volume rate") {
  Box<2> box(6, WallKind::slip);
  for_each_node(box.grid.layout, 0, [&](int flat, const std::array<int, 2>& i) {
    box.grid.velocity[flat][0] = i[0];
    box.grid.cell_volume[flat] = 0.01;
    box.grid.cell_flags[flat] = cell_shiftable;
  });
  cell_volume_rate(box.grid);
  for (const double rate : box.grid.volume_rate) CHECK(rate == 0);
}

TEST_CASE_TEMPLATE("On graded axes force and volume rate are an adjoint pair, too", Size,
                   std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
  for (const WallKind wall : {WallKind::slip, WallKind::no_slip})
    for (const int cells : {2, 9}) {
      CAPTURE(cells);
      CHECK(adjoint_error<Size::value>(Box<Size::value>(graded_scene<Size::value>(cells, 0.25, wall)), 5) < 1e-13);
    }
}
