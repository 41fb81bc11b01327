// Which cells have more volume than room, or less.
#include <doctest/doctest.h>

#include "grid/crowding.hpp"
#include "support/near.hpp"
#include "support/random_particles.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double h = 0.5;

/// A box of water all of whose cells are shiftable, by the fill ratio of its nodes.
template <int Dim, class F>
Grid<Dim> full_box(Scene scene, F&& fill_ratio) {
  scene.bodies[0].shift = true;
  scene.bodies[0].shift_speed = 0.5;
  Grid<Dim> grid = make_grid<Dim>(scene);
  activate_all_blocks(grid);
  for_each_node(grid.layout, 2, [&](int flat, const std::array<int, Dim>& i) {
    grid.velocity[flat] = Vec4{0, 0, 0, fill_ratio(i)};
    grid.cell_flags[flat] = cell_filled | cell_shiftable;
  });
  return grid;
}

template <int Dim>
std::array<int, Dim> at(int i, int j) {
  std::array<int, Dim> cell;
  cell.fill(j);
  cell[0] = i;
  return cell;
}

}  // namespace

TEST_CASE_TEMPLATE("Crowding is what the fill ratio passes 1 by, but for 3 percent", Size,
                   std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
  constexpr int Dim = Size::value;
  Grid<Dim> grid = full_box<Dim>(box_scene<Dim>(8, h, WallKind::slip),
                                 [](const std::array<int, Dim>& i) { return 1 + 0.02 * (i[0] - 4); });
  find_crowding(grid);
  const auto crowding = [&](int i) { return grid.crowding[grid.layout.index(at<Dim>(i, 3))]; };
  CHECK(crowding(2) == near(-0.01, 1e-13));  // the fill ratio is 0.96
  CHECK(crowding(3) == 0);
  CHECK(crowding(5) == 0);  // 1.02
  CHECK(crowding(6) == near(0.01, 1e-13));
}

TEST_CASE_TEMPLATE("Cells at walls and in corners crowd as those inside", Size, std::integral_constant<int, 2>,
                   std::integral_constant<int, 3>) {
  constexpr int Dim = Size::value;
  for (const Scene& scene : {box_scene<Dim>(6, h, WallKind::slip), box_scene<Dim>(6, h, WallKind::no_slip),
                             graded_scene<Dim>(6, h, WallKind::slip), graded_scene<Dim>(6, h, WallKind::no_slip)}) {
    Grid<Dim> grid = full_box<Dim>(scene, [](const std::array<int, Dim>&) { return 1.05; });
    find_crowding(grid);
    const int last = grid.layout.cells[0];
    for (const auto& cell : {at<Dim>(3, 3), at<Dim>(0, 3), at<Dim>(0, 0), at<Dim>(last, last)})
      CHECK(grid.crowding[grid.layout.index(cell)] == near(0.02, 1e-13));
  }
}

TEST_CASE("A cell that is not shiftable is not crowded, and nothing beside it is thin") {
  for (const double ratio : {1.05, 0.95}) {
    CAPTURE(ratio);
    Grid<2> grid = full_box<2>(box_scene<2>(8, h, WallKind::slip), [ratio](const auto&) { return ratio; });
    grid.cell_flags[grid.layout.index({3, 3})] = cell_filled;
    find_crowding(grid);
    CHECK(grid.crowding[grid.layout.index({3, 3})] == 0);
    CHECK(grid.crowding[grid.layout.index({4, 4})] == within(ratio > 1 ? 0.02 : 0, 1e-13));
    CHECK(grid.crowding[grid.layout.index({5, 4})] == near(ratio > 1 ? 0.02 : -0.02, 1e-13));
  }
}

TEST_CASE("Only water that shifts at rest, too, has a crowding") {
  Scene scene = box_scene<2>(4, h, WallKind::slip);
  CHECK(make_grid<2>(scene).crowding.empty());
  scene.bodies[0].shift = true;
  CHECK(make_grid<2>(scene).crowding.empty());
  scene.bodies[0].shift_speed = 0.5;
  CHECK_FALSE(make_grid<2>(scene).crowding.empty());
}
