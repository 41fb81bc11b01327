// Integrals of splines over cells, faces and pieces of an outline, by hand.
#include <doctest/doctest.h>

#include "cut/cell_slopes.hpp"
#include "cut/wet_cells.hpp"
#include "grid/bases.hpp"
#include "support/near.hpp"
#include "support/sharp_box.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

const SpanShape even{1.0}, uneven{2.0, 0.4, 0.7};

/// Moments of a whole face.
constexpr FaceMoments whole_face{1, 0, 1.0 / 12};

Slope<2> of_whole_faces(const CellSpans<2>& cell) {
  Slope<2> slope{};
  for (int axis = 0; axis < 2; ++axis)
    for (int side = 0; side < 2; ++side) add_face(whole_face, axis, side, cell, slope);
  return slope;
}

/// N of the nodes below, at and above a span at a place z in it, as integrals_to has it.
std::array<double, 3> splines_at(const SpanShape& span, double z) {
  const double below = span.below * (0.5 - z) * (0.5 - z), above = span.above * (0.5 + z) * (0.5 + z);
  return {below, 1 - below - above, above};
}

}  // namespace

TEST_CASE("int N from the lower end of a span: nothing, a half, three quarters by hand, and the whole") {
  const std::array<double, 3> none = integrals_to(even, -0.5), half = integrals_to(even, 0);
  const std::array<double, 3> quarter = integrals_to(even, -0.25), whole = integrals_to(even, 0.5);
  const std::array<double, 3> by_hand{0.5 * (1 - 0.421875) / 3, 0.25 - 0.5 * (1 - 0.421875 + 0.015625) / 3,
                                      0.5 * 0.015625 / 3};
  for (int n = 0; n < 3; ++n) {
    CHECK(none[n] == near_zero(1e-16));
    CHECK(half[n] == near(std::array{7.0 / 48, 1.0 / 3, 1.0 / 48}[n], 1e-14));
    CHECK(quarter[n] == near(by_hand[n], 1e-13));
    CHECK(whole[n] == near(std::array{1.0 / 6, 2.0 / 3, 1.0 / 6}[n], 1e-14));
    CHECK(integrals_to(uneven, 0.5)[n] == near(uneven.values()[n], 1e-14));
  }
}

TEST_CASE("The slope of int N is N, on spans with unlike neighbours too; mirrored spans mirror it") {
  constexpr double step = 1e-4;
  for (const SpanShape& span : {even, uneven}) {
    const SpanShape mirrored{span.width, span.above, span.below};
    for (const double z : {-0.4, -0.1, 0.05, 0.3}) {
      const std::array<double, 3> above = integrals_to(span, z + step), below = integrals_to(span, z - step);
      const std::array<double, 3> whole = integrals_to(mirrored, 0.5), rest = integrals_to(mirrored, -z);
      const std::array<double, 3> N = splines_at(span, z), here = integrals_to(span, z);
      for (int n = 0; n < 3; ++n) {
        CHECK((above[n] - below[n]) / (2 * step) == within(N[n], 1e-8));  // step^2 / 6 times N'' <= 1.4
        CHECK(here[n] == near(whole[2 - n] - rest[2 - n], 1e-12));
      }
    }
  }
}

TEST_CASE("Over a whole cell int grad N and int N are products of those along the axes") {
  const Slope<2> slope = whole_cell<2>({SpanShape{2.0}, SpanShape{3.0}});
  const std::array<double, 9> value = whole_value<2>({SpanShape{2.0}, SpanShape{3.0}});
  CHECK(slope[0][0] == near(-0.5 * 3.0 / 6, 1e-14));  // of the node below on both axes
  CHECK(slope[0][1] == near(-0.5 * 2.0 / 6, 1e-14));
  CHECK(slope[5][0] == near(0.5 * 3.0 * 2 / 3, 1e-14));  // above along x, its own row
  CHECK(slope[5][1] == 0);
  CHECK(slope[4][0] == 0);
  CHECK(value[4] == near(6 * 4.0 / 9, 1e-14));
  CHECK(value[1] == near(6 * 2.0 / 18, 1e-14));
  CHECK(value[8] == near(6 / 36.0, 1e-14));
}

TEST_CASE("int grad N over a cell is that of N n over its four whole faces") {
  for (const CellSpans<2>& cell : {CellSpans<2>{even, even}, CellSpans<2>{uneven, even}, CellSpans<2>{even, uneven}}) {
    const Slope<2> faces = of_whole_faces(cell), whole = whole_cell(cell);
    for (int n = 0; n < 9; ++n)
      for (int a = 0; a < 2; ++a) CHECK(faces[n][a] == within(whole[n][a], 1e-15));
  }
}

