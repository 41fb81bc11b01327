// What a polygon cuts out of the cells: worked by hand, and for ragged outlines against slower ways to the same
// numbers.
#include "cut/cut_cells.hpp"

#include <doctest/doctest.h>

#include <numbers>

#include "support/near.hpp"
#include "support/random_particles.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double h = 0.5;

struct Polygon {
  Array<double> x, y;
  std::size_t size() const { return x.size(); }
  std::size_t next(std::size_t k) const { return k + 1 == size() ? 0 : k + 1; }
};

const GridLayout<2>& layout() {
  static const Scene scene = box_scene<2>(20, h, WallKind::slip);
  static const GridLayout<2> of_box(scene.grid, scene.walls);
  return of_box;
}

EnclosedCells cut(const Polygon& polygon) {
  EnclosedCells cells;
  cut_cells(layout(), polygon.x, polygon.y, cells);
  return cells;
}

/// Local index of the cell around node (i, j) of the grid.
int around(const EnclosedCells& cells, int i, int j) {
  return i + GridLayout<2>::pad - cells.first[0] + (j + GridLayout<2>::pad - cells.first[1]) * cells.count[0];
}

/// Middle of a local cell [m].
std::array<double, 2> middle(const EnclosedCells& cells, int c) {
  return {h * (cells.first[0] + c % cells.count[0] - GridLayout<2>::pad),
          h * (cells.first[1] + c / cells.count[0] - GridLayout<2>::pad)};
}

double area(const Polygon& p) {
  double twice = 0;
  for (std::size_t k = 0; k < p.size(); ++k) twice += p.x[k] * p.y[p.next(k)] - p.x[p.next(k)] * p.y[k];
  return std::abs(twice) / 2;
}

/// Corners at random distances from (cx, cy), anticlockwise.
Polygon star(double cx, double cy, int corners, unsigned seed) {
  Random random(seed);
  Polygon p;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * std::numbers::pi * k / corners, r = random.uniform(0.8, 3.2);
    p.x.push_back(cx + r * std::cos(angle));
    p.y.push_back(cy + r * std::sin(angle));
  }
  return p;
}

Polygon reversed(Polygon p) {
  std::reverse(p.x.begin(), p.x.end());
  std::reverse(p.y.begin(), p.y.end());
  return p;
}

/// Integrals of 1, z, z^2 over the part inside of the face at `place` across `axis`, z = 0 at `centre` [width]: from
/// the crossings of the outline with the line that the face is a part of.
FaceMoments moments_of_face(const Polygon& p, int axis, double place, double centre, double width = h) {
  const Array<double>&across = axis == 0 ? p.x : p.y, &along = axis == 0 ? p.y : p.x;
  std::vector<double> crossings;
  for (std::size_t k = 0; k < p.size(); ++k) {
    const double a = across[k] - place, b = across[p.next(k)] - place;
    if ((a < 0) != (b < 0)) crossings.push_back(along[k] + a / (a - b) * (along[p.next(k)] - along[k]));
  }
  std::sort(crossings.begin(), crossings.end());
  FaceMoments sum{};
  for (std::size_t n = 0; n + 1 < crossings.size(); n += 2) {
    const double from = std::clamp((crossings[n] - centre) / width, -0.5, 0.5);
    const double to = std::clamp((crossings[n + 1] - centre) / width, -0.5, 0.5);
    for (int b = 0; b < 3; ++b) sum[b] += (std::pow(to, b + 1) - std::pow(from, b + 1)) / (b + 1);
  }
  return sum;
}

void check_moments(const FaceMoments& found, const FaceMoments& expected) {
  for (int b = 0; b < 3; ++b) {
    CAPTURE(b);
    CHECK(std::abs(found[b] - expected[b]) < 1e-12);
  }
}

