// Which cells of an enclosed fluid stand by themselves, and which join another one.
#include <doctest/doctest.h>

#include "cut/cut_cells.hpp"
#include "cut/enclosed_fluid.hpp"
#include "support/random_particles.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double h = 0.25;

/// A box of fluid, nine particles a cell, its right edge `overhang` beyond the middle of a cell; one cell in the midst
/// of it keeps `kept` of its nine. Cells are centred on multiples of h.
struct Tank {
  State<2> state;
  Grid<2> grid;
  const std::array<double, 2> sparse{8 * h, 8 * h};

  Tank(int kept, double overhang) {
    Scene scene = box_scene<2>(16, h, WallKind::slip);
    scene.materials = {{"stuff", NewtonianSpec{1000, 1e6, 0}, {}}};
    scene.bodies[0].pressure = PressureSupport::enclosed;
    grid = make_grid<2>(scene);
    const double low = 4.5 * h, right = 11 * h + overhang, top = 11.5 * h;
    Membrane<2> m;
    m.name = "skin";
    m.body = "body";
    m.x = {Array<double>{low, right, right, low}, Array<double>{low, low, top, top}};
    m.mass.assign(4, 1.0);
    state.membranes = {m};
    const Body<2> lattice = lattice_body<2>(grid.layout, Newtonian{1000, 1e6, 0}, 3);
    std::array<Array<double>, 2> inside;
    for (std::size_t p = 0; p < lattice.size(); ++p) {
      // The lattice's cells begin at nodes: move it by half a cell.
      const double x = lattice.x[0][p] + 0.5 * h, y = lattice.x[1][p] + 0.5 * h;
      if (x < low || x > right || y < low || y > top) continue;
      const bool in_sparse = std::abs(x - sparse[0]) < 0.5 * h && std::abs(y - sparse[1]) < 0.5 * h;
      if (in_sparse && kept-- <= 0) continue;
      inside[0].push_back(x);
      inside[1].push_back(y);
    }
    Body<2> body = blank_body<2>(lattice.material, inside[0].size());
    body.x = inside;
    body.pressure = PressureSupport::enclosed;
    body.enclosed = 0;
    body.mass.assign(body.size(), lattice.mass[0]);
    state.bodies = {body};
    update_enclosed_cells(state, grid);
  }

  /// Offset in cells from the cell at a place to its host.
  std::array<int, 2> way_to_host(double x, double y) const {
    const EnclosedCells& cells = grid.enclosed[0];
    const int cell = local_cell(grid.layout, cells, x, y), host = cells.host[cell], nx = cells.count[0];
    return {host % nx - cell % nx, host / nx - cell / nx};
  }
};

}  // namespace

TEST_CASE("A cell inside stands by itself from 0.3 of its area filled, else it joins its neighbour below") {
  const auto way = [](int kept) {
    const Tank tank(kept, 0.4 * h);
    return tank.way_to_host(tank.sparse[0], tank.sparse[1]);
  };
  CHECK(way(9) == std::array{0, 0});
  CHECK(way(4) == std::array{0, 0});
  CHECK(way(3) == std::array{0, 0});   // 0.33
  CHECK(way(2) == std::array{0, -1});  // 0.22
  CHECK(way(0) == std::array{0, -1});
}

TEST_CASE("A cell that the membrane cuts stands by itself if half of it lies inside") {
  const auto way = [](double overhang) { return Tank(9, overhang * h).way_to_host(11 * h, 8 * h); };
  CHECK(way(0.2) == std::array{0, 0});    // 0.7 of it inside, two of three columns of particles
  CHECK(way(-0.1) == std::array{-1, 0});  // 0.4 of it inside, filled by a third
}
