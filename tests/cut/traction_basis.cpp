// How tractions vary along an outline, on a rectangular bag by hand: which fields of pressure there are, and which not.
#include "cut/traction_basis.hpp"

#include <doctest/doctest.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

#include "cut/cut_cells.hpp"
#include "membrane/outline.hpp"
#include "support/near.hpp"
#include "support/sharp_box.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

/// Stretches of a bag in water and its rows, one normal row each.
struct Bag {
  SharpBox box;
  std::vector<Contact<2>> contacts;
  std::vector<RowOfContact> rows;

  explicit Bag(const Corners& at = {2.75, 5.8, 2.75, 6.25}, Sense sense = Sense::anticlockwise) : box(at, sense) {
    read();
  }

  /// A regular polygon around (6, 6).
  Bag(int sides, double radius) {
    std::vector<std::array<double, 2>> points;
    for (int k = 0; k < sides; ++k)
      points.push_back({6 + radius * std::cos(2 * M_PI * k / sides), 6 + radius * std::sin(2 * M_PI * k / sides)});
    box.draw(points);
    cut_interface_cells(box.state, box.grids);
    read();
  }

  void read() {
    box.fill_cells();
    contacts.clear();
    rows.clear();
    for (const Stretch& stretch : stretches_of(box.around(), box.skin(), outline()))
      contacts.push_back({&box.skin(), stretch});
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      contacts[c].joined = contacts[c].has_rows = true;
      rows.push_back({c, Says::normal});
    }
  }

  const CutCells& outline() const { return box.grids[1].outline; }
  Eigen::MatrixXd basis(std::size_t others = 0) const {
    return traction_basis(contacts, box.grids, rows, others).toDense();
  }

  /// Means of f(x, y), linear, over the stretches.
  template <class F>
  Eigen::VectorXd means(F&& f) const {
    Eigen::VectorXd out = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(contacts.size()));
    for (std::size_t c = 0; c < contacts.size(); ++c)
      for_each_piece(outline(), contacts[c].stretch, [&](const CutCells::Piece& piece) {
        const Array<double>&x = box.state.membranes[0].x[0], &y = box.state.membranes[0].x[1];
        const std::size_t from = piece.edge, to = (from + 1) % x.size();
        const double middle = 0.5 * (piece.from + piece.to);
        out[static_cast<Eigen::Index>(c)] +=
            length_of(box.state.membranes[0], piece) / contacts[c].stretch.size *
            f(x[from] + middle * (x[to] - x[from]), y[from] + middle * (y[to] - y[from]));
      });
    return out;
  }
};

/// What of tractions no values at knots give, of their size.
double missing(const Eigen::MatrixXd& basis, const Eigen::VectorXd& tractions) {
  const Eigen::VectorXd knots = basis.colPivHouseholderQr().solve(tractions);
  return (tractions - basis * knots).norm() / tractions.norm();
}

Eigen::VectorXd alternating(std::size_t count) {
  Eigen::VectorXd out(static_cast<Eigen::Index>(count));
  for (Eigen::Index k = 0; k < out.size(); ++k) out[k] = k % 2 == 0 ? 1 : -1;
  return out;
}

}  // namespace

TEST_CASE(
    "Knots are two cells apart and at corners: pressures linear along the sides are there, alternating ones not") {
  for (const Sense sense : {Sense::anticlockwise, Sense::clockwise}) {
    const Bag bag({2.75, 5.8, 2.75, 6.25}, sense);
    const Eigen::MatrixXd basis = bag.basis();
    CHECK(basis.rows() == 12);
    CHECK(basis.cols() == 8);  // sides of 3.05 and 3.5 cells: two intervals each
    for (Eigen::Index r = 0; r < basis.rows(); ++r) CHECK(basis.row(r).sum() == near(1, 1e-14));
    CHECK(missing(basis, bag.means([](double x, double y) { return 3 + 2 * x - y; })) < 1e-13);
    CHECK(missing(basis, bag.means([](double, double y) { return std::abs(y - 4.5); })) < 1e-13);  // a knot half way up
    CHECK(missing(basis, alternating(12)) > 0.7);
  }
}