double largest_difference(const EnclosedCells& a, const EnclosedCells& b) {
  REQUIRE(a.count == b.count);
  double largest = 0;
  for (std::size_t c = 0; c < a.area.size(); ++c) {
    largest = std::max(largest, std::abs(a.area[c] - b.area[c]));
    for (int m = 0; m < 3; ++m) {
      largest = std::max(largest, std::abs(a.right_face[c][m] - b.right_face[c][m]));
      largest = std::max(largest, std::abs(a.top_face[c][m] - b.top_face[c][m]));
    }
  }
  return largest;
}

}  // namespace

TEST_CASE("A rectangle, worked by hand") {
  // Cells reach from -h/2 to h/2 around nodes: 0.75, 1.25, 1.75, 2.25 are faces.
  const EnclosedCells cells = cut({{1.1, 2.3, 2.3, 1.1}, {0.9, 0.9, 1.5, 1.5}});
  const double share_x[] = {0.3, 1, 1, 0.1}, share_y[] = {0.7, 0.5};
  double sum = 0;
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 4; ++i) {
      CHECK(cells.area[around(cells, 2 + i, 2 + j)] == near(share_x[i] * share_y[j], 1e-13));
      sum += share_x[i] * share_y[j];
    }
  for (const double share : cells.area) sum -= share;
  CHECK(std::abs(sum) < 1e-13);
  check_moments(cells.right_face[around(cells, 2, 2)], {0.7, 0.105, 0.133 / 3});   // from z = -0.2 to 0.5
  check_moments(cells.right_face[around(cells, 4, 3)], {0.5, -0.125, 0.125 / 3});  // from -0.5 to 0
  check_moments(cells.top_face[around(cells, 2, 2)], {0.3, 0.105, 0.039});         // from 0.2 to 0.5
  check_moments(cells.top_face[around(cells, 3, 2)], {1, 0, 1.0 / 12});
  check_moments(cells.right_face[around(cells, 1, 2)], {0, 0, 0});
  check_moments(cells.right_face[around(cells, 5, 2)], {0, 0, 0});
  check_moments(cells.top_face[around(cells, 3, 1)], {0, 0, 0});
  check_moments(cells.top_face[around(cells, 3, 3)], {0, 0, 0});
}

TEST_CASE("A triangle, worked by hand: its long side runs through corners of cells") {
  const EnclosedCells cells = cut({{1.0, 2.0, 1.0}, {1.0, 1.0, 2.0}});
  const auto share = [&](int i, int j) { return cells.area[around(cells, i, j)]; };
  CHECK(share(2, 2) == near(0.25, 1e-13));
  CHECK(share(3, 2) == near(0.5, 1e-13));
  CHECK(share(2, 3) == near(0.5, 1e-13));
  CHECK(share(3, 3) == near(0.5, 1e-13));
  CHECK(share(4, 2) == near(0.125, 1e-13));
  CHECK(share(2, 4) == near(0.125, 1e-13));
  CHECK(std::abs(share(4, 3)) + std::abs(share(3, 4)) + std::abs(share(4, 4)) < 1e-13);
  check_moments(cells.right_face[around(cells, 2, 3)], {1, 0, 1.0 / 12});
  check_moments(cells.right_face[around(cells, 3, 2)], {0.5, 0.125, 1.0 / 24});
  check_moments(cells.top_face[around(cells, 2, 3)], {0.5, 0.125, 1.0 / 24});
}

TEST_CASE("An outline along the faces of cells") {
  const EnclosedCells cells = cut({{0.75, 1.75, 1.75, 0.75}, {1.25, 1.25, 1.75, 1.75}});
  double sum = 0;
  for (const double share : cells.area) sum += share;
  CHECK(sum == near(2, 1e-13));
  CHECK(cells.area[around(cells, 2, 3)] == near(1, 1e-13));
  CHECK(cells.area[around(cells, 3, 3)] == near(1, 1e-13));
}

