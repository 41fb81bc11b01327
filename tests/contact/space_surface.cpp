// Gaps, velocities and motions of rigid boxes and prisms in space, by hand.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "contact/rigid_motion.hpp"
#include "contact/space_surface.hpp"
#include "support/near.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

RigidSpec spec_of(RigidShape shape, RigidMotion motion = {}) {
  RigidSpec spec;
  spec.name = "thing";
  spec.shape = std::move(shape);
  spec.motion = std::move(motion);
  return spec;
}

/// 0 < x < 4, a right angle at the origin, its hypotenuse from (y, z) = (3, 0) to (0, 4).
const PrismShape wedge{{{0, 0, 0}, {0, 3, 0}, {0, 0, 4}}, 4};

State<3> one_body(const RigidSpec& spec) {
  State<3> state;
  state.rigid.push_back(make_rigid_body(spec));
  return state;
}

}  // namespace

TEST_CASE("A point in a box or prism is behind its nearest face") {
  const SpaceSurface prism(make_rigid_body(spec_of(wedge)));
  // 0.1 m below the middle of the hypotenuse, whose normal is (4, 3) / 5.
  const Vec<3> slope(0, 0.8, 0.6);
  const auto on = prism.depth(Vec<3>(2, 1.5, 2) - 0.1 * slope);
  REQUIRE(on);
  CHECK(on->size == near(0.1, 1e-12));
  CHECK((on->normal - slope).norm() < 1e-12);
  CHECK_FALSE(prism.depth(Vec<3>(2, 1.5, 2) + 0.1 * slope));
  // The same, but nearer to the faces across x.
  for (const double side : {-1.0, 1.0}) {
    const auto end = prism.depth(Vec<3>(2 + side * 1.95, 1.5, 2) - Vec<3>(0.1 * slope));
    REQUIRE(end);
    CHECK(end->size == near(0.05, 1e-12));
    CHECK((end->normal - Vec<3>(side, 0, 0)).norm() < 1e-12);
    CHECK_FALSE(prism.depth(Vec<3>(2 + side * 2.05, 1.5, 2) - Vec<3>(0.1 * slope)));
  }
  const SpaceSurface box(make_rigid_body(spec_of(BoxShape{{1, 1, 1}, {3, 4, 5}})));
  CHECK((box.depth({2, 2, 4.9})->normal - Vec<3>(0, 0, 1)).norm() < 1e-12);
  CHECK((box.depth({2, 3.9, 3})->normal - Vec<3>(0, 1, 0)).norm() < 1e-12);
  CHECK((box.depth({1.1, 2, 3})->normal - Vec<3>(-1, 0, 0)).norm() < 1e-12);
  CHECK(box.depth({2, 2, 4.9})->size == near(0.1, 1e-12));
  CHECK_FALSE(box.depth({2, 2, 5.1}));
}

TEST_CASE("The sense in which a prism's corners run does not matter") {
  PrismShape other = wedge;
  std::reverse(other.points.begin(), other.points.end());
  const Vec<3> x(2, 1.4, 1.9);
  const auto a = SpaceSurface(make_rigid_body(spec_of(wedge))).depth(x);
  const auto b = SpaceSurface(make_rigid_body(spec_of(other))).depth(x);
  REQUIRE(a);
  REQUIRE(b);
  CHECK(a->size == near(b->size, 1e-12));
}

TEST_CASE("A prism turns from y to z about the axis along x through the centre of its hinge") {
  const RigidSpec spec = spec_of(wedge, HingeMotionSpec{{7, 3, 0}, std::numbers::pi / 2, 90});
  State<3> state = one_body(spec);
  move_rigid_bodies({spec}, 1.0, state);
  // A quarter turn about (y, z) = (3, 0): the origin comes to (3, -3), the corner (0, 4) to (-1, -3).
  const std::vector<Vec<3>> at = corners(state.rigid[0]);
  REQUIRE(at.size() == 6);
  const auto has = [&](const Vec<3>& x) {
    return std::any_of(at.begin(), at.end(), [&](const Vec<3>& corner) { return (corner - x).norm() < 1e-12; });
  };
  for (const double x : {0.0, 4.0}) {
    CHECK(has({x, 3, -3}));
    CHECK(has({x, 3, 0}));
    CHECK(has({x, -1, -3}));
  }
  const SpaceSurface surface(state.rigid[0]);
  CHECK((surface.velocity({1, 3, -3}) - std::numbers::pi / 2 * Vec<3>(0, 3, 0)).norm() < 1e-12);
  CHECK(surface.speed() == near(std::numbers::pi / 2 * 5, 1e-12));  // of the corner that is farthest from the hinge
  move_rigid_bodies({spec}, 1.0, state);                            // it has come to its stop
  CHECK(SpaceSurface(state.rigid[0]).speed() == near_zero(1e-12));
}

TEST_CASE("A box and a half-space in space move along") {
  const RigidSpec box = spec_of(BoxShape{{0, 0, 0}, {1, 1, 1}}, TranslationMotionSpec{{3, 0, -4}});
  const RigidSpec half =
      spec_of(HalfPlaneShape{{0, 0, 0}, {0, 0, 2}}, TableMotionSpec{{0, 2}, {}, {}, {{0, 0, 0}, {0, 0, 1}}});
  for (const RigidSpec& spec : {box, half}) {
    State<3> state = one_body(spec);
    move_rigid_bodies({spec}, 0.5, state);
    const SpaceSurface surface(state.rigid[0]);
    const bool is_box = std::holds_alternative<BoxShape>(spec.shape);
    CHECK(surface.speed() == near(is_box ? 5.0 : 0.5, 1e-12));
    const Vec<3> x = is_box ? Vec<3>(2, 0.5, -1.01) : Vec<3>(8, 9, 0.25 - 1e-3);
    const auto touch = surface.depth(x);
    REQUIRE(touch);
    CHECK((touch->normal - Vec<3>(0, 0, 1)).norm() < 1e-12);
    CHECK(touch->size == near(is_box ? 0.01 : 1e-3, 1e-9));
  }
}
