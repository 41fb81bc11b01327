// The nearest point of a triangle, and the side of a surface that a point is on.
#include <doctest/doctest.h>

#include <cmath>

#include "cut/clipped_surface.hpp"
#include "cut/near_triangles.hpp"
#include "geometry/triangle.hpp"
#include "support/near.hpp"
#include "support/random_particles.hpp"
#include "support/surfaces.hpp"

using namespace geodrop;
using namespace geodrop::test;

TEST_CASE("Nearest points of a triangle: corners, edges, inside, by hand") {
  const std::array<Vec<3>, 3> triangle{Vec<3>(0, 0, 0), Vec<3>(4, 0, 0), Vec<3>(0, 3, 0)};
  const auto check = [&](const Vec<3>& x, const Vec<3>& point) {
    CHECK((nearest_point(triangle, x) - point).norm() < 1e-14);
  };
  check({1, 1, 5}, {1, 1, 0});
  check({-1, -2, 1}, {0, 0, 0});
  check({6, -1, 1}, {4, 0, 0});
  check({-1, 5, 1}, {0, 3, 0});
  check({2, -3, 1}, {2, 0, 0});
  check({-2, 1, 1}, {0, 1, 0});
  check({2 + 3, 1.5 + 4, -2}, {2, 1.5, 0});
}

TEST_CASE("Points on the right side stay, others go to the nearest point of the surface") {
  const GridLayout<3> layout = small_grid(0.25);
  const Membrane<3> membrane = membrane_of(ellipsoid_surface({0.03, 0.05, 0.07}, {1, 0.8, 1.2}, 0.1));
  ClippedSurface cells;
  clip_surface(layout, membrane, cells);
  const NearTriangles near_by(layout, membrane, cells);
  Random random(7);
  int moved = 0, stayed = 0;
  for (int k = 0; k < 4000; ++k) {
    Vec<3> x(random.uniform(-1.3, 1.3), random.uniform(-1.1, 1.1), random.uniform(-1.5, 1.5));
    const Vec<3> from_centre = x - Vec<3>(0.03, 0.05, 0.07);
    const double level =
        std::sqrt(std::pow(from_centre[0], 2) + std::pow(from_centre[1] / 0.8, 2) + std::pow(from_centre[2] / 1.2, 2));
    if (std::abs(level - 1) < 0.01 || std::abs(level - 1) > 0.2) continue;  // triangles lie within .5 % of it
    const bool is_inside = level < 1;
    CHECK(!near_by.on_side(x, is_inside));
    ++stayed;
    const auto side = near_by.on_side(x, !is_inside);
    REQUIRE(side);
    const Vec<3>& to = side->to;
    Vec<3> point = Vec<3>::Zero();
    for (std::size_t c = 0; c < 3; ++c) point += side->share[c] * vector_at(membrane.x, side->nodes[c]);
    CHECK(std::abs((to - point).norm() - 2.5e-4) < 1e-10);
    double nearest = 1e9;
    for (std::size_t t = 0; t < membrane.triangles.size(); ++t) {
      std::array<Vec<3>, 3> corner;
      for (std::size_t c = 0; c < 3; ++c) corner[c] = vector_at(membrane.x, membrane.triangles.corner[c][t]);
      nearest = std::min(nearest, (nearest_point(corner, x) - x).norm());
    }
    CHECK(std::abs((to - x).norm() - nearest) < 2.6e-4);  // and a thousandth of a cell beyond
    CHECK(!near_by.on_side(to, !is_inside));
    ++moved;
  }
  CHECK(stayed > 300);
  CHECK(moved == stayed);
}

TEST_CASE("Beside a thin bag the nearer of its sides tells, not the farther one") {
  const GridLayout<3> layout = small_grid(0.25);
  const Membrane<3> membrane = membrane_of(flat_bag());
  ClippedSurface cells;
  clip_surface(layout, membrane, cells);
  const NearTriangles near_by(layout, membrane, cells);
  for (double x = -0.5; x < 0.5; x += 0.07)
    for (const double z : {-0.15, -0.11, 0.13, 0.17}) {
      const Vec<3> outside(x, 0.3 * x, z), inside(x, 0.3 * x, 0.01);
      CHECK(!near_by.on_side(outside, false));
      CHECK(!near_by.on_side(inside, true));
      const auto side = near_by.on_side(outside, true);
      REQUIRE(side);
      CHECK(side->to[2] == within(0.01, 0.045));
    }
}