TEST_CASE("Knots are two cells apart along each axis: on flat cells the same as on square ones") {
  constexpr double flat = 0.25;
  Bag bag;
  const Eigen::MatrixXd of_square = bag.basis();
  GridSpec& grid = bag.box.scene.grid;
  grid.upper[1] *= flat;
  grid.refine = {{1, grid.lower[1], grid.upper[1], flat * grid.spacing, 1.1, {}}};
  for (Grid<2>& field : bag.box.grids) field.layout = GridLayout<2>(grid, bag.box.scene.walls);
  REQUIRE(bag.box.around().layout.cells == std::array<int, 2>{box_cells, box_cells});
  for (double& y : bag.box.skin().x[1]) y *= flat;
  cut_interface_cells(bag.box.state, bag.box.grids);
  bag.read();
  const Eigen::MatrixXd of_flat = bag.basis();
  REQUIRE(of_flat.rows() == of_square.rows());
  REQUIRE(of_flat.cols() == of_square.cols());
  CHECK((of_flat - of_square).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("A smooth outline has a multiple of four knots from its first node on, so that its halves are alike") {
  for (const auto& [radius, knots] : {std::pair{3.0, 8}, std::pair{3.7, 12}}) {
    const Bag bag(48, radius);  // 18.8 and 23.2 cells round
    const Eigen::MatrixXd basis = bag.basis();
    CHECK(basis.cols() == knots);
    CHECK(missing(basis, Eigen::VectorXd::Ones(basis.rows())) < 1e-13);
    const auto left_right = bag.means([&](double x, double) { return std::abs(x - 6); });
    const auto up_down = bag.means([&](double, double y) { return std::abs(y - 6); });
    CHECK(missing(basis, left_right) == near(missing(basis, up_down), 1e-9));
    CHECK(missing(basis, left_right) < 0.05);
  }
}

TEST_CASE("Corners within a cell are one knot, at their mean place by the angles that they turn by") {
  // A wedge with a blunt tip 0.8 m wide on the left, between cells; square corners on the right; from any node on.
  std::vector<std::array<double, 2>> points{{2.0, 5.6}, {8.2, 2.2}, {8.2, 9.8}, {2.0, 6.4}};
  for (std::size_t first = 0; first < points.size(); ++first) {
    Bag bag;
    bag.box.draw(points);
    cut_interface_cells(bag.box.state, bag.box.grids);
    bag.read();
    const Eigen::MatrixXd basis = bag.basis();
    for (Eigen::Index r = 0; r < basis.rows(); ++r) CHECK(basis.row(r).sum() == near(1, 1e-14));
    const double up = missing(basis, bag.means([](double, double y) { return std::max(y, 6.0) - 6; })),
                 down = missing(basis, bag.means([](double, double y) { return 6 - std::min(y, 6.0); }));
    CHECK(up < 0.05);
    CHECK(up == near(down, 0.05));  // the knot is in the middle of the tip
    std::rotate(points.begin(), points.begin() + 1, points.end());
  }
}

TEST_CASE("Knots end where the bed begins, where an outline is dry and where a row is missing") {
  Bag bag;
  const std::size_t n = bag.contacts.size();
  // Where the bed's part ends the pressure may jump.
  Eigen::VectorXd jump = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(n));
  for (const std::size_t c : {2, 3, 4, 5}) bag.contacts[c].on_bed = true, jump[static_cast<Eigen::Index>(c)] = 1;
  CHECK(missing(bag.basis(), jump) < 1e-13);
  CHECK(missing(Bag().basis(), jump) > 0.2);
  // A single stretch between two that are not joined has one pressure, its own; the two have none.
  bag = Bag();
  bag.contacts[7].joined = bag.contacts[9].joined = false;
  bag.rows.erase(bag.rows.begin() + 9);
  bag.rows.erase(bag.rows.begin() + 7);
  const Eigen::MatrixXd basis = bag.basis();
  CHECK(basis.rows() == 10);
  CHECK(missing(basis, Eigen::VectorXd::Unit(10, 7)) < 1e-13);
  CHECK(missing(basis, Eigen::VectorXd::Unit(10, 3)) > 0.3);
}

TEST_CASE("Tractions along the membrane and of other rows are their own; those through it have knots of their own") {
  Bag bag;
  std::vector<RowOfContact> rows;
  for (std::size_t c = 0; c < bag.contacts.size(); ++c)
    for (const Says says : {Says::normal, Says::through, Says::tangent}) rows.push_back({c, says});
  const Eigen::MatrixXd normal = bag.basis();
  bag.rows = rows;
  const Eigen::MatrixXd basis = bag.basis(2);
  CHECK(basis.rows() == 3 * 12 + 2);
  CHECK(basis.cols() == 2 * 8 + 12 + 2);
  for (const Eigen::Index r : {Eigen::Index{2}, Eigen::Index{35}, Eigen::Index{36}, Eigen::Index{37}}) {
    CHECK(basis.row(r).maxCoeff() == 1);
    CHECK(basis.row(r).cwiseAbs().sum() == 1);
    CHECK(basis
              .col((basis.row(r).array() == 1)
                       .matrix()
                       .cast<double>()
                       .dot(Eigen::RowVectorXd::LinSpaced(basis.cols(), 0, static_cast<double>(basis.cols() - 1))))
              .cwiseAbs()
              .sum() == 1);
  }
  for (const Eigen::Index says : {0, 1}) {
    Eigen::VectorXd tractions = Eigen::VectorXd::Zero(basis.rows());
    for (Eigen::Index c = 0; c < 12; ++c) tractions[3 * c + says] = normal(c, 3);
    CHECK(missing(basis, tractions) < 1e-13);
  }
}
