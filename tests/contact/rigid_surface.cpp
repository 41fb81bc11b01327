// Gaps to capsules and half-planes by hand, and surfaces that move.
#include "contact/rigid_surface.hpp"
#include "contact/rigid_motion.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "support/near.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

const GridSpec domain{{-10, -10}, {10, 10}, 1};

RigidBody<2> capsule(const Point& from, const Point& to, double radius, const RigidMotion& motion = {}) {
  return make_rigid_body({"it", CapsuleShape{from, to, radius}, motion, {}}, domain);
}

RigidSurface::Gap gap(const RigidSurface& surface, const Vec<2>& x, std::int8_t side = 0) {
  const auto found = surface.gap(x, side);
  REQUIRE(found);
  return *found;
}

void check_vector(const Vec<2>& value, const Vec<2>& expected) {
  for (int a = 0; a < 2; ++a) CHECK(value[a] == within(expected[a], 1e-14));  // of 10 m
}

/// One body that has moved for `steps` of `dt` by its motion.
State<2> after(const RigidSpec& spec, double dt, int steps) {
  State<2> state;
  state.rigid = {make_rigid_body(spec, domain)};
  for (int k = 0; k < steps; ++k) move_rigid_bodies(std::vector{spec}, dt, state);
  return state;
}

}  // namespace

TEST_CASE("Beside a capsule's segment the gap is the height over it, on either side") {
  const RigidSurface wall(capsule({0, 0}, {4, 3}, 0.5));  // 5 m long, left of it is (-3, 4)/5
  for (const int side : {1, -1}) {
    const Vec<2> normal = side * Vec<2>(-0.6, 0.8), middle(2, 1.5);
    const RigidSurface::Gap over = gap(wall, middle + 0.7 * normal);
    CHECK(over.size == near(0.2, 1e-12));
    CHECK(over.side == side);
    check_vector(over.normal, normal);
    CHECK(gap(wall, middle + 0.2 * normal).size == near(-0.3, 1e-12));
  }
}

TEST_CASE("A point keeps its side of a capsule down to twice the radius, and is lost beyond") {
  const RigidSurface wall(capsule({0, 0}, {4, 0}, 0.5));
  const RigidSurface::Gap below = gap(wall, {2, -0.4}, 1);  // came from above
  CHECK(below.size == near(-0.9, 1e-12));
  CHECK(below.side == 1);
  check_vector(below.normal, {0, 1});
  CHECK_FALSE(wall.gap({2, -0.51}, 1));
  CHECK(gap(wall, {2, -0.4}, -1).size == near(-0.1, 1e-12));
}

TEST_CASE("Beyond the ends of a capsule the gap is radial; it goes on evenly from side to end") {
  const RigidSurface wall(capsule({0, 0}, {4, 0}, 0.5));
  const RigidSurface::Gap right = gap(wall, {4.3, -0.4});
  CHECK(right.size == near_zero(1e-15));
  check_vector(right.normal, {0.6, -0.8});
  CHECK(right.side == 0);
  CHECK(gap(wall, {-0.6, 0.8}).size == near(0.5, 1e-12));
  for (const double x : {-1e-9, 1e-9, 4 - 1e-9, 4 + 1e-9}) {
    CHECK(gap(wall, {x, 0.3}).size == near(-0.2, 1e-9));
    check_vector(gap(wall, {x, 0.3}).normal.array().round(), {0, 1});
  }
}

TEST_CASE("A capsule without length is a disc") {
  const RigidSurface disc(capsule({1, 1}, {1, 1}, 2));
  CHECK(gap(disc, {4, 5}).size == near(3, 1e-12));
  check_vector(gap(disc, {4, 5}).normal, {0.6, 0.8});
  CHECK_FALSE(disc.gap({1, 1}, 0));  // its centre has no direction
}

TEST_CASE("Of a half-plane's boundary the part in the domain is kept") {
  const RigidBody<2> slope = make_rigid_body({"it", HalfPlaneShape{{2, 8}, {-3, 4}}, {}, {}}, domain);
  CHECK(slope.normal[0] == near(-0.6, 1e-15));
  CHECK(gap(RigidSurface(slope), {0, 0}).size == near(1.2 - 6.4, 1e-12));
  const std::vector<Vec<2>> ends = outline(slope);
  REQUIRE(ends.size() == 2);
  check_vector(ends[0], {2 + 2 * 4 / 3.0, 10});
  check_vector(ends[1], {-10, -1});
}

