// Gaps to polygons and polylines by hand: edges, corners, inner corners with two faces, sides.
#include "contact/edge_line.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "contact/rigid_motion.hpp"
#include "contact/rigid_surface.hpp"
#include "support/near.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

const GridSpec domain{{-10, -10}, {10, 10}, 1};

RigidSurface surface_of(const RigidShape& shape) {
  return RigidSurface(make_rigid_body({"it", shape, {}, {}}, domain));
}

SurfaceGap gap(const RigidSurface& surface, const Vec<2>& x, std::int8_t side = 0) {
  const auto found = surface.gap(x, side);
  REQUIRE(found);
  return *found;
}

void check_vector(const Vec<2>& value, const Vec<2>& expected) {
  for (int a = 0; a < 2; ++a) CHECK(value[a] == within(expected[a], 1e-14));
}

/// A basin: ground 1 m thick below y = 0, walls 1 m thick with their inner faces at x = 0 and x = 4.
const PolygonShape basin{{{-1, -1}, {5, -1}, {5, 3}, {4, 3}, {4, 0}, {0, 0}, {0, 3}, {-1, 3}}};

}  // namespace

TEST_CASE("The gap to a box: height over its faces, distance to its corners, the nearest way out inside") {
  const RigidSurface box = surface_of(BoxShape{{0, 0}, {4, 2}});
  CHECK(gap(box, {1, 2.5}).size == near(0.5, 1e-12));
  check_vector(gap(box, {1, 2.5}).normal, {0, 1});
  CHECK(gap(box, {-0.25, 1}).size == near(0.25, 1e-12));
  check_vector(gap(box, {-0.25, 1}).normal, {-1, 0});
  CHECK(gap(box, {4.3, 2.4}).size == near(0.5, 1e-12));
  check_vector(gap(box, {4.3, 2.4}).normal, {0.6, 0.8});
  CHECK(gap(box, {1, 1.9}).size == near(-0.1, 1e-12));
  check_vector(gap(box, {1, 1.9}).normal, {0, 1});
  CHECK(gap(box, {3.8, 1}).size == near(-0.2, 1e-12));
  check_vector(gap(box, {3.8, 1}).normal, {1, 0});
  CHECK(box.may_touch({2, 1}, {2, 1}, 0.01));
  CHECK(box.may_touch({4.5, 0}, {5, 1}, 0.51));
  CHECK_FALSE(box.may_touch({4.5, 0.5}, {4.5, 0.5}, 0.49));
}

TEST_CASE("The sense of a polygon's corners does not matter") {
  PolygonShape other = basin;
  std::reverse(other.points.begin(), other.points.end());
  const RigidSurface one = surface_of(basin), two = surface_of(other);
  for (const Vec<2>& x : {Vec<2>(2, 0.3), Vec<2>(0.1, 2), Vec<2>(-0.3, 1), Vec<2>(4.6, 3.4), Vec<2>(0.2, 0.1)}) {
    CHECK(gap(one, x).size == near(gap(two, x).size, 1e-12));
    check_vector(gap(one, x).normal, gap(two, x).normal);
  }
}

TEST_CASE("Behind an inner corner the way out is to the corner") {
  const SurfaceGap behind = gap(surface_of(basin), {-0.3, -0.4});
  CHECK(behind.size == near(-0.5, 1e-12));
  check_vector(behind.normal, {0.6, 0.8});
}

TEST_CASE("In an inner corner at right angles a point touches both faces, each with all of its length") {
  const SurfaceTouch touch = surface_of(basin).touch({0.1, 0.2}, 0, 0.25);
  REQUIRE(touch.count == 2);
  double sum_of_gaps = 0;
  for (const SurfaceGap& face : touch) {
    CHECK(face.share == near(1, 1e-12));
    sum_of_gaps += face.size;
  }
  CHECK(sum_of_gaps == near(0.3, 1e-12));
  CHECK(touch.gaps[0].piece < touch.gaps[1].piece);
  CHECK(surface_of(basin).touch({0.1, 0.3}, 0, 0.25).count == 1);
  CHECK(surface_of(basin).touch({2, 0.3}, 0, 0.25).count == 0);
}

