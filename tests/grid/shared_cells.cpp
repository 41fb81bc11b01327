// Filling of cells beside a sharp interface: the share that bodies of other fields have counts as full.
#include <doctest/doctest.h>

#include "grid/cell_pressure.hpp"
#include "support/near.hpp"
#include "support/sharp_box.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

/// The grid around the bag with the volumes and pressures that the test gives cells; flags from them.
struct Beside {
  SharpBox box;

  Beside() {
    Grid<2>& grid = box.around();
    for_each_node(grid.layout, 0, [&](int cell, const auto&) { grid.cell_volume[cell] = 1 - grid.taken[cell]; });
    // Half and quarter cells at the walls.
    for_each_node(grid.layout, 0, [&](int cell, const auto& i) {
      for (const int c : i)
        if (c == 0 || c == box_cells) grid.cell_volume[cell] *= 0.5;
    });
  }
  void average(bool shift = false) { average_cell_pressure(box.state, box.around(), shift); }
  std::uint8_t flags(int i, int j) { return box.around().cell_flags[box.flat(i, j)]; }
};

}  // namespace

TEST_CASE("Water beside a bag fills its cells though the bag has a part of them") {
  Beside beside;
  Grid<2>& grid = beside.box.around();
  const int cut = beside.box.flat(6, 4);  // 0.7 of it is water
  grid.cell_pressure[cut] = 3e3 * grid.cell_volume[cut];
  beside.average(true);
  CHECK((beside.flags(6, 4) & cell_filled) != 0);
  CHECK((beside.flags(2, 4) & cell_filled) != 0);
  CHECK(grid.cell_pressure[cut] == near(3e3, 1e-13));
  CHECK((beside.flags(7, 4) & cell_shiftable) != 0);
  CHECK((beside.flags(6, 4) & cell_shiftable) != 0);  // a sharp membrane is no bar to shifting
}

TEST_CASE("A cell that is all the bag's counts as filled for its neighbours, without a pressure of its own") {
  Beside beside;
  Grid<2>& grid = beside.box.around();
  const int whole = beside.box.flat(5, 4);
  CHECK(grid.cell_volume[whole] == near_zero(1e-15));
  grid.cell_volume[whole] = 0;
  grid.cell_pressure[whole] = 5e3;  // of nobody
  beside.average();
  CHECK((beside.flags(5, 4) & cell_filled) != 0);
  CHECK(grid.cell_pressure[whole] == 0);
}

TEST_CASE("Without water beside it the bag's share alone does not fill a cell") {
  Beside beside;
  Grid<2>& grid = beside.box.around();
  for_each_node(grid.layout, 0, [&](int cell, const auto& i) {
    if (i[0] >= 6) grid.cell_volume[cell] = 0;
  });
  beside.average();
  CHECK((beside.flags(7, 4) & cell_filled) == 0);
  CHECK((beside.flags(2, 4) & cell_filled) != 0);
  CHECK((beside.flags(6, 4) & cell_filled) == 0);  // (1 + 2 * 0.3 + 0) / 4 of it, of 0.7
  CHECK((beside.flags(5, 4) & cell_filled) != 0);  // (1 + 2 * 1 + 0.3) / 4
}

TEST_CASE("A membrane in a mixture keeps particles from shifting around it") {
  Beside beside;
  std::fill(beside.box.around().taken.begin(), beside.box.around().taken.end(), 0.0);
  for_each_node(beside.box.around().layout, 0, [&](int cell, const auto& i) {
    beside.box.around().cell_volume[cell] = 1;
    for (const int c : i)
      if (c == 0 || c == box_cells) beside.box.around().cell_volume[cell] *= 0.5;
  });
  beside.box.skin().sharp = false;
  beside.average(true);
  CHECK((beside.flags(9, 9) & cell_shiftable) != 0);
  for (const auto& [i, j] : {std::pair{3, 3}, {2, 3}, {6, 5}, {7, 7}}) {
    CAPTURE(i);
    CHECK((beside.flags(i, j) & cell_filled) != 0);
    CHECK((beside.flags(i, j) & cell_shiftable) == 0);
  }
}
