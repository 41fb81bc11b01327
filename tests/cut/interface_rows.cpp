// The rows of the constraint at sharp interfaces, by hand: stretches, line integrals, walls, light nodes, impulses.
#include "cut/interface_rows.hpp"

#include <doctest/doctest.h>

#include "cut/cut_cells.hpp"
#include "support/near.hpp"
#include "support/sharp_box.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

SharpBox full(const Corners& at = {}, Sense sense = Sense::anticlockwise) {
  SharpBox box(at, sense);
  box.fill_cells();
  return box;
}

std::vector<Stretch> stretches_along(SharpBox& box) {
  return stretches_of(box.around(), box.skin(), box.inside().outline);
}

/// Lengths and pieces of all stretches.
std::pair<double, std::size_t> sums(const std::vector<Stretch>& stretches) {
  std::pair<double, std::size_t> sum{0, 0};
  for (const Stretch& stretch : stretches) sum = {sum.first + stretch.size, sum.second + stretch.count};
  return sum;
}

/// Sum of the entries of a row times the root of the masses that they were divided by, by field: of vectors, x and y.
std::array<std::array<double, 2>, 2> impulses(const Rows<2>& rows) {
  std::array<std::array<double, 2>, 2> sum{};
  const NodeRows<2> E = rows.matrix();
  for (const auto& [number, value] : E.rows.front()) {
    const Places<2>::Place& place = rows.places().list()[number];
    for (int a = 0; a < 2; ++a) sum[place.field][a] += value[a] * place.root_mass;
  }
  return sum;
}

/// Rows, two columns for each place.
Eigen::MatrixXd dense(const NodeRows<2>& E) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(E.rows.size(), 2 * E.places);
  for (std::size_t r = 0; r < E.rows.size(); ++r)
    for (const auto& [place, value] : E.rows[r])
      for (int a = 0; a < 2; ++a) out(r, 2 * place + a) = value[a];
  return out;
}

bool add(Rows<2>& rows, const SharpBox& box, int field, int other, const std::vector<NodeVector<2>>& vectors) {
  return rows.add(make_row(box.grids, field, other, vectors));
}

}  // namespace

TEST_CASE("Stretches run from cell to cell, all round a wet outline") {
  for (const Sense sense : {Sense::anticlockwise, Sense::clockwise}) {
    SharpBox box = full({}, sense);
    const std::vector<Stretch> stretches = stretches_along(box);
    CHECK(stretches.size() == 12);  // cells 3 to 6 along both axes, but for the four in the midst
    CHECK(sums(stretches).first == near(2 * (3.05 + 3.5), 1e-13));
    CHECK(sums(stretches).second == box.inside().outline.pieces.size());
    for (const Stretch& stretch : stretches) CHECK(stretch.size > 0.9);
  }
}

TEST_CASE("Where nothing is beside a membrane there is no stretch") {
  SharpBox box = full();
  Grid<2>& around = box.around();
  for (int j = 0; j <= box_cells; ++j)  // water up to y = 4.5
    for (int i = 0; i <= box_cells; ++i)
      if (j > 4) around.cell_volume[box.flat(i, j)] = 0;
  const std::vector<Stretch> stretches = stretches_along(box);
  CHECK_FALSE(stretches.empty());
  for (const Stretch& stretch : stretches)
    for_each_piece(box.inside().outline, stretch, [&](const CutCells::Piece& piece) {
      CHECK(piece.cell / box.inside().outline.count[0] + box.inside().outline.first[1] - 2 <= 5);
    });
  std::fill(around.cell_volume.begin(), around.cell_volume.end(), 0.0);
  CHECK(stretches_along(box).empty());
}

