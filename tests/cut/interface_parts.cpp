// Parts of cut cells on a grid by hand: shares, hosts, shared pressure, evening out, the other side, force and rate.
#include <doctest/doctest.h>

#include <geodrop/base/error.hpp>

#include "cut/cell_slopes.hpp"
#include "cut/even_out_volumes.hpp"
#include "cut/interface_cells.hpp"
#include "cut/other_sides.hpp"
#include "support/near.hpp"
#include "support/sharp_box.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

/// The bag has 0.75 of the cells in column 3 and of those in rows 3 and 6, 0.3 of those in column 6; all is full.
SharpBox full(const Corners& at = {}) {
  SharpBox box(at);
  box.fill_cells();
  return box;
}

bool room_for(const Corners& at) {
  try {
    const SharpBox box(at);
  } catch (const RunError& error) {
    CHECK(std::string(error.what()).find("'skin' came within half a cell of a wall") != std::string::npos);
    return false;
  }
  return true;
}

double total_fill(const Grid<2>& grid) {
  double sum = 0;
  for (const Vec4& v : grid.velocity) sum += v[3];
  return sum;
}

}  // namespace

TEST_CASE("Each side has the share of a cell that the outline leaves it") {
  for (const Sense sense : {Sense::anticlockwise, Sense::clockwise}) {
    SharpBox box({}, sense);
    struct Cell {
      int i, j;
      double inside;
    };
    for (const Cell& cell : {Cell{3, 4, 0.75}, Cell{3, 3, 0.5625}, Cell{6, 4, 0.3}, Cell{6, 6, 0.225}, Cell{4, 4, 1.0},
                             Cell{4, 6, 0.75}, Cell{2, 4, 0.0}, Cell{7, 7, 0.0}}) {
      CAPTURE(cell.i);
      CAPTURE(cell.j);
      CHECK(box.inside().taken[box.flat(cell.i, cell.j)] == within(1 - cell.inside, 1e-14));
      CHECK(box.around().taken[box.flat(cell.i, cell.j)] == within(cell.inside, 1e-14));
    }
    CHECK(box.around().taken[box.flat(9, 9)] == 0);
  }
}

TEST_CASE("Where the membrane has left nothing is taken any more, nor by one that waits") {
  SharpBox box;
  box.draw({7.75, 9.25, 7.75, 9.25}, Sense::anticlockwise);
  cut_interface_cells(box.state, box.grids);
  for (Grid<2>& grid : box.grids) CHECK(grid.taken[box.flat(3, 4)] == 0);
  CHECK(box.around().taken[box.flat(8, 8)] == near(0.5625, 1e-14));
  box.skin().field = waiting;
  cut_interface_cells(box.state, box.grids);
  CHECK(box.around().taken[box.flat(8, 8)] == 0);
}

TEST_CASE("An outline keeps half a cell away from walls") {
  CHECK(room_for({0.6, 5.8, 2.75, 6.25}));
  CHECK_FALSE(room_for({0.4, 5.8, 2.75, 6.25}));
  CHECK(room_for({2.75, 5.8, 0.6, 6.25}));
  CHECK_FALSE(room_for({2.75, 5.8, 0.4, 6.25}));
  CHECK(room_for({2.75, box_cells - 0.6, 2.75, 6.25}));
  CHECK_FALSE(room_for({2.75, box_cells - 0.4, 2.75, 6.25}));
  CHECK_FALSE(room_for({2.75, 5.8, 2.75, box_cells - 0.4}));
}

