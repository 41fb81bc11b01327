// The law of contact at single points, by hand: damping, moving surfaces, rounded ends, what it remembers, what it adds
// up.
#include <doctest/doctest.h>

#include <cmath>

#include "contact/surface_contact.hpp"
#include "support/near.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double dt = 0.01, stiffness = 2e5, length = 0.25;
const GridSpec domain{{-10, -10}, {10, 10}, 1};

RigidContact<2> make_contact(double friction, double damping = 0) {
  RigidContact<2> contact;
  contact.friction = friction;
  contact.stiffness = stiffness;
  contact.damping = damping;
  return contact;
}

RigidBody<2> ground() { return make_rigid_body({"ground", HalfPlaneShape{{0, 0}, {0, 1}}, {}, {}}, domain); }

ContactPoint point(const Vec<2>& x, const Vec<2>& v, std::uint32_t id = 0) { return {id, x, v, length, 0}; }

}  // namespace

TEST_CASE("Damping adds z l v while a point comes, takes as much while it goes, and never pulls") {
  constexpr double z = 1e3, depth = 1e-3;
  const auto push = [&](double v) {
    RigidContact<2> contact = make_contact(0, z);
    return contact_forces(RigidSurface(ground()), {point({0, -depth}, {0, v})}, dt, contact)[0].force[1];
  };
  CHECK(push(0) == near(stiffness * length * depth, 1e-12));
  CHECK(push(-0.1) == near(length * (stiffness * depth + z * 0.1), 1e-12));
  CHECK(push(0.1) == near(length * (stiffness * depth - z * 0.1), 1e-12));
  CHECK(push(0.21) == 0);
  RigidContact<2> contact = make_contact(0, z);
  contact_forces(RigidSurface(ground()), {point({0, 1e-9}, {0, -1})}, dt, contact);
  CHECK(contact.normal_sum == 0);  // not before the surfaces touch
}

TEST_CASE("Work of friction is the slip times the limit; work of damping z l v^2 dt") {
  RigidContact<2> contact = make_contact(0.5, 1e3);
  const RigidSurface surface(ground());
  const double limit = 0.5 * stiffness * length * 1e-3;  // reached at 0.5 mm of slip
  for (int step = 0; step < 10; ++step) contact_forces(surface, {point({0, -1e-3}, {0.01, 0})}, dt, contact);
  CHECK(contact.friction_work == near(limit * (10 * 0.1e-3 - 0.5e-3), 1e-9));
  CHECK(contact.friction_sum == near(-limit, 1e-12));
  CHECK(contact.damping_work == 0);
  contact_forces(surface, {point({0, -1e-3}, {0, -0.1})}, dt, contact);
  CHECK(contact.damping_work == near(1e3 * length * 0.01 * dt, 1e-9));
}

TEST_CASE("Friction is mu times the part of the normal force that rubs, where that is the lesser") {
  constexpr double depth = 1e-3, mu = 0.5;
  for (const double share : {0.25, 2.0}) {
    CAPTURE(share);
    RigidContact<2> contact = make_contact(mu, 0);
    ContactPoint wet = point({0, -depth}, {1, 0});
    wet.rubbing = share * stiffness * depth;
    contact_forces(RigidSurface(ground()), {wet}, dt, contact);
    CHECK(contact.normal_sum == near(stiffness * length * depth, 1e-12));
    CHECK(contact.friction_sum == near(-mu * std::min(share, 1.0) * stiffness * length * depth, 1e-12));
  }
}

TEST_CASE("A surface that moves drags what rests on it") {
  RigidBody<2> belt = ground();
  belt.velocity = {0.02, 0};
  RigidContact<2> contact = make_contact(10);
  const auto force = contact_forces(RigidSurface(belt), {point({0, -1e-3}, {0, 0})}, dt, contact)[0].force;
  CHECK(force[0] == near(stiffness * length * 0.02 * dt, 1e-12));
  CHECK(contact.friction_force[0] == near(force[0], 1e-12));
  CHECK(contact.normal_force[1] == near(force[1], 1e-12));
  // With the belt nothing slips.
  RigidContact<2> riding = make_contact(10);
  CHECK(contact_forces(RigidSurface(belt), {point({0, -1e-3}, {0.02, 0})}, dt, riding)[0].force[0] == 0);
  // One that comes up presses harder with damping only.
  belt.velocity = {0, 0.1};
  RigidContact<2> damped = make_contact(0, 1e3);
  CHECK(contact_forces(RigidSurface(belt), {point({0, -1e-3}, {0, 0})}, dt, damped)[0].force[1] ==
        near(length * (stiffness * 1e-3 + 1e3 * 0.1), 1e-12));
}

TEST_CASE("A spring turns with the surface round a rounded end") {
  const RigidSurface disc(make_rigid_body({"disc", CapsuleShape{{0, 0}, {0, 0}, 1}, {}, {}}, domain));
  RigidContact<2> contact = make_contact(10);
  const double in = 1 - 1e-3;
  contact_forces(disc, {point({0, in}, {0.05, 0})}, dt, contact);  // on top, clockwise
  const double drag = stiffness * length * 0.05 * dt;
  const auto right = contact_forces(disc, {point({in, 0}, {0, 0})}, dt, contact)[0].force;
  CHECK(right[0] == near(stiffness * length * 1e-3, 1e-9));
  CHECK(right[1] == near(drag, 1e-9));
}

TEST_CASE("Each point has its own spring, whoever else touches; who lets go forgets its spring") {
  RigidContact<2> contact = make_contact(10);
  const RigidSurface surface(ground());
  const Vec<2> deep(0, -1e-3), out(0, 1e-3), slow(0.01, 0), fast(0.03, 0), still(0, 0);
  contact_forces(surface, {point(deep, slow, 2), point(out, fast, 5), point(deep, fast, 9)}, dt, contact);
  CHECK(contact.points == Array<std::uint32_t>{2, 9});
  const auto next =
      contact_forces(surface, {point(deep, still, 1), point(out, still, 2), point(deep, still, 9)}, dt, contact);
  CHECK(next[0].force[0] == 0);
  CHECK(next[1].force == Vec<2>(0, 0));
  CHECK(next[2].force[0] == near(-stiffness * length * 0.03 * dt, 1e-12));
  const auto last = contact_forces(surface, {point(deep, still, 2)}, dt, contact);
  CHECK(last[0].force[0] == 0);
}

TEST_CASE("A point that came from the left of a thin wall is pushed back to the left") {
  const RigidSurface wall(make_rigid_body({"wall", CapsuleShape{{0, -5}, {0, 5}, 0.1}, {}, {}}, domain));
  for (const double side : {-1.0, 1.0}) {
    RigidContact<2> contact = make_contact(0);
    for (const double x : {0.09, 0.01, -0.05, -0.09}) {  // through the middle, towards the other side
      const auto force = contact_forces(wall, {point({side * x, 0}, {0, 0})}, dt, contact)[0].force;
      CHECK(force[0] == near(side * stiffness * length * (0.1 - x), 1e-9));
    }
    contact_forces(wall, {point({-side * 0.11, 0}, {0, 0})}, dt, contact);
    CHECK(contact.points.empty());  // through: no force throws it out on the other side
  }
}