TEST_CASE("The end of a fold of empty cloth thinner than a fifth of a cell is no stretch") {
  // A bag up to y = 4.4 m, 2 m wide; the fold on top of it, about x = 4 m, up to 7.2 m.
  const auto stretches_at = [](double thickness, int row) {
    const double left = 4 - thickness / 2, right = 4 + thickness / 2;
    SharpBox box;
    box.draw({{3, 2.6}, {5, 2.6}, {5, 4.4}, {right, 4.4}, {right, 7.2}, {left, 7.2}, {left, 4.4}, {3, 4.4}});
    cut_interface_cells(box.state, box.grids);
    box.fill_cells();
    const CutCells& cells = box.inside().outline;
    int found = 0;
    for (const Stretch& stretch : stretches_along(box))
      for_each_piece(cells, stretch, [&](const CutCells::Piece& piece) {
        found += flat_of(box.around().layout, cells, piece.cell) == box.flat(4, row);
      });
    return found;
  };
  for (const double thickness : {0.15, 0.25}) CHECK(stretches_at(thickness, 6) == 2);
  CHECK(stretches_at(0.25, 7) == 3);
  CHECK(stretches_at(0.15, 7) == 0);
}

TEST_CASE("A stretch shorter than a quarter of a cell joins its neighbour") {
  for (const double tip : {5.55, 5.75}) {  // 0.05 and 0.25 m beyond the face of the cells
    CAPTURE(tip);
    SharpBox box;
    box.draw({{3, 3.1}, {tip, 4}, {3, 4.9}});
    cut_interface_cells(box.state, box.grids);
    box.fill_cells();
    const std::vector<Stretch> stretches = stretches_along(box);
    const CutCells& cells = box.inside().outline;
    double perimeter = 0, in_tip = 0;
    for (const CutCells::Piece& piece : cells.pieces) {
      perimeter += length_of(box.skin(), piece);
      if (flat_of(box.around().layout, cells, piece.cell) == box.flat(6, 4)) in_tip += length_of(box.skin(), piece);
    }
    CHECK(in_tip == near(2 * (tip - 5.5) * std::hypot(tip - 3, 0.9) / (tip - 3), 1e-12));
    CHECK(sums(stretches).first == near(perimeter, 1e-13));
    int alone = 0;
    for (const Stretch& stretch : stretches) alone += std::abs(stretch.size - in_tip) < 1e-12;
    CHECK(alone == (in_tip < 0.25 ? 0 : 1));
  }
}

TEST_CASE(
    "Line integrals of N n add up to the normals of a stretch; the row along it is the normal one turned "
    "anticlockwise") {
  for (const Sense sense : {Sense::anticlockwise, Sense::clockwise}) {
    SharpBox box = full({}, sense);
    for (Grid<2>& grid : box.grids) box.set_mass(grid, 4.0);
    const CutCells& cells = box.inside().outline;
    for (const Stretch& stretch : stretches_along(box)) {
      std::array<double, 2> normal{}, n{};
      for_each_piece(cells, stretch, [&](const CutCells::Piece& piece) {
        const Vec<2> from = vector_at(box.skin().x, piece.edge);
        const Vec<2> d = vector_at(box.skin().x, (piece.edge + 1) % box.skin().nodes()) - from;
        const double sign = sense == Sense::anticlockwise ? 1 : -1, part = piece.to - piece.from;
        normal[0] += sign * part * d[1];
        normal[1] -= sign * part * d[0];
      });
      const std::vector<NodeVector<2>> vectors = normals_over(box.around().layout, box.skin(), cells, stretch);
      for (const NodeVector<2>& vector : vectors)
        for (int a = 0; a < 2; ++a) n[a] += vector.value[a];
      for (int a = 0; a < 2; ++a) CHECK(n[a] == within(normal[a], 1e-14));
      std::vector<NodeVector<2>> turned = vectors;
      for (NodeVector<2>& vector : turned) vector.value = {-vector.value[1], vector.value[0]};
      const int field = box.skin().field;
      const RawRow<2> row = along(make_row(box.grids, field, 0, vectors)), same = make_row(box.grids, field, 0, turned);
      REQUIRE(row.entries.size() == same.entries.size());
      REQUIRE(!row.entries.empty());
      for (std::size_t k = 0; k < row.entries.size(); ++k) {
        CHECK(row.entries[k].node == same.entries[k].node);
        CHECK(row.entries[k].value == same.entries[k].value);
      }
    }
  }
}

