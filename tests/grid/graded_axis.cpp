// Graded axes: where cells stand, which span holds a place, what the splines on it are, and their integrals.
#include <doctest/doctest.h>

#include <geodrop/grid/graded_axis.hpp>

#include "grid/bases.hpp"
#include "support/near.hpp"
#include "support/random_particles.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr int pad = 2;

/// 20 m, cells of 0.5 m, of 0.1 m in the middle 3 m.
GridSpec middle(double growth = 1.2) {
  GridSpec spec;
  spec.lower = {-10, 0};
  spec.upper = {10, 1};
  spec.spacing = 0.5;
  spec.refine = {{0, -1.5, 1.5, 0.1, growth, {}}};
  return spec;
}

/// Cells of up to 2 m that grow from one wall of a 9 m axis.
GridSpec at_wall() {
  GridSpec spec;
  spec.lower = {3, 0};
  spec.upper = {12, 1};
  spec.spacing = 2;
  spec.refine = {{0, 3, 3.2, 0.05, 1.5, {}}};
  return spec;
}

/// Five-point Gauss.
template <class F>
double integrate(double from, double to, F&& f) {
  constexpr double x[3] = {0, 0.5384693101056831, 0.9061798459386640};
  constexpr double w[3] = {0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  const double mid = 0.5 * (from + to), half = 0.5 * (to - from);
  double sum = w[0] * f(mid);
  for (int i = 1; i < 3; ++i) sum += w[i] * (f(mid - half * x[i]) + f(mid + half * x[i]));
  return half * sum;
}

}  // namespace

TEST_CASE("A graded axis has a whole number of cells, as fine as asked in the zone, and growing as asked around it") {
  for (const double growth : {1.05, 1.2, 1.5}) {
    const AxisMap map(middle(growth), 0);
    CHECK(map.graded());
    CHECK(std::abs(map.to_space(0) + 10) < 1e-13);
    CHECK(std::abs(map.to_space(map.cells()) - 10) < 1e-13);
    CHECK(map.cells() >= map.wanted_cells());
    CHECK(map.cells() < map.wanted_cells() + 1);
    double before = map.to_space(1) - map.to_space(0);
    for (int i = 1; i < map.cells(); ++i) {
      const double width = map.to_space(i + 1) - map.to_space(i), place = map.to_space(i + 0.5);
      CHECK(width <= 0.5);
      if (std::abs(place) < 1.4) CHECK(width == near(0.1, 0.02));
      CHECK(std::max(width / before, before / width) < growth + 1e-9);
      CHECK(map.to_grid(place) == near(i + 0.5, 1e-13));
      CHECK(std::abs(map.to_space(map.cells() - i) + map.to_space(i)) < 1e-12);  // a mirror image of itself
      before = width;
    }
  }
}

TEST_CASE("An axis without a zone is uniform, also beside a graded one") {
  const AxisMap map(middle(), 1);
  CHECK_FALSE(map.graded());
  CHECK(map.cells() == 2);
  const KnotTable knots(middle(), 1, pad);
  for (int s = 0; s < 2 + 1 + 2 * pad; ++s) {
    CHECK(knots[s].width == 0.5);
    CHECK(knots.node(s) == 0.5 * (s - pad));
  }
}

TEST_CASE("Walls are nodes, and spans beyond them mirror images") {
  for (const GridSpec& spec : {middle(), at_wall()}) {
    const KnotTable knots(spec, 0, pad);
    const int cells = AxisMap(spec, 0).cells();
    CHECK(std::abs(knots.node(pad) - spec.lower[0]) < 1e-13);
    CHECK(std::abs(knots.node(pad + cells) - spec.upper[0]) < 1e-13);
    for (int k = 1; k <= pad; ++k) {
      CHECK(knots[pad - k].width == knots[pad + k].width);
      CHECK(std::abs(knots.node(pad - k) + knots.node(pad + k) - 2 * spec.lower[0]) < 1e-12);
      CHECK(std::abs(knots.node(pad + cells - k) + knots.node(pad + cells + k) - 2 * spec.upper[0]) < 1e-12);
    }
    for (int s = 0; s < cells + 2 * pad; ++s)
      CHECK(std::abs(knots[s].left + knots[s].width - knots[s + 1].left) < 1e-13);
  }
}