TEST_CASE("A hinge turns its capsule about the centre, at its rate, up to the stop") {
  constexpr double degree = std::numbers::pi / 180;
  const RigidSpec spec{"it", CapsuleShape{{3, 0}, {3, 2}, 0.5}, HingeMotionSpec{{1, 0}, -0.5, 90}, {}};
  const State<2> half = after(spec, 0.1, 10);
  CHECK(half.rigid[0].angle == near(-0.5, 1e-12));
  CHECK(half.rigid[0].angle_rate == near(-0.5, 1e-12));
  check_vector(RigidSurface(half.rigid[0]).velocity({1, 4}), {2, 0});  // omega x r
  CHECK(RigidSurface(half.rigid[0]).speed() == near(0.5 * (std::sqrt(8) + 0.5), 1e-12));
  const State<2> stopped = after(spec, 0.1, 100);
  CHECK(stopped.rigid[0].angle == near(-90 * degree, 1e-12));
  CHECK(stopped.rigid[0].angle_rate == 0);
  const RigidSurface surface(stopped.rigid[0]);  // now from (1, -2) to (3, -2)
  CHECK(gap(surface, {2, 0}).size == near(1.5, 1e-12));
  CHECK(gap(surface, {2, 0}).side == 1);
}

TEST_CASE("A table of angles turns, a table of displacements shifts, both at rest outside of their times") {
  const RigidSpec wheel{
      "it", CapsuleShape{{2, 0}, {2, 0}, 1}, TableMotionSpec{{1, 2, 4}, {0, 0}, {0, 90, 180}, {}}, {}};
  CHECK(after(wheel, 0.25, 3).rigid[0].angle == 0);
  CHECK(after(wheel, 0.25, 6).rigid[0].angle == near(std::numbers::pi / 4, 1e-12));
  CHECK(after(wheel, 0.25, 12).rigid[0].angle_rate == near(std::numbers::pi / 4, 1e-12));
  CHECK(gap(RigidSurface(after(wheel, 0.25, 40).rigid[0]), {-5, 0}).size == near(2, 1e-12));
  const RigidSpec lift{"it", CapsuleShape{{2, 0}, {2, 0}, 1}, TableMotionSpec{{0, 2}, {}, {}, {{0, 0}, {-4, 2}}}, {}};
  const State<2> midway = after(lift, 0.25, 4);
  check_vector(RigidSurface(midway.rigid[0]).velocity({9, 9}), {-2, 1});
  CHECK(gap(RigidSurface(midway.rigid[0]), {0, 3}).size == near(1, 1e-12));
}

TEST_CASE("A body whose motion is held stays where it is, and has no rates") {
  const RigidSpec spec{"it", CapsuleShape{{0, 0}, {0, 0}, 1}, TranslationMotionSpec{{0, -2}}, {}};
  State<2> state = after(spec, 0.5, 2);
  CHECK(state.rigid[0].velocity[1] == near(-2, 1e-12));
  state.rigid[0].moving = false;
  move_rigid_bodies(std::vector{spec}, 0.5, state);
  CHECK(state.rigid[0].displacement[1] == near(-2, 1e-12));
  CHECK(state.rigid[0].velocity[1] == 0);
  state.rigid[0].moving = true;
  move_rigid_bodies(std::vector{spec}, 0.5, state);
  CHECK(state.rigid[0].displacement[1] == near(-3, 1e-12));
}

TEST_CASE("A box that may touch is never left out, and one far away is") {
  const RigidSurface wall(capsule({0, 0}, {4, 3}, 0.5));
  const RigidSurface slope(make_rigid_body({"it", HalfPlaneShape{{0, 0}, {-3, 4}}, {}, {}}, domain));
  for (const RigidSurface* surface : {&wall, &slope})
    for (int i = -20; i <= 20; ++i)
      for (int j = -20; j <= 20; ++j) {
        const Vec<2> lower(0.4 * i, 0.4 * j), upper = lower + Vec<2>(0.7, 0.3);
        bool touches = false;
        for (const double s : {0.0, 0.5, 1.0})
          for (const double t : {0.0, 0.5, 1.0}) {
            const auto found = surface->gap({lower[0] + 0.7 * s, lower[1] + 0.3 * t}, 0);
            touches = touches || !found || found->size < 0.1;
          }
        if (touches) CHECK(surface->may_touch(lower, upper, 0.1));
      }
  CHECK_FALSE(wall.may_touch({4, 4}, {5, 5}, 0.1));
  CHECK_FALSE(slope.may_touch({-2, 0}, {-1, 1}, 0.1));
}

TEST_CASE("The outline of a capsule lies on its surface and encloses it") {
  const std::vector<Vec<2>> corners = outline(capsule({0, 0}, {4, 3}, 0.5));
  const RigidSurface wall(capsule({0, 0}, {4, 3}, 0.5));
  double twice = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    CHECK(std::abs(gap(wall, corners[k]).size) < 1e-12);
    const Vec<2>& next = corners[(k + 1) % corners.size()];
    twice += corners[k][0] * next[1] - next[0] * corners[k][1];
  }
  CHECK(twice / 2 == near(5 + std::numbers::pi / 4, 0.002));  // the chords are a little inside
}