TEST_CASE("Walls hold the normal component of their nodes, no-slip walls both") {
  for (const WallKind wall : {WallKind::slip, WallKind::no_slip}) {
    SharpBox box({0.75, 11.25, 0.75, 11.25}, Sense::anticlockwise, wall);
    for (Grid<2>& grid : box.grids) box.set_mass(grid, 4.0);
    Places<2> places(box.grids);
    const bool sticks = wall == WallKind::no_slip;
    struct Node {
      int i, j;
      std::array<bool, 2> fixed;
    };
    const int last = box_cells;
    for (const Node& node : {Node{5, 5, {false, false}}, Node{0, 5, {true, sticks}}, Node{last, 5, {true, sticks}},
                             Node{5, 0, {sticks, true}}, Node{5, last, {sticks, true}}, Node{0, 0, {true, true}},
                             Node{1, last - 1, {false, false}}}) {
      CAPTURE(node.i);
      CAPTURE(node.j);
      const int number = places.of(1, box.flat(node.i, node.j));
      const Places<2>::Place& place = places.list()[number];
      CHECK(place.fixed == node.fixed);
      CHECK(place.root_mass == 2.0);
      CHECK(place.field == 1);
      CHECK(place.node == box.flat(node.i, node.j));
      CHECK(places.of(1, box.flat(node.i, node.j)) == number);
    }
    CHECK(places.list().size() == 7);
    CHECK(places.of(0, box.flat(5, 5)) == 7);  // another field, another place
  }
}

TEST_CASE("A row adds up one field's vectors over the roots of the masses and takes off the other's") {
  SharpBox box;
  box.set_mass(box.inside(), 4e3);
  box.set_mass(box.around(), 9e3);
  Rows<2> rows(box.grids);
  REQUIRE(add(rows, box, 1, 0, {{box.flat(5, 5), {0.5, 0}}, {box.flat(5, 6), {0.25, -1}}}));
  const Eigen::MatrixXd E = dense(rows.matrix());
  REQUIRE(E.rows() == 1);
  REQUIRE(E.cols() == 8);
  const double inside = std::sqrt(4e3), around = std::sqrt(9e3);
  const double expected[] = {0.5 / inside, 0, 0.25 / inside, -1 / inside, -0.5 / around, 0, -0.25 / around, 1 / around};
  for (int c = 0; c < 8; ++c) CHECK(E(0, c) == within(expected[c], 1e-16));
  box.inside().velocity[box.flat(5, 6)] = Vec4{3, 2, 0, 0};
  const Eigen::VectorXd scaled = rows.scaled_velocities();
  CHECK(scaled[2] == near(3 * inside, 1e-14));
  CHECK(scaled[3] == near(2 * inside, 1e-14));
  CHECK(scaled[4] == 0);
}

TEST_CASE("A light node keeps its share of a vector and hands on the rest by mass; nothing is lost") {
  SharpBox box;
  for (Grid<2>& grid : box.grids) box.set_mass(grid, 1000);
  const double light = 20;  // 2 % of a full node
  REQUIRE(box.inside().light_mass == near(light, 1e-12));
  for (const double mass : {5.0, 0.0}) {
    CAPTURE(mass);
    box.inside().sum[box.flat(5, 5)][3] = mass;
    Rows<2> rows(box.grids);
    REQUIRE(add(rows, box, 1, 0, {{box.flat(5, 5), {0.6, -0.3}}}));
    const auto sum = impulses(rows);
    CHECK(sum[1][0] == near(0.6, 1e-13));
    CHECK(sum[1][1] == near(-0.3, 1e-13));
    CHECK(sum[0][0] == near(-0.6, 1e-13));
    const Eigen::MatrixXd E = dense(rows.matrix());
    for (std::size_t n = 0; n < rows.places().list().size(); ++n) {
      const Places<2>::Place& place = rows.places().list()[n];
      if (place.field != 1) continue;
      const double kept = mass / light, spread = (1 - kept) * place.root_mass * place.root_mass / (8000 + mass);
      const double share = spread + (place.node == box.flat(5, 5) ? kept : 0.0);
      CHECK(E(0, 2 * static_cast<int>(n)) * place.root_mass == near(0.6 * share, 1e-12));
    }
  }
}