TEST_CASE("The table finds the span of every place, knots and walls included") {
  Random random;
  for (const GridSpec& spec : {middle(), at_wall()}) {
    const KnotTable knots(spec, 0, pad);
    const int last = AxisMap(spec, 0).cells() + 2 * pad;
    const auto check = [&](double x) {
      const int s = knots.find(x);
      CHECK(s == knots.find_inside(x));
      REQUIRE(s >= 0);
      REQUIRE(s <= last);
      CHECK(knots[s].left <= x);
      CHECK(x <= knots[s].left + knots[s].width);
    };
    for (int k = 0; k < 2000; ++k) check(random.uniform(spec.lower[0], spec.upper[0]));
    for (int s = 0; s <= last; ++s) {
      check(knots[s].left);
      CHECK(knots.find(knots[s].left) == s);
    }
    check(spec.lower[0]);
    check(spec.upper[0]);
    CHECK(knots.find(-1e300) == 0);
    CHECK(knots.find(1e300) == last);
    CHECK(knots.find(std::nan("")) == 0);
  }
}

TEST_CASE("Weights add up to one, reproduce positions, and have slopes that are derivatives") {
  Random random;
  for (const GridSpec& spec : {middle(), middle(1.5), at_wall()}) {
    const KnotTable knots(spec, 0, pad);
    for (int k = 0; k < 2000; ++k) {
      const double x = random.uniform(spec.lower[0], spec.upper[0]);
      const int s = knots.find(x);
      const KnotSpan& span = knots[s];
      const ThreeWeights n = GradedBspline2::at(span, x);
      CHECK(std::abs(n.w0 + n.w1 + n.w2 - 1) < 1e-15);
      CHECK(std::min({n.w0, n.w1, n.w2}) >= 0);
      const double w[3] = {n.w0, n.w1, n.w2}, g[3] = {n.g0, n.g1, n.g2};
      double position = 0, stretch = 0;
      for (int i = 0; i < 3; ++i) {
        const double node = knots.node(s + i - 1);
        position += w[i] * node;
        stretch += g[i] * node;
      }
      CHECK(std::abs(position - x) < 1e-14 * 12);
      CHECK(std::abs(stretch - 1) < 1e-12);
      const double step = 1e-6 * span.width;
      const ThreeWeights before = GradedBspline2::at(span, x - step), after = GradedBspline2::at(span, x + step);
      CHECK(std::abs((after.w0 - before.w0) / (2 * step) - n.g0) < 1e-7 / span.width);
      CHECK(std::abs((after.w1 - before.w1) / (2 * step) - n.g1) < 1e-7 / span.width);
      CHECK(std::abs((after.w2 - before.w2) / (2 * step) - n.g2) < 1e-7 / span.width);
    }
  }
}

TEST_CASE("From one span to the next the splines go on smoothly") {
  const KnotTable knots(middle(1.5), 0, pad);
  for (int s = 1; s < AxisMap(middle(1.5), 0).cells() + 2 * pad; ++s) {
    const double knot = knots[s].left;
    const ThreeWeights before = GradedBspline2::at(knots[s - 1], knot), after = GradedBspline2::at(knots[s], knot);
    CHECK(std::abs(before.w0) < 1e-14);
    CHECK(std::abs(before.w1 - after.w0) < 1e-14);
    CHECK(std::abs(before.w2 - after.w1) < 1e-14);
    CHECK(std::abs(before.g1 - after.g0) < 1e-12);
    CHECK(std::abs(before.g2 - after.g1) < 1e-12);
    CHECK(std::abs(after.w2) < 1e-14);
  }
}

