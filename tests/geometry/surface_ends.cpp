// Surfaces that end at planes: parts of a ball, slices of a tube.
#include "geometry/surface_ends.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/corner.hpp"
#include "geometry/surface_generators.hpp"
#include "support/near.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

double shortest_edge(const TriangleSurface& surface) {
  double least = 1e9;
  for (const auto& triangle : surface.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Corner d = difference(surface.points[triangle[k]], surface.points[triangle[(k + 1) % 3]]);
      least = std::min(least, std::sqrt(dot(d, d)));
    }
  return least;
}

TriangleSurface cut_at_all(TriangleSurface surface, const std::vector<SurfaceEnd>& ends, double snap) {
  for (const SurfaceEnd& end : ends) surface = cut_off(std::move(surface), end, snap);
  return surface;
}

/// A square with corners between the ends of its sides.
const std::vector<Point> square{{1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}};

}  // namespace

TEST_CASE("A half of a ball has half of its cloth and, closed by a fan, half of its volume; so has a quarter") {
  // The icosahedron is symmetric about all three planes.
  const TriangleSurface ball = ellipsoid_surface({0, 0, 0}, {1, 0.8, 1.2}, 0.15);
  for (const std::vector<SurfaceEnd>& ends :
       {std::vector<SurfaceEnd>{{0, false, 0}}, {{1, true, 0}}, {{2, false, 0}}, {{0, true, 0}, {1, false, 0}}}) {
    const TriangleSurface part = cut_at_all(ball, ends, 0);
    const double share = std::pow(0.5, static_cast<double>(ends.size()));
    CHECK(area(part) == near(share * area(ball), 1e-12));
    CHECK(volume(with_fans(part, ends)) == near(share * volume(ball), 1e-12));
    for (const SurfaceEnd& end : ends) {
      CHECK(open_edges(part, end).size() > 10);
      for (const Corner& x : part.points) {
        const double way = x[static_cast<std::size_t>(end.axis)];
        CHECK((end.upper ? -way : way) >= 0);
      }
    }
  }
}

TEST_CASE("What is inside a half of a ball is what is inside the ball on that side") {
  const TriangleSurface ball = ellipsoid_surface({0.1, 0.2, 0.3}, {1, 0.8, 1.2}, 0.15);
  const std::vector<SurfaceEnd> ends{{1, false, 0.05}};
  const SurfaceRegion whole(ball), part(with_fans(cut_at_all(ball, ends, 0), ends));
  int inside = 0;
  for (double x = -1; x < 1.2; x += 0.17)
    for (double y = -0.9; y < 1.2; y += 0.13)
      for (double z = -0.9; z < 1.6; z += 0.19) {
        const bool expected = y > 0.05 && whole.contains({x, y, z});
        CHECK(part.contains({x, y, z}) == expected);
        inside += expected ? 1 : 0;
      }
  CHECK(inside > 200);
}

TEST_CASE("Points near the plane are moved onto it: no edge is left short, and little of the volume changes") {
  const TriangleSurface ball = ellipsoid_surface({0.0, 0.013, 0.0}, {1, 1, 1}, 0.1);
  const SurfaceEnd end{1, false, 0};
  const TriangleSurface cut = cut_off(ball, end, 0), snapped = cut_off(ball, end, 0.03);
  CHECK(shortest_edge(cut) < 0.02);
  CHECK(shortest_edge(snapped) > 0.028);
  CHECK(volume(with_fans(snapped, {end})) == near(volume(with_fans(cut, {end})), 1e-3));
}

TEST_CASE("A tube is closed by flat ends, which fall away where it ends in their planes") {
  const TriangleSurface tube = tube_surface({0, 3, 0.5}, {0, 1, 0.5}, square, 0.5);
  CHECK(fault_of(tube).empty());
  const std::vector<SurfaceEnd> ends{{1, false, 1}, {1, true, 3}};
  const TriangleSurface open = cut_at_all(tube, ends, 0.1);
  CHECK(open.points.size() + 2 == tube.points.size());
  CHECK(volume(with_fans(open, ends)) == near(volume(tube), 1e-14));
  // Rings of the square's corners and of the middles of its sides, in turn: what lies between is less than the square.
  CHECK(volume(tube) < 2 * 4);
  CHECK(volume(tube) > 2 * 2);
  CHECK(open_edges(open, ends[0]).size() == 4);
  // Its section: level axis first, as seen from `to`, which is in front.
  CHECK(tube.points[1] == Corner{1, 3, 1.5});
}

TEST_CASE("Cloth that was cut out flat is cut where it lies on the plane") {
  const TriangleSurface pillow = pillow_surface({0, 0, 0}, 2, 1, 0.3, 0.1);
  const TriangleSurface half = cut_off(pillow, {0, false, 0}, 0.03);
  REQUIRE(half.unstretched.size() == half.points.size());
  const TriangleSurface flat{half.unstretched, half.triangles, {}};
  CHECK(area(flat) == near(2.0, 1e-12));
}