TEST_CASE("An outline along the faces of cells has its pieces in cells whose neighbours are in the box") {
  const Scene scene = box_scene<2>(20, 0.1, WallKind::slip);  // round-off puts faces of 0.1 m here or there
  const GridLayout<2> of_tenths(scene.grid, scene.walls);
  for (int low = 2; low < 18; ++low)
    for (int high = low + 1; high < 18; ++high) {
      const double from = 0.1 * low + 0.05, to = 0.1 * high + 0.05;
      const Array<double> x{from, to, to, from}, y{from, from, to, to};
      EnclosedCells cells;
      cut_cells(of_tenths, x, y, cells);
      for (const EnclosedCells::Piece& piece : cells.pieces) {
        const int i = piece.cell % cells.count[0], j = piece.cell / cells.count[0];
        REQUIRE(std::min({i, j, cells.count[0] - 1 - i, cells.count[1] - 1 - j}) >= 1);
      }
    }
}

TEST_CASE("The shares of a ragged outline add up to its area, none is below 0 or above 1") {
  for (const int corners : {3, 7, 40, 300}) {
    CAPTURE(corners);
    const Polygon polygon = star(5.03, 4.9, corners, 11);
    const EnclosedCells cells = cut(polygon);
    double sum = 0;
    for (const double share : cells.area) {
      CHECK(share > -1e-12);
      CHECK(share < 1 + 1e-12);
      sum += share;
    }
    CHECK(std::abs(h * h * sum - area(polygon)) < 1e-13 * area(polygon));
  }
}

TEST_CASE("Faces of a ragged outline: the parts between its crossings with their lines") {
  for (const int corners : {5, 40, 300}) {
    CAPTURE(corners);
    const Polygon polygon = star(4.97, 5.11, corners, 12);
    const EnclosedCells cells = cut(polygon);
    for (int c = 0; c < static_cast<int>(cells.area.size()); ++c) {
      const auto [x, y] = middle(cells, c);
      check_moments(cells.right_face[c], moments_of_face(polygon, 0, x + h / 2, y));
      check_moments(cells.top_face[c], moments_of_face(polygon, 1, y + h / 2, x));
    }
  }
}

TEST_CASE("Shares of a ragged outline against lines laid through the cells") {
  const Polygon polygon = star(5.0, 5.0, 60, 13);
  const EnclosedCells cells = cut(polygon);
  constexpr int lines = 500;
  double largest = 0;
  for (int c = 0; c < static_cast<int>(cells.area.size()); ++c) {
    const auto [x, y] = middle(cells, c);
    double share = 0;
    for (int n = 0; n < lines; ++n)
      share += moments_of_face(polygon, 0, x + h * ((n + 0.5) / lines - 0.5), y)[0] / lines;
    largest = std::max(largest, std::abs(share - cells.area[c]));
  }
  CHECK(largest < 1e-3);  // a corner of the outline between two lines: below 1 / lines
}

TEST_CASE("Clockwise or anticlockwise: the same cells") {
  const Polygon polygon = star(5.0, 5.0, 50, 14);
  const EnclosedCells anticlockwise = cut(polygon), clockwise = cut(reversed(polygon));
  CHECK(anticlockwise.sense == 1);
  CHECK(clockwise.sense == -1);
  CHECK(anticlockwise.pieces.size() == clockwise.pieces.size());
  CHECK(largest_difference(anticlockwise, clockwise) < 1e-12);
}

TEST_CASE("Shifted by whole cells: the same cells, their box shifted") {
  const Polygon polygon = star(4.2, 4.1, 50, 15);
  Polygon shifted = polygon;
  for (double& x : shifted.x) x += h;
  for (double& y : shifted.y) y += 3 * h;
  const EnclosedCells here = cut(polygon), there = cut(shifted);
  CHECK(there.first[0] == here.first[0] + 1);
  CHECK(there.first[1] == here.first[1] + 3);
  CHECK(largest_difference(here, there) < 1e-12);
}