TEST_CASE("Cell integrals of graded axes are those of Gauss quadrature, slip and no-slip") {
  for (const WallKind wall : {WallKind::slip, WallKind::no_slip}) {
    const double parity = wall == WallKind::slip ? 1 : -1;
    const Grid<2> grid = make_grid<2>(graded_scene<2>(6, 0.5, wall));
    const KnotTable& knots = grid.layout.knots[1];
    const int cells = grid.layout.cells[1];
    const double h = grid.layout.h;
    double width = 0;
    for (int cell = 0; cell <= cells; ++cell) {
      const int s = cell + pad;
      const double from = std::max(grid.layout.lower[1], knots[s].left);
      const double to = std::min(grid.layout.upper[1], knots[s].left + knots[s].width);
      width += grid.integrals[1].width[s];
      CHECK(grid.integrals[1].width[s] * h == near(to - from, 1e-13));
      for (int entry = 0; entry < 3; ++entry) {
        CAPTURE(cell);
        CAPTURE(entry);
        const int node = cell + entry - 1, mirror = node == 1 ? -1 : node == cells - 1 ? cells + 1 : node;
        const auto spline = [&](int i, double x, bool slope) {
          const ThreeWeights n = GradedBspline2::at(knots[s], x);
          const double w[3] = {n.w0, n.w1, n.w2}, g[3] = {n.g0, n.g1, n.g2};
          const int e = i - cell + 1;
          return e < 0 || e > 2 ? 0.0 : slope ? g[e] : w[e];
        };
        const auto folded = [&](double sign, bool slope) {
          return integrate(from, to, [&](double x) {
            return spline(node, x, slope) + (mirror != node ? sign * spline(mirror, x, slope) : 0.0);
          });
        };
        if (node < 0 || node > cells) continue;
        CHECK(std::abs(grid.integrals[1].value[s][entry] * h - folded(parity, false)) < 1e-14);
        // The normal velocity of a wall node is zero: its slope never acts.
        if (node > 0 && node < cells) CHECK(std::abs(grid.integrals[1].slope[s][entry] - folded(-1, true)) < 1e-13);
      }
    }
    CHECK(width * h == near(3.0, 1e-14));
  }
}

TEST_CASE("The integral of a node's spline is the mean of its three spans") {
  const Grid<2> grid = make_grid<2>(graded_scene<2>(12, 0.5, WallKind::slip));
  const KnotTable& knots = grid.layout.knots[0];
  for (int node = 1; node < grid.layout.cells[0]; ++node) {
    double sum = 0;
    for (int side = -1; side <= 1; ++side) {
      const KnotSpan& span = knots[node + pad + side];
      sum += integrate(span.left, span.left + span.width, [&](double x) {
        const ThreeWeights n = GradedBspline2::at(span, x);
        return side < 0 ? n.w2 : side == 0 ? n.w1 : n.w0;
      });
    }
    CHECK(grid.layout.spline_width(0, node) * grid.layout.h == near(sum, 1e-13));
  }
}

TEST_CASE("The finest cell is known; without zones it is the spacing") {
  CHECK(finest_spacing(middle()) == near(0.1, 0.004));
  CHECK(finest_spacing(middle()) <= 0.1);
  for (const GridSpec& spec : {middle(), middle(1.5), at_wall()})
    CHECK(finest_spacing(spec) == near(KnotTable(spec, 0, pad).finest(), 1e-12));
  GridSpec narrow = middle();
  narrow.refine[0].to = -1.499;
  CHECK(finest_spacing(narrow) == near(KnotTable(narrow, 0, pad).finest(), 1e-12));
  CHECK(make_grid<3>(graded_scene<3>(8, 1, WallKind::slip)).layout.finest <= 0.25);
  GridSpec plain = middle();
  plain.refine.clear();
  CHECK(finest_spacing(plain) == 0.5);
}