TEST_CASE("Faces that are nearly parallel share a point, and go over into each other evenly") {
  const double tilt = 0.1, s = std::sin(tilt), c = std::cos(tilt);  // a trough of two faces, each 0.1 rad steep
  const RigidSurface trough = surface_of(PolylineShape{{{-2 * c, 2 * s}, {0, 0}, {2 * c, 2 * s}}, 0.1});
  const SurfaceTouch middle = trough.touch({0, 0.2}, 0, 0.2);
  REQUIRE(middle.count == 2);
  const double cosine = std::cos(2 * tilt);
  for (const SurfaceGap& face : middle) CHECK(face.share == near(1 / (1 + cosine), 1e-9));
  // Off the middle the shares follow l1 + c l2 = d1, c l1 + l2 = d2.
  const SurfaceTouch off = trough.touch({0.01, 0.2}, 0, 0.2);
  REQUIRE(off.count == 2);
  const double d0 = 0.2 - off.gaps[0].size, d1 = 0.2 - off.gaps[1].size;
  const double l0 = off.gaps[0].share * d0, l1 = off.gaps[1].share * d1;
  CHECK(l0 + cosine * l1 == near(d0, 1e-9));
  CHECK(cosine * l0 + l1 == near(d1, 1e-9));
}

TEST_CASE("A polyline has a half thickness and two sides, and what has passed through is lost") {
  const RigidSurface line = surface_of(PolylineShape{{{0, 0}, {4, 0}, {4, 3}}, 0.25});
  CHECK(gap(line, {2, 1}).size == near(0.75, 1e-12));
  CHECK(gap(line, {2, 1}).side == 1);
  CHECK(gap(line, {2, -1}).size == near(0.75, 1e-12));
  CHECK(gap(line, {2, -1}).side == -1);
  CHECK(gap(line, {2, -0.2}, 1).size == near(-0.45, 1e-12));
  check_vector(gap(line, {2, -0.2}, 1).normal, {0, 1});
  CHECK_FALSE(line.gap({2, -0.26}, 1));
  CHECK(gap(line, {-0.6, 0.8}).size == near(0.75, 1e-12));  // beyond its end
  check_vector(gap(line, {-0.6, 0.8}).normal, {-0.6, 0.8});
  CHECK(gap(line, {4.3, -0.4}).size == near(0.25, 1e-12));  // at its outer corner
  check_vector(gap(line, {4.3, -0.4}).normal, {0.6, -0.8});
  CHECK(gap(line, {4.3, -0.4}).side == -1);
  CHECK(line.touch({3.7, 0.4}, 0, 0.2).count == 2);  // both flanks of the inner corner
}

TEST_CASE("Outlines: corners of a polygon, a polyline with its thickness") {
  const auto square = outline(make_rigid_body({"it", BoxShape{{0, 0}, {1, 1}}, {}, {}}, domain));
  CHECK(square.size() == 4);
  const auto band = outline(make_rigid_body({"it", PolylineShape{{{0, 0}, {2, 0}, {2, 2}}, 0.5}, {}, {}}, domain));
  REQUIRE(band.size() == 6);
  check_vector(band[0], {-0.5, 0.5});
  check_vector(band[1], {1.5, 0.5});
  check_vector(band[2], {1.5, 2.5});
  check_vector(band[3], {2.5, 2.5});
  check_vector(band[4], {2.5, -0.5});
  check_vector(band[5], {-0.5, -0.5});
}

TEST_CASE("A polygon turns about its hinge, and its fastest corner counts for the time step") {
  const RigidSpec spec{"it", BoxShape{{0, 0}, {3, 4}}, HingeMotionSpec{{0, 0}, 0.5, 90}, {}};
  State<2> state;
  state.rigid = {make_rigid_body(spec, domain)};
  for (int k = 0; k < 10; ++k) move_rigid_bodies({spec}, 0.1, state);
  const RigidSurface turned(state.rigid[0]);
  CHECK(turned.speed() == near(2.5, 1e-12));
  const Vec<2> face(3 * std::cos(0.5) - 1 * std::sin(0.5), 3 * std::sin(0.5) + 1 * std::cos(0.5));
  const Vec<2> out(std::cos(0.5), std::sin(0.5));
  CHECK(gap(turned, face + 0.2 * out).size == near(0.2, 1e-12));
  check_vector(gap(turned, face + 0.2 * out).normal, out);
}