TEST_CASE("A part stands by itself from half a cell on, 0.3 of it filled; else it joins the next cell on its side") {
  SharpBox box = full();
  const auto hosts = [&] {
    share_interface_pressure(box.state, box.grids);
    return std::array{box.part(box.inside(), 3, 4).host, box.part(box.inside(), 6, 4).host,
                      box.part(box.around(), 3, 4).host, box.part(box.around(), 6, 4).host};
  };
  CHECK(hosts() == std::array{box.flat(3, 4), box.flat(5, 4), box.flat(2, 4), box.flat(6, 4)});
  for (const double filled : {0.301, 0.299}) {
    CAPTURE(filled);
    box = full();
    box.inside().cell_volume[box.flat(3, 4)] = box.around().cell_volume[box.flat(6, 4)] = filled;
    const bool stands = filled > 0.3;
    CHECK(hosts()[0] == box.flat(stands ? 3 : 4, 4));
    CHECK(hosts()[3] == box.flat(stands ? 6 : 7, 4));
  }
  // Just more and just less than half of a cell.
  box = full({2.99, 5.51, 2.75, 6.25});
  CHECK(hosts()[0] == box.flat(3, 4));
  box = full({3.01, 5.51, 2.75, 6.25});
  CHECK(hosts()[0] == box.flat(4, 4));
}

TEST_CASE("Water in pores stands by itself if it fills 0.3 of what the grains leave it") {
  for (const double filled : {0.061, 0.059}) {  // a part of 0.75, grains in 0.55
    SharpBox box = full();
    Grid<2>& grid = box.inside();
    const int cell = box.flat(3, 4);
    grid.occupied.assign(grid.layout.nodes(), 0.0);
    grid.occupied[cell] = 0.55;
    grid.cell_volume[cell] = filled;
    share_interface_pressure(box.state, box.grids);
    CHECK(box.part(grid, 3, 4).host == box.flat(filled > 0.06 ? 3 : 4, 4));
  }
}

TEST_CASE("Of a thin bag both flanks have water of their own side") {
  SharpBox box = full({4.75, 5.25, 2.75, 8.25});
  share_interface_pressure(box.state, box.grids);
  CHECK(box.part(box.around(), 5, 6).host == box.flat(5, 6));  // half of the cell is water
  box = full({4.6, 5.2, 2.75, 8.25});
  share_interface_pressure(box.state, box.grids);
  CHECK(box.part(box.around(), 5, 6).host == box.flat(4, 6));  // two flanks in one cell: the first nearby
  CHECK(box.part(box.inside(), 5, 6).host == box.flat(5, 6));
}

TEST_CASE("Host and guest have one pressure, the mean over their volumes; cells beside have their own") {
  SharpBox box = full();
  Grid<2>& inside = box.inside();
  inside.cell_pressure[box.flat(5, 4)] = 2e3;
  inside.cell_pressure[box.flat(6, 4)] = 8e3;
  inside.cell_pressure[box.flat(4, 4)] = 5e3;
  share_interface_pressure(box.state, box.grids);
  const double shared = (2e3 * 1 + 8e3 * 0.3) / 1.3;
  CHECK(inside.cell_pressure[box.flat(5, 4)] == near(shared, 1e-13));
  CHECK(inside.cell_pressure[box.flat(6, 4)] == near(shared, 1e-13));
  CHECK(inside.cell_pressure[box.flat(4, 4)] == 5e3);
  CHECK((inside.cell_flags[box.flat(6, 4)] & cell_filled) != 0);
}

TEST_CASE("What has nothing beside it leaves the pressure to its particles") {
  SharpBox box = full();
  Grid<2>& around = box.around();
  std::fill(around.cell_volume.begin(), around.cell_volume.end(), 0.0);
  const int cell = box.flat(6, 4);
  around.cell_pressure[cell] = 5e3;
  around.cell_flags[cell] = cell_filled;
  share_interface_pressure(box.state, box.grids);
  CHECK(box.part(around, 6, 4).host == -1);
  CHECK(around.cell_pressure[cell] == 0);
  CHECK(around.cell_flags[cell] == 0);
}

