// Particles of fluids that come closer than their size are pushed apart, and nothing else moves.
#include "grid/spread_particles.hpp"

#include <doctest/doctest.h>

#include "support/near.hpp"
#include "support/random_particles.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double h = 0.5, size = h / 2;  // of particles, two a cell and axis
const Material water = Newtonian{1000, 1e6, 0};

/// All of whose cells are full.
template <int Dim>
Grid<Dim> full_box(Scene scene) {
  scene.bodies[0].shift = true;
  Grid<Dim> grid = make_grid<Dim>(scene);
  std::fill(grid.cell_flags.begin(), grid.cell_flags.end(), cell_filled | cell_shiftable);
  return grid;
}

/// Particles in a row along the first axis, in the middle of the box along the others.
template <int Dim>
Body<Dim> row_of(const std::vector<double>& x, double middle) {
  Body<Dim> body = blank_body<Dim>(water, x.size());
  for (int a = 0; a < Dim; ++a) body.x[a].assign(x.size(), middle);
  body.x[0].assign(x.begin(), x.end());
  body.mass.assign(x.size(), reference_density(water) * std::pow(size, Dim));
  return body;
}

template <int Dim>
double distance(const Body<Dim>& body, std::size_t p, std::size_t q) {
  double square = 0;
  for (int a = 0; a < Dim; ++a) square += std::pow(body.x[a][p] - body.x[a][q], 2);
  return std::sqrt(square);
}

template <int Dim>
double least_distance(const Body<Dim>& body) {
  double least = 1e9;
  for (std::size_t p = 0; p < body.size(); ++p)
    for (std::size_t q = 0; q < p; ++q) least = std::min(least, distance(body, p, q));
  return least;
}

/// A box filled by a lattice in grid coordinates, two particles a cell and axis, each with the volume that it has.
template <int Dim>
Body<Dim> lattice_in_cells(const GridLayout<Dim>& layout) {
  Body<Dim> body = lattice_body<Dim>(layout, water, 2);
  for (std::size_t p = 0; p < body.size(); ++p) {
    body.mass[p] = reference_density(water);
    for (int a = 0; a < Dim; ++a) {
      const double q = (body.x[a][p] - layout.lower[a]) * layout.inv_h;  // cells, as on a uniform axis
      const int cell = static_cast<int>(std::floor(q + 0.5));
      const double width = layout.span_width(a, cell) * layout.h;
      body.x[a][p] = layout.node(a, cell) + (q - cell) * width;
      body.mass[p] *= width / 2;
    }
  }
  return body;
}

}  // namespace

TEST_CASE_TEMPLATE("Two particles lose three quarters of their overlap, each half of it", Size,
                   std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
  constexpr int Dim = Size::value;
  const Grid<Dim> grid = full_box<Dim>(box_scene<Dim>(8, h, WallKind::slip));
  Body<Dim> body = row_of<Dim>({2.1, 2.1 + 0.7 * size}, 2.1);
  spread_particles(grid, body);
  CHECK(body.x[0][0] == near(2.1 - 0.3 * size * 3 / 8, 1e-13));
  CHECK(body.x[0][1] == near(2.1 + 0.7 * size + 0.3 * size * 3 / 8, 1e-13));
  for (int a = 1; a < Dim; ++a) CHECK(body.x[a][0] == 2.1);
}

TEST_CASE("Particles at the distance of their size and those at one place stay") {
  const Grid<2> grid = full_box<2>(box_scene<2>(8, h, WallKind::slip));
  for (const double gap : {0.0, 1.0001 * size, 1.5 * size}) {
    CAPTURE(gap);
    Body<2> body = row_of<2>({2.1, 2.1 + gap}, 2.1);
    spread_particles(grid, body);
    CHECK(body.x[0][0] == 2.1);
    CHECK(body.x[0][1] == 2.1 + gap);
  }
}

TEST_CASE("A pass moves a particle by a tenth of its size at most") {
  const Grid<2> grid = full_box<2>(box_scene<2>(8, h, WallKind::slip));
  Body<2> body = row_of<2>({2.1, 2.1 + 0.1 * size}, 2.1);
  spread_particles(grid, body);
  CHECK(body.x[0][1] - body.x[0][0] == near((0.1 + 4 * 0.1) * size, 1e-12));
}

TEST_CASE_TEMPLATE("A lattice stays as it is, at walls, seams and on graded axes, too", Size,
                   std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
  constexpr int Dim = Size::value;
  for (const Scene& scene : {box_scene<Dim>(6, h, WallKind::slip), box_scene<Dim>(6, h, WallKind::periodic),
                             graded_scene<Dim>(6, h, WallKind::slip)}) {
    const Grid<Dim> grid = full_box<Dim>(scene);
    Body<Dim> body = lattice_in_cells<Dim>(grid.layout);
    const Body<Dim> before = body;
    spread_particles(grid, body);
    double most = 0;
    for (std::size_t p = 0; p < body.size(); ++p)
      for (int a = 0; a < Dim; ++a) most = std::max(most, std::abs(body.x[a][p] - before.x[a][p]));
    CHECK(most <= 1e-13);
  }
}