TEST_CASE("A face that is inside in part reaches the nodes on its two sides, by the splines along it") {
  Slope<2> slope{};
  // The lower half of the right face: int N along it from the bottom to the middle.
  add_face({0.5, -0.125, 1.0 / 24}, 0, 1, {even, even}, slope);
  const double along[] = {7.0 / 48, 1.0 / 3, 1.0 / 48};
  for (int n = 0; n < 9; ++n) {
    const double expected = n % 3 == 0 ? 0 : 0.5 * along[n / 3];
    CHECK(slope[n][0] == within(expected, 1e-15));
    CHECK(slope[n][1] == 0);
  }
  add_face({0.5, -0.125, 1.0 / 24}, 0, 0, {even, even}, slope);  // minus the same at the left face
  CHECK(slope[1][0] == near_zero(1e-15));
  CHECK(slope[0][0] == near(-0.5 * along[0], 1e-14));
}

TEST_CASE("A piece of the outline: mean of N along it, int N beside it, outward normal as long as the piece") {
  for (const Sense sense : {Sense::anticlockwise, Sense::clockwise}) {
    SharpBox box({}, sense);
    const CutCells& cells = box.inside().outline;
    const std::size_t left = box.segment_at(2.75, 4);
    const auto piece = std::find_if(cells.pieces.begin(), cells.pieces.end(),
                                    [&](const CutCells::Piece& p) { return p.edge == static_cast<int>(left); });
    REQUIRE(piece != cells.pieces.end());
    const PieceIntegral integral = integrate_piece(box.around().layout, box.skin(), cells, *piece);
    CHECK(integral.normal[0] == near(-1, 1e-14));
    CHECK(integral.normal[1] == near_zero(1e-15));
    // At x = 2.75, a quarter left of the node; along y over the whole cell.
    const double at[] = {0.28125, 0.6875, 0.03125}, along[] = {1.0 / 6, 2.0 / 3, 1.0 / 6};
    const std::array<double, 3> beside = integrals_to(even, -0.25);
    for (int n = 0; n < 9; ++n) {
      CHECK(integral.mean[n] == near(at[n % 3] * along[n / 3], 1e-13));
      CHECK(integral.beside[n] == near(beside[n % 3] * along[n / 3], 1e-13));
    }
  }
}

TEST_CASE("A cell is wet if half of the room that bodies leave around it is filled") {
  SharpBox box;
  Grid<2>& around = box.around();
  std::fill(around.taken.begin(), around.taken.end(), 0.0);
  const auto wet_with = [&](double volume) {
    around.cell_volume[box.flat(4, 5)] = volume;
    return is_wet(around, box.flat(5, 5));
  };
  CHECK(wet_with(4.5));
  CHECK_FALSE(wet_with(4.499));
  around.taken[box.flat(6, 6)] = 0.5;  // 8.5 cells of room are left
  CHECK(wet_with(4.25));
  CHECK_FALSE(wet_with(4.249));
  around.cell_volume[box.flat(7, 5)] = 9;  // two cells away
  CHECK_FALSE(wet_with(4.249));
}

TEST_CASE("Where bodies leave less than a tenth of a cell and its neighbours, it is dry however full that is") {
  SharpBox box;
  Grid<2>& around = box.around();
  std::fill(around.taken.begin(), around.taken.end(), 0.9);
  around.cell_volume[box.flat(5, 5)] = 0.9;
  around.taken[box.flat(6, 6)] = 0.89;  // nine cells, and 0.91 of them left
  CHECK(is_wet(around, box.flat(5, 5)));
  around.taken[box.flat(6, 6)] = 0.91;
  CHECK_FALSE(is_wet(around, box.flat(5, 5)));
}

TEST_CASE("Air lies where bodies leave a quarter of a cell and its neighbours and next to nothing fills that") {
  SharpBox box;
  Grid<2>& around = box.around();
  std::fill(around.taken.begin(), around.taken.end(), 0.75);
  CHECK(is_in_air(around, box.flat(5, 5)));
  around.taken[box.flat(6, 6)] = 0.76;
  CHECK_FALSE(is_in_air(around, box.flat(5, 5)));
  around.taken[box.flat(6, 6)] = 0.75;
  around.cell_volume[box.flat(4, 4)] = 0.049 * 9 * 0.25;
  CHECK(is_in_air(around, box.flat(5, 5)));
  around.cell_volume[box.flat(4, 4)] = 0.05 * 9 * 0.25;
  CHECK_FALSE(is_in_air(around, box.flat(5, 5)));
}

TEST_CASE("The nodes around a cell run along x first; spans have the widths of the axes") {
  const Scene scene = graded_scene<2>(12, 1.0, WallKind::slip);
  const GridLayout<2> layout(scene.grid, scene.walls);
  const int flat = layout.index({5, 7});
  for (int n = 0; n < 9; ++n) CHECK(node_around(layout, flat, n) == layout.index({4 + n % 3, 6 + n / 3}));
  const double x = layout.knots[0][5 + 2].width, y = layout.knots[1][7 + 2].width;
  REQUIRE(x != y);
  CHECK(cell_size(layout, flat) == near(x * y, 1e-14));
  CHECK(least_width(layout, flat) == std::min(x, y));
  CHECK(span_of(layout, 0, flat).width == x);
  CHECK(span_of(layout, 1, flat).width == y);
  CHECK(place_in(layout, 1, 9, layout.knots[1][9].left) == near(-0.5, 1e-12));
  CHECK(place_in(layout, 1, 9, layout.node(1, 7)) == near_zero(1e-12));
}