TEST_CASE("What has no mass around goes to the nodes that the row reaches; with none at all there is no row") {
  SharpBox box;
  box.set_mass(box.around(), 1000);
  Rows<2> rows(box.grids);
  CHECK_FALSE(add(rows, box, 1, 0, {{box.flat(5, 5), {1, 0}}}));
  CHECK_FALSE(add(rows, box, 0, 1, {{box.flat(5, 5), {1, 0}}}));
  CHECK(rows.count() == 0);
  box.inside().sum[box.flat(2, 2)][3] = 1000;
  REQUIRE(add(rows, box, 1, 0, {{box.flat(2, 2), {1, 0}}, {box.flat(8, 8), {0.5, 2}}}));
  CHECK(rows.count() == 1);
  const auto sum = impulses(rows);
  CHECK(sum[1][0] == near(1.5, 1e-13));
  CHECK(sum[1][1] == near(2, 1e-13));
  CHECK(sum[0][1] == near(-2, 1e-13));
}

TEST_CASE("Pressures change velocities by dt p b / m, in opposite senses, and what blend remembers of them") {
  SharpBox box;
  box.set_mass(box.inside(), 4e3);
  box.set_mass(box.around(), 9e3);
  Rows<2> rows(box.grids);
  REQUIRE(add(rows, box, 1, 0, {{box.flat(5, 5), {0.5, -0.25}}}));
  Eigen::VectorXd pressure(1);
  pressure << 2e3;
  box.inside().velocity[box.flat(5, 5)] = Vec4{1, 1, 0, 0};
  apply_pressures(rows, ByPlace<2>(rows.matrix()), pressure, 0.01, box.grids);
  CHECK(box.inside().velocity[box.flat(5, 5)][0] == near(1 - 0.01 * 2e3 * 0.5 / 4e3, 1e-14));
  CHECK(box.inside().velocity[box.flat(5, 5)][1] == near(1 + 0.01 * 2e3 * 0.25 / 4e3, 1e-14));
  CHECK(box.around().velocity[box.flat(5, 5)][0] == near(0.01 * 2e3 * 0.5 / 9e3, 1e-14));
  CHECK(box.inside().velocity_change[box.flat(5, 5)][0] == near(-0.01 * 2e3 * 0.5 / 4e3, 1e-14));
}

TEST_CASE("Products of rows over places, entry by entry") {
  const NodeRows<2> A{{{{0, {2, 0}}, {1, {0, -1}}}, {{0, {0, 4}}}}, 2};
  const NodeRows<2> B{{{{1, {0, 5}}}, {{0, {3, 0.5}}, {1, {0, -1}}}, {{1, {7, 0}}}}, 2};
  const Eigen::MatrixXd square = symmetric_product(A, ByPlace<2>(A)), both{{5, 0}, {0, 16}};
  CHECK((square - both).norm() < 1e-15);
  SparseRows sums(2, 3);
  sums.insert(0, 1) = 2, sums.insert(1, 0) = 1, sums.insert(1, 2) = -3;
  sums.makeCompressed();
  CHECK((dense(times(sums, B)) - Eigen::MatrixXd(sums) * dense(B)).norm() < 1e-15);
  const Drag K{{2, 0.5, 1}, {3, 0.5, 0}};
  const Eigen::Matrix4d whole{{2, 0, 0.5, 0}, {0, 2, 0, 0.5}, {0.5, 0, 3, 0}, {0, 0.5, 0, 3}};
  const NodeRows<2> dragged = times(B, K);
  CHECK((dense(dragged) - dense(B) * whole).norm() < 1e-14);
  CHECK((Eigen::MatrixXd(symmetric_product(dragged, ByPlace<2>(B))) - dense(B) * whole * dense(B).transpose()).norm() <
        1e-13);
  const Eigen::VectorXd v{{1, -2, 0.5, 3}};
  CHECK((times(B, v) - dense(B) * v).norm() < 1e-14);
}
