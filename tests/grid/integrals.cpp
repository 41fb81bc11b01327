// The layout of the grid, and the integrals of the basis over its cells against Gauss quadrature of the spline.
#include <doctest/doctest.h>

#include "support/near.hpp"
#include "support/random_particles.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

/// Cardinal quadratic B-spline of a node at 0, h = 1, and its derivative.
double spline(double s) {
  const double r = std::abs(s);
  if (r < 0.5) return 0.75 - r * r;
  return r < 1.5 ? 0.5 * (1.5 - r) * (1.5 - r) : 0.0;
}
double spline_slope(double s) {
  const double r = std::abs(s), sign = s < 0 ? -1 : 1;
  if (r < 0.5) return -2 * s;
  return r < 1.5 ? -sign * (1.5 - r) : 0.0;
}

double hat(double s) { return std::max(0.0, 1 - std::abs(s)); }
double hat_slope(double s) { return std::abs(s) >= 1 ? 0 : s < 0 ? 1 : -1; }

/// Two-point Gauss on both halves: exact for the pieces between a node and the middle of a cell.
template <class F>
double integrate(double from, double to, F&& f) {
  if (to - from > 0.75) return integrate(from, 0.5 * (from + to), f) + integrate(0.5 * (from + to), to, f);
  const double mid = 0.5 * (from + to), half = 0.5 * (to - from), g = half / std::sqrt(3.0);
  return half * (f(mid - g) + f(mid + g));
}

/// Shape function of `node` with the ghosts folded onto it: node k of a wall at `wall` has its mirror at 2 wall - k.
template <class F>
double folded(F&& f, double x, int node, int cells, double sign) {
  double sum = f(x - node);
  if (node == 1) sum += sign * f(x + 1);
  if (node == cells - 1) sum += sign * f(x - (cells + 1));
  return sum;
}

void check_axis(WallKind wall, Basis basis) {
  const double parity = wall == WallKind::slip ? 1 : -1;
  Scene scene = box_scene<2>(6, 0.5, wall);
  scene.grid.basis = basis;
  const Grid<2> grid = make_grid<2>(scene);
  const auto shape = basis == Basis::bspline2 ? spline : hat;
  const auto shape_slope = basis == Basis::bspline2 ? spline_slope : hat_slope;
  const int cells = grid.layout.cells[1];
  for (int cell = 0; cell <= cells; ++cell) {
    const int s = cell + GridLayout<2>::pad;
    const double from = std::max(0.0, cell - 0.5), to = std::min<double>(cells, cell + 0.5);
    CHECK(grid.integrals[1].width[s] == near(to - from, 1e-15));
    for (int entry = 0; entry < 3; ++entry) {
      CAPTURE(cell);
      CAPTURE(entry);
      const int node = cell + entry - 1;
      const bool real = node >= 0 && node <= cells;
      const auto value = [&](double x) { return folded(shape, x, node, cells, parity); };
      const auto slope = [&](double x) { return folded(shape_slope, x, node, cells, -1); };
      CHECK(std::abs(grid.integrals[1].value[s][entry] - (real ? integrate(from, to, value) : 0.0)) < 1e-15);
      // The normal velocity of a wall node is zero: its slope never acts.
      const bool wall_node = node == 0 || node == cells;
      if (real && !wall_node) CHECK(std::abs(grid.integrals[1].slope[s][entry] - integrate(from, to, slope)) < 1e-15);
    }
  }
}

}  // namespace

TEST_CASE("Cell integrals of the basis are those of Gauss quadrature, slip and no-slip") {
  for (const Basis basis : {Basis::bspline2, Basis::gimp, Basis::linear}) {
    CAPTURE(static_cast<int>(basis));
    check_axis(WallKind::slip, basis);
    check_axis(WallKind::no_slip, basis);
  }
}

TEST_CASE("Between slip walls the value integrals of a cell add up to its width") {
  const Grid<3> grid = make_grid<3>(box_scene<3>(5, 0.25, WallKind::slip));
  for (int a = 0; a < 3; ++a)
    for (int s = 0; s < grid.layout.stored[a]; ++s) {
      const auto& value = grid.integrals[a].value[s];
      CHECK(std::abs(value[0] + value[1] + value[2] - grid.integrals[a].width[s]) < 1e-15);
    }
}

TEST_CASE("Widths of the cells add up to the domain") {
  const Grid<2> grid = make_grid<2>(box_scene<2>(9, 0.5, WallKind::no_slip));
  double sum = 0;
  for (const double width : grid.integrals[0].width) sum += width;
  CHECK(sum == 9);
}

TEST_CASE("Nodes are numbered x fastest, with two ghosts beyond each wall; a position belongs to its nearest node") {
  GridSpec spec;
  spec.lower = {-1, 2};
  spec.upper = {1, 5};
  spec.spacing = 0.5;
  const GridLayout<2> layout(spec, {{WallKind::slip, WallKind::slip}, {WallKind::slip, WallKind::slip}});
  CHECK(layout.cells == std::array<int, 2>{4, 6});
  CHECK(layout.stored == std::array<int, 2>{9, 11});
  CHECK(layout.nodes() == 99);
  CHECK(layout.index({-2, -2}) == 0);
  CHECK(layout.index({-1, -2}) == 1);
  CHECK(layout.index({0, 1}) == 2 + 3 * 9);
  CHECK(layout.index({6, 8}) == 98);
  CHECK(layout.base(0, -1.0) == 0);
  CHECK(layout.base(0, -0.76) == 0);
  CHECK(layout.base(0, -0.74) == 1);
  CHECK(layout.base(1, 5.0) == 6);
}

TEST_CASE("A grid has no arrays that its scene does not need") {
  Scene scene = box_scene<2>(4, 1, WallKind::slip);
  scene.bodies[0].pressure = PressureSupport::particle;
  const Grid<2> bare = make_grid<2>(scene);
  CHECK(bare.sum.size() == 81);
  CHECK(bare.velocity.size() == 81);
  CHECK(bare.force.empty());
  CHECK(bare.velocity_change.empty());
  CHECK(bare.cell_volume.empty());
  CHECK(bare.cell_pressure.empty());
  CHECK(bare.volume_rate.empty());
  CHECK(bare.cell_flags.empty());
  CHECK(bare.integrals[0].value.empty());
  scene.solver.transfer = Transfer::blend;
  scene.bodies[0].pressure = PressureSupport::cell;
  const Grid<2> full = make_grid<2>(scene);
  CHECK(full.velocity_change.size() == 81);
  CHECK(full.cell_pressure.size() == 81);
  CHECK(full.volume_rate.size() == 81);
}
