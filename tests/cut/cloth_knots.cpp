// Knots of the pressure on cloth in space: even over it, wherever the cloth has gone; the space of tractions there.
#include "cut/cloth_knots.hpp"

#include <doctest/doctest.h>

#include <Eigen/Dense>

#include <cmath>

#include "cut/clipped_surface.hpp"
#include "cut/traction_basis.hpp"
#include "membrane/triangles.hpp"
#include "support/near.hpp"
#include "support/random_particles.hpp"
#include "support/surfaces.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double h = 0.25;

Membrane<3> ball() {
  Membrane<3> membrane = membrane_of(ellipsoid_surface({0.03, 0.05, 0.07}, {1, 1, 1}, h));
  for (std::size_t t = 0; t < membrane.triangles.size(); ++t) {
    const Eigen::Matrix2d edges = rest_edges(corners_of(membrane, t), Eigen::Vector3d::UnitX());
    const Eigen::Matrix2d inverse = edges.inverse();
    for (int c = 0; c < 4; ++c) membrane.triangles.inverse_rest[c].push_back(inverse(c / 2, c % 2));
  }
  return membrane;
}

double area_of(const Membrane<3>& membrane, std::size_t triangle) { return 0.5 * normal_of(membrane, triangle).norm(); }

/// A wet ball on a grid of cells of h, and the rows of its stretches.
struct WetBall {
  Membrane<3> membrane = ball();
  ClothKnots knots = cloth_knots(membrane, between_knots* h);
  Grids<3> grids;
  std::vector<Contact<3>> contacts;
  std::vector<RowOfContact> rows;

  WetBall() {
    membrane.field = 1;
    for (Grid<3>& grid : grids = {Grid<3>{}, Grid<3>{}}) grid.layout = small_grid(h);
    ClippedSurface& outline = grids[1].outline;
    clip_surface(grids[0].layout, membrane, outline);
    grids[0].cell_volume.assign(grids[0].layout.nodes(), 1.0);
    grids[0].taken.assign(grids[0].layout.nodes(), 0.0);
    for (const Stretch& stretch : stretches_of(grids[0], membrane, outline)) {
      contacts.push_back({&membrane, stretch, &knots});
      rows.push_back({contacts.size() - 1, Says::normal});
    }
  }
  Eigen::MatrixXd basis() const { return traction_basis(contacts, grids, rows, 0).toDense(); }
};

}  // namespace

TEST_CASE("Knots of a ball are two cells apart: one for each area of about three to five cells; shares add up to one") {
  const Membrane<3> membrane = ball();
  const ClothKnots knots = cloth_knots(membrane, 2 * h);
  REQUIRE(knots.of_triangle.size() == membrane.triangles.size());
  const double of_knot = 4 * M_PI / knots.count;
  CHECK(of_knot > 2.8 * h * h);
  CHECK(of_knot < 5.0 * h * h);
  for (const KnotShares& shares : knots.of_triangle) {
    double sum = 0;
    for (const auto& [knot, value] : shares) {
      CHECK(knot >= 0);
      CHECK(knot < knots.count);
      CHECK(value > 0);
      sum += value;
    }
    CHECK(sum == near(1, 1e-14));
    CHECK(shares.size() >= 2);
    CHECK(shares.size() <= 12);
  }
}

TEST_CASE("Where the cloth has gone, and how much it is crumpled, changes no knot") {
  Membrane<3> membrane = ball();
  const ClothKnots before = cloth_knots(membrane, 2 * h);
  Random random(5);
  for (auto& x : membrane.x)
    for (double& value : x) value = 0.1 * value + random.uniform(0, 0.1);
  const ClothKnots after = cloth_knots(membrane, 2 * h);
  REQUIRE(after.count == before.count);
  for (std::size_t t = 0; t < before.of_triangle.size(); ++t) {
    REQUIRE(after.of_triangle[t].size() == before.of_triangle[t].size());
    for (std::size_t k = 0; k < before.of_triangle[t].size(); ++k)
      CHECK(after.of_triangle[t][k].value == before.of_triangle[t][k].value);
  }
}

TEST_CASE("A knot takes from triangles within 1.25 times the distance, the more the nearer they are") {
  const Membrane<3> membrane = ball();
  const ClothKnots knots = cloth_knots(membrane, 2 * h);
  for (int knot = 0; knot < knots.count; ++knot) {
    Vec<3> middle = Vec<3>::Zero();
    double whole = 0, most = 0;
    for (std::size_t t = 0; t < membrane.triangles.size(); ++t)
      for (const auto& [of, value] : knots.of_triangle[t])
        if (of == knot) {
          middle += value * area_of(membrane, t) * middle_of(membrane, t);
          whole += value * area_of(membrane, t);
          most = std::max(most, value);
        }
    middle /= whole;
    CHECK(most > 0.35);
    for (std::size_t t = 0; t < membrane.triangles.size(); ++t)
      for (const auto& [of, value] : knots.of_triangle[t])
        if (of == knot) CHECK((middle_of(membrane, t) - middle).norm() < 1.25 * 2 * h + 0.5 * h);
  }
}

TEST_CASE("Tractions of a ball: an even pressure and that of still water are among them, alternating ones are not") {
  WetBall wet;
  const Eigen::MatrixXd B = wet.basis();
  REQUIRE(B.rows() == static_cast<Eigen::Index>(wet.contacts.size()));
  CHECK(B.cols() < B.rows() / 3);
  CHECK((B.rowwise().sum() - Eigen::VectorXd::Ones(B.rows())).cwiseAbs().maxCoeff() < 1e-12);
  Eigen::VectorXd still(B.rows()), alternating(B.rows());
  for (Eigen::Index r = 0; r < B.rows(); ++r) {
    double height = 0;
    for_each_share(wet.grids[1].outline, wet.contacts[r].stretch, [&](std::size_t triangle, double share) {
      height += share * area_of(wet.membrane, triangle) * middle_of(wet.membrane, triangle)[2];
    });
    still[r] = height / wet.contacts[r].stretch.size;
    alternating[r] = r % 2 == 0 ? 1 : -1;
  }
  const auto missing = [&](const Eigen::VectorXd& tractions) {
    const Eigen::VectorXd x = B.colPivHouseholderQr().solve(tractions);
    return (tractions - B * x).norm() / tractions.norm();
  };
  CHECK(missing(still) < 0.05);
  CHECK(missing(alternating) > 0.7);
}

TEST_CASE("Stretches on the bed have a pressure each, the others those of knots") {
  WetBall wet;
  const Eigen::Index all = wet.basis().cols();
  for (const std::size_t c : {3, 7}) wet.contacts[c].on_bed = true;
  const Eigen::MatrixXd B = wet.basis();
  CHECK(B.cols() <= all + 2);
  for (const Eigen::Index r : {3, 7}) {
    CHECK(B.row(r).maxCoeff() == 1);
    CHECK(B.row(r).sum() == 1);
    Eigen::Index column = 0;
    B.row(r).maxCoeff(&column);
    CHECK(B.col(column).sum() == 1);
  }
}