TEST_CASE_TEMPLATE("Walls and corners push as an image does, seams as the other side", Size,
                   std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
  constexpr int Dim = Size::value;
  const Grid<Dim> walled = full_box<Dim>(box_scene<Dim>(8, h, WallKind::no_slip));
  for (const double middle : {2.1, 4 - 0.4 * size}) {
    CAPTURE(middle);
    Body<Dim> body = row_of<Dim>({0.4 * size}, middle);
    spread_particles(walled, body);
    CHECK(body.x[0][0] == near(0.475 * size, 1e-12));  // the overlap of 0.2 goes to 0.05
    CHECK(body.x[1][0] == near(middle == 2.1 ? 2.1 : 4 - 0.475 * size, 1e-12));
  }
  const Grid<Dim> joined = full_box<Dim>(box_scene<Dim>(8, h, WallKind::periodic));
  Body<Dim> body = row_of<Dim>({0.2 * size, 4 - 0.5 * size}, 2.1);
  spread_particles(joined, body);
  CHECK(body.x[0][0] == near((0.2 + 0.3 * 3 / 8) * size, 1e-12));
  CHECK(body.x[0][1] == near(4 - (0.5 + 0.3 * 3 / 8) * size, 1e-12));
  body = row_of<Dim>({4 + 2.2 * size, 1.5 * size}, 2.1);  // beyond a seam until the next sort
  spread_particles(joined, body);
  CHECK(body.x[0][0] == near(4 + (2.2 + 0.3 * 3 / 8) * size, 1e-12));
}

TEST_CASE("What is held pushes, but does not move: at the surface, beside other bodies, in soil") {
  const auto moved = [](auto&& hold) {
    Grid<2> grid = full_box<2>(box_scene<2>(8, h, WallKind::slip));
    Body<2> body = row_of<2>({2.2, 2.2 + 0.7 * size}, 2.1);  // in cells 4 and 5
    hold(grid, grid.layout.index({4, 4}));
    spread_particles(grid, body);
    CHECK(body.x[0][1] > 2.2 + 0.75 * size);
    return body.x[0][0] != 2.2;
  };
  CHECK(moved([](Grid<2>&, int) {}));
  CHECK_FALSE(moved([](Grid<2>& grid, int cell) { grid.cell_flags[cell - 1] = cell_filled; }));
  const auto moved_beside = [&](Array<double> Grid<2>::*share, int cells_away) {
    return moved([&](Grid<2>& grid, int cell) {
      (grid.*share).assign(grid.layout.nodes(), 0.0);
      (grid.*share)[cell - cells_away] = 0.01;
    });
  };
  for (Array<double> Grid<2>::*const share : {&Grid<2>::taken, &Grid<2>::occupied}) {
    CHECK_FALSE(moved_beside(share, 0));
    CHECK(moved_beside(share, 1));
  }
  CHECK_FALSE(moved_beside(&Grid<2>::rigid_cells, 1));
  CHECK(moved_beside(&Grid<2>::rigid_cells, 2));
}

TEST_CASE_TEMPLATE("The velocity follows its gradient, and the centre of mass stays", Size,
                   std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
  constexpr int Dim = Size::value;
  const Grid<Dim> grid = full_box<Dim>(box_scene<Dim>(6, h, WallKind::periodic));
  Body<Dim> body = lattice_in_cells<Dim>(grid.layout);
  Random random;
  for (int a = 0; a < Dim; ++a)
    for (double& x : body.x[a]) x += random.uniform(-0.08, 0.08) * size;
  for (int c = 0; c < Dim * Dim; ++c) std::fill(body.affine[c].begin(), body.affine[c].end(), 1.0 + c);
  const Body<Dim> before = body;
  spread_particles(grid, body);
  double most = 0, wrong = 0;
  for (int a = 0; a < Dim; ++a) {
    double sum = 0;
    for (std::size_t p = 0; p < body.size(); ++p) {
      double change = body.v[a][p] - before.v[a][p];
      for (int b = 0; b < Dim; ++b) change -= (1.0 + a * Dim + b) * (body.x[b][p] - before.x[b][p]);
      wrong = std::max(wrong, std::abs(change));
      most = std::max(most, std::abs(body.x[a][p] - before.x[a][p]));
      sum += body.x[a][p] - before.x[a][p];
    }
    CHECK(sum == within(0, 1e-11));
  }
  CHECK(wrong <= 1e-14);
  CHECK(most > 0.01 * size);
}

TEST_CASE("Lines of particles that a flow has drawn up break up") {
  const Grid<2> grid = full_box<2>(box_scene<2>(8, h, WallKind::periodic));
  Body<2> body = lattice_body<2>(grid.layout, water, 2);
  Random random;
  for (std::size_t p = 0; p < body.size(); ++p) {  // four times further apart along x, in lines that fill y
    const std::size_t i = p % 16, j = p / 16;
    body.x[0][p] = (static_cast<double>(i / 4) * 4 + 2) * size + random.uniform(-0.01, 0.01) * size;
    body.x[1][p] = (static_cast<double>(j) + (static_cast<double>(i % 4) + 0.5) / 4) * size;
  }
  CHECK(least_distance(body) < 0.3 * size);
  for (int call = 0; call < 60; ++call) spread_particles(grid, body);
  CHECK(least_distance(body) > 0.8 * size);
}

TEST_CASE("Particles are spread when they have moved by a quarter of a cell, and then sorted") {
  const double close = 2.1 + 0.7 * size;
  Grids<2> grids(1);
  grids[0] = full_box<2>(box_scene<2>(8, h, WallKind::slip));
  State<2> state;
  state.bodies = {row_of<2>({2.1, close}, 2.1), row_of<2>({2.1, close}, 2.1)};
  state.bodies[0].shift = true;
  for (const double drift : {0.24 * h, -1.0, std::numeric_limits<double>::infinity()}) {
    state.drift = drift;
    spread_particles_if_due(state, grids);
    CHECK(state.bodies[0].x[0][1] == close);
    CHECK(state.drift == drift);
  }
  state.drift = 0.26 * h;
  spread_particles_if_due(state, grids);
  CHECK(state.bodies[0].x[0][1] > close);
  CHECK(state.bodies[1].x[0][1] == close);  // it does not shift
  CHECK(state.drift < 0);
}