TEST_CASE(
    "Of coupled soil skeleton and pore water have parts each; a skeleton with the pressure of particles has none") {
  for (const bool of_cells : {true, false}) {
    CAPTURE(of_cells);
    SharpBox box = full();
    Grid<2> water = box.inside();
    box.inside().largest_modulus = of_cells ? 2e6 : 0;
    box.inside().pore_water = water.field = 2;
    box.grids.push_back(water);
    cut_interface_cells(box.state, box.grids);
    Grid<2>&skeleton = box.inside(), &pores = box.grids[2];
    pores.cell_volume[box.flat(3, 4)] = 0.1;  // too little of its own; the skeleton has enough
    skeleton.cell_pressure[box.flat(5, 4)] = 2e3;
    skeleton.cell_pressure[box.flat(6, 4)] = 8e3;
    share_interface_pressure(box.state, box.grids);
    CHECK(box.part(pores, 3, 4).host == box.flat(4, 4));
    REQUIRE(skeleton.part_cells.empty() != of_cells);
    if (!of_cells) continue;
    CHECK(box.part(skeleton, 3, 4).host == box.flat(3, 4));
    for (const int column : {3, 6}) {
      const PartCell<2>&one = box.part(skeleton, column, 4), &other = box.part(pores, column, 4);
      CHECK(one.slope == other.slope);
      CHECK(one.elsewhere == other.elsewhere);
    }
    CHECK(skeleton.cell_pressure[box.flat(6, 4)] == near((2e3 * 1 + 8e3 * 0.3) / 1.3, 1e-13));
  }
}

TEST_CASE("int grad N over the part of a cell inside, by hand; the part outside has the rest of the cell") {
  for (const Sense sense : {Sense::anticlockwise, Sense::clockwise}) {
    SharpBox box({}, sense);
    box.fill_cells();
    share_interface_pressure(box.state, box.grids);
    const PartCell<2>&in = box.part(box.inside(), 3, 4), &out = box.part(box.around(), 3, 4);
    // From x = 2.75 to 3.5 of the cell around 3, over its whole height.
    const double rise[] = {0.0 - 0.28125, 0.5 - 0.6875, 0.5 - 0.03125};
    const std::array<double, 3> to_edge = integrals_to({1.0}, -0.25);
    const double along[] = {1.0 / 6, 2.0 / 3, 1.0 / 6}, slope_y[] = {-0.5, 0, 0.5};
    const Slope<2> whole = whole_cell<2>({SpanShape{1.0}, SpanShape{1.0}});
    for (int n = 0; n < 9; ++n) {
      const int x = n % 3, y = n / 3;
      const double value_x = along[x] - to_edge[x];
      CHECK(in.slope[n][0] == within(rise[x] * along[y], 1e-14));
      CHECK(in.slope[n][1] == within(value_x * slope_y[y], 1e-14));
      CHECK(in.elsewhere[n] == near(to_edge[x] * along[y], 1e-12));
      CHECK(out.elsewhere[n] == near(value_x * along[y], 1e-12));
      for (int a = 0; a < 2; ++a) CHECK(in.slope[n][a] + out.slope[n][a] == within(whole[n][a], 1e-14));
    }
  }
}

TEST_CASE("What a membrane sweeps over as it moves is the integral of N along it") {
  constexpr double step = 1e-5;
  const auto rest_of_cell = [](double left) {
    SharpBox box = full({left, 5.8, 2.75, 6.25});
    share_interface_pressure(box.state, box.grids);
    return box.part(box.inside(), 3, 4).elsewhere;
  };
  const std::array<double, 9> before = rest_of_cell(2.75 - step), after = rest_of_cell(2.75 + step);
  const double at[] = {0.28125, 0.6875, 0.03125}, along[] = {1.0 / 6, 2.0 / 3, 1.0 / 6};  // N at x = 2.75; int N
  for (int n = 0; n < 9; ++n)
    CHECK((after[n] - before[n]) / (2 * step) == within(at[n % 3] * along[n / 3], 1e-9));  // N'' / 6 of the square
}