TEST_CASE("The pieces of an edge add up to it, each lies in its cell") {
  const Polygon polygon = star(5.0, 5.0, 35, 16);
  const EnclosedCells cells = cut(polygon);
  Array<double> start(polygon.size(), 0.0), end(polygon.size(), 0.0);
  for (const EnclosedCells::Piece& piece : cells.pieces) {
    const std::size_t k = piece.edge;
    const double middle_t = 0.5 * (piece.from + piece.to);
    CHECK(piece.from < piece.to);
    const auto [x, y] = middle(cells, piece.cell);
    CHECK(std::abs(polygon.x[k] + middle_t * (polygon.x[polygon.next(k)] - polygon.x[k]) - x) < h / 2 + 1e-12);
    CHECK(std::abs(polygon.y[k] + middle_t * (polygon.y[polygon.next(k)] - polygon.y[k]) - y) < h / 2 + 1e-12);
    start[k] += piece.to - piece.from - 0.5 * (piece.to * piece.to - piece.from * piece.from);  // int (1 - t) dt
    end[k] += 0.5 * (piece.to * piece.to - piece.from * piece.from);
  }
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    CHECK(start[k] == near(0.5, 1e-12));
    CHECK(end[k] == near(0.5, 1e-12));
  }
}

TEST_CASE("Cells of unlike width: shares add up to the area, faces are the parts between crossings") {
  const Scene scene = graded_scene<2>(20, h, WallKind::slip);
  const GridLayout<2> graded(scene.grid, scene.walls);
  for (const int corners : {5, 60}) {
    CAPTURE(corners);
    const Polygon polygon = star(4.6, 5.2, corners, 18);
    EnclosedCells cells;
    cut_cells(graded, polygon.x, polygon.y, cells);
    double sum = 0;
    for (int c = 0; c < static_cast<int>(cells.area.size()); ++c) {
      const KnotSpan& x = graded.knots[0][cells.first[0] + c % cells.count[0]];
      const KnotSpan& y = graded.knots[1][cells.first[1] + c / cells.count[0]];
      sum += cells.area[c] * x.width * y.width;
      const double mid_x = x.left + x.width / 2, mid_y = y.left + y.width / 2;
      check_moments(cells.right_face[c], moments_of_face(polygon, 0, x.left + x.width, mid_y, y.width));
      check_moments(cells.top_face[c], moments_of_face(polygon, 1, y.left + y.width, mid_x, x.width));
    }
    CHECK(std::abs(sum - area(polygon)) < 1e-13 * area(polygon));
  }
}

TEST_CASE("Cells of unlike width, worked by hand: a rectangle, and splines over a part of a face") {
  // Knot spans 0.4, 0.2, 0.1 m wide: N of the node above is 0.2 / 0.3 = 2/3 at the end of the middle one, that of the
  // node below 1/3 at its beginning.
  const FaceMoments whole{1, 0, 1.0 / 12};
  const auto [below, own, above] = face_integrals(whole, 1.0 / 3, 2.0 / 3);
  CHECK(below == near(1.0 / 9, 1e-12));  // 1/3 int t^2
  CHECK(above == near(2.0 / 9, 1e-12));
  CHECK(own == near(2.0 / 3, 1e-12));
  const FaceMoments upper_half{0.5, 0.125, 1.0 / 24};
  const auto [below_2, own_2, above_2] = face_integrals(upper_half, 1.0 / 3, 2.0 / 3);
  CHECK(below_2 == near(1.0 / 72, 1e-12));  // 1/3 of int t^2 from 0 to 1/2
  CHECK(above_2 == near(7.0 / 36, 1e-12));  // 2/3 of int t^2 from 1/2 to 1
  CHECK(own_2 == near(0.5 - 15.0 / 72, 1e-12));
}

TEST_CASE("Cells are made anew for each outline") {
  const Polygon large = star(5.0, 5.0, 50, 17), small{{1.0, 2.0, 1.0}, {1.0, 1.0, 2.0}};
  EnclosedCells cells;
  cut_cells(layout(), large.x, large.y, cells);
  cut_cells(layout(), small.x, small.y, cells);
  CHECK(largest_difference(cells, cut(small)) == 0);
  CHECK(cells.pieces.size() == cut(small).pieces.size());
}