TEST_CASE("Volume ratios near their cell's mean by 0.1 c dt / h of the difference") {
  SharpBox box;
  Body<2>& water = box.state.bodies[0];
  water = blank_body<2>(Newtonian{box_density, box_bulk_modulus, 0}, 3);
  water.name = "pool";
  water.pressure = PressureSupport::cell;
  water.x = {Array<double>{9.0, 9.2, 1.0}, Array<double>{9.0, 9.4, 9.0}};
  const Array<double> before{0.97, 1.01, 0.97};
  box.around().cell_flags[box.flat(9, 9)] = cell_filled;
  box.around().cell_pressure[box.flat(9, 9)] = 2e4;  // J = 1 / 1.02
  const double dt = 0.01, share = 0.1 * std::sqrt(box_bulk_modulus / box_density) * dt;
  const auto after = [&] {
    water.J = before;
    even_out_volumes(box.state, box.grids, dt);
    return water.J;
  };
  for (int p = 0; p < 2; ++p) CHECK(after()[p] == near(before[p] + share * (1 / 1.02 - before[p]), 1e-14));
  CHECK(after()[2] == before[2]);  // its cell is not filled
  water.material = Newtonian{box_density, box_bulk_modulus, 0, 0, 0.005 * box_bulk_modulus};
  CHECK(after()[0] == near(before[0] + share * (1 / 1.02 - before[0]), 1e-14));
  CHECK(after()[1] == before[1]);  // torn beyond J = 1 / 0.995
  water.material = Newtonian{box_density, box_bulk_modulus, 0};
  water.pressure = PressureSupport::particle;
  CHECK(after() == before);
  water.pressure = PressureSupport::cell;
  water.field = waiting;
  CHECK(after() == before);
  water.field = 0;
  water.material = LinearElastic{box_density, 2e6, 1e6};
  CHECK(after() == before);
}

TEST_CASE("On graded axes the narrower width of the cell counts") {
  SharpBox box;
  const Scene fine = graded_scene<2>(box_cells, 1.0, WallKind::slip);
  box.around().layout = GridLayout<2>(fine.grid, fine.walls);
  const GridLayout<2>& layout = box.around().layout;
  Body<2>& water = box.state.bodies[0];
  water = blank_body<2>(Newtonian{box_density, box_bulk_modulus, 0}, 1);
  water.pressure = PressureSupport::cell;
  water.x = {Array<double>{3.2}, Array<double>{11.0}};
  water.J = {0.97};
  const int cell = layout.index({layout.base(0, 3.2), layout.base(1, 11.0)});
  const std::size_t nodes = layout.nodes();
  box.around().cell_flags.assign(nodes, cell_filled);
  box.around().cell_pressure.assign(nodes, 0.0);
  REQUIRE(least_width(layout, cell) < 0.9 * span_of(layout, 1, cell).width);
  even_out_volumes(box.state, box.grids, 1e-3);
  const double share = 0.1 * std::sqrt(box_bulk_modulus / box_density) * 1e-3 / least_width(layout, cell);
  CHECK(water.J[0] == near(0.97 + share * 0.03, 1e-13));
}

TEST_CASE("The other side counts as full: its area in all, 1 at nodes that see nothing else") {
  SharpBox box = full();
  share_interface_pressure(box.state, box.grids);
  for (Grid<2>& grid : box.grids) std::fill(grid.velocity.begin(), grid.velocity.end(), Vec4{});
  fill_other_sides(box.state, box.grids);
  const double bag = 3.05 * 3.5, all = 6 * 6;  // cells 2 to 7 along both axes
  CHECK(total_fill(box.around()) == near(bag, 1e-12));
  CHECK(total_fill(box.inside()) == near(all - bag, 1e-12));
  // Node (4, 4): its spline reaches from 2.5 to 5.5 along both axes, the bag begins at 2.75.
  const double inside = 1 - 0.015625 / 6;
  CHECK(box.around().velocity[box.flat(4, 4)][3] == near(inside * inside, 1e-12));
  CHECK(box.inside().velocity[box.flat(4, 4)][3] == near(1 - inside * inside, 1e-11));
  CHECK(box.around().velocity[box.flat(8, 8)][3] == 0);
}

TEST_CASE("Beside a wall the other side counts with its mirror image, so that nothing shifts through the wall") {
  SharpBox box({.left = 0.75, .right = 5.8, .bottom = 0.8, .top = 6.25});
  box.set_mass(box.around(), 1000);
  box.set_mass(box.inside(), 1000);
  box.fill_cells();
  share_interface_pressure(box.state, box.grids);
  for (Grid<2>& grid : box.grids) std::fill(grid.velocity.begin(), grid.velocity.end(), Vec4{});
  fill_other_sides(box.state, box.grids);
  const auto fill = [&](int i, int j) { return box.around().velocity[box.flat(i, j)][3]; };
  // The spline of a node on a wall over what is farther than s from it, on both sides: 2 (3/2 - s)^3 / 6.
  const auto beyond = [](double s) { return std::pow(1.5 - s, 3) / 3; };
  CHECK(fill(0, 4) == near(beyond(0.75), 1e-12));
  CHECK(fill(4, 0) == near(beyond(0.8), 1e-12));
  CHECK(fill(0, 0) == near(beyond(0.75) * beyond(0.8), 1e-11));
  for (int k = 0; k < 6; ++k) {
    CHECK(fill(-1, k) == fill(1, k));
    CHECK(fill(k, -1) == fill(k, 1));
  }
}

TEST_CASE("The force of a part replaces that of its whole cell, pressure times the difference of their integrals") {
  SharpBox box;
  Grid<2>& grid = box.inside();
  PartCell<2> part{box.flat(5, 5), -1};
  part.slope[8] = {0.7, -0.2};
  grid.part_cells = {part};
  grid.cell_pressure[part.flat] = 100;
  grid.force[box.flat(6, 6)] = Vec4{1, 2, 0, 0};
  add_interface_force(box.grids, 1e-6);
  CHECK(grid.force[box.flat(6, 6)][0] == near(1 + 100 * (0.7 - 0.5 / 6), 1e-13));
  CHECK(grid.force[box.flat(6, 6)][1] == near(2 + 100 * (-0.2 - 0.5 / 6), 1e-13));
  CHECK(grid.force[box.flat(4, 4)][0] == near(100 * 0.5 / 6, 1e-13));
  CHECK(grid.force[box.flat(5, 5)][0] == 0);
}

TEST_CASE("A group has one volume rate: the flow out of all its parts over their volume") {
  SharpBox box;
  Grid<2>& grid = box.inside();
  const int host = box.flat(5, 5), guest = box.flat(6, 5);
  PartCell<2> one{host, host}, two{guest, host}, alone{box.flat(8, 8), -1};
  one.slope[4] = {2, 0};
  two.slope[4] = {0, 3};
  alone.slope[4] = {5, 5};
  grid.part_cells = {alone, one, two};
  grid.cell_volume[host] = 1.0;
  grid.cell_volume[guest] = 0.25;
  grid.velocity[host] = Vec4{0.1, 9, 0, 0};
  grid.velocity[guest] = Vec4{9, -0.2, 0, 0};
  grid.velocity[box.flat(8, 8)] = Vec4{1, 1, 0, 0};
  update_interface_rates(box.grids);
  for (const int cell : {host, guest}) CHECK(grid.volume_rate[cell] == near((2 * 0.1 - 3 * 0.2) / 1.25, 1e-14));
  CHECK(grid.volume_rate[box.flat(8, 8)] == 0);
  for (PartCell<2>& part : grid.part_cells) part.share = 0.5;  // of one too stiff for the step
  update_interface_rates(box.grids);
  CHECK(grid.volume_rate[guest] == near(0.5 * (2 * 0.1 - 3 * 0.2) / 1.25, 1e-14));
}
