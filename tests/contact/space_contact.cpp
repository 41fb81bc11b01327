// Nodes of a membrane in space on rigid bodies: one triangle against the penalty law by hand.
#include <doctest/doctest.h>

#include <cmath>

#include "contact/space_contact.hpp"
#include "contact/space_surface.hpp"
#include "support/near.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

/// A triangle of 3 m2 at rest whose node 0 is at x, inside a rigid body; the others are outside.
struct OnBody {
  State<3> state;

  OnBody(RigidSpec spec, const Vec<3>& x, const Vec<3>& velocity, double friction = 0.5, double damping = 0) {
    spec.name = "ground";
    state.rigid.push_back(make_rigid_body(spec));
    Membrane<3> cloth;
    cloth.name = "cloth";
    for (int a = 0; a < 3; ++a) {
      cloth.x[a] = {x[a], x[a] + 10, x[a] + 20};
      cloth.v[a] = {velocity[a], 0, 0};
      cloth.load[a].assign(3, 0.0);
    }
    cloth.mass.assign(3, 1.0);
    for (std::uint32_t k = 0; k < 3; ++k) cloth.triangles.corner[k] = {k};
    cloth.triangles.rest_area = {3};
    state.membranes.push_back(cloth);
    RigidContact<3> contact;
    contact.touching = "cloth";
    contact.rigid = "ground";
    contact.friction = friction;
    contact.stiffness = 1e5;
    contact.damping = damping;
    state.rigid_contacts.push_back(contact);
  }
  Vec<3> push(double dt) {
    for (auto& component : state.membranes[0].load) component.assign(3, 0.0);
    add_space_contacts(state, dt);
    return vector_at(state.membranes[0].load, 0);
  }
};

RigidSpec spec_of(RigidShape shape) {
  RigidSpec spec;
  spec.shape = std::move(shape);
  return spec;
}

/// 0.01 m deep in a slope of 3 : 4.
struct Incline : OnBody {
  Vec<3> normal{0.6, 0.0, 0.8};

  Incline(double friction, const Vec<3>& velocity)
      : OnBody(spec_of(HalfPlaneShape{{1, 2, 3}, {3, 0, 4}}), Vec<3>(1, 2, 3) - 0.01 * Vec<3>(0.6, 0.0, 0.8), velocity,
               friction, 100) {}
};

}  // namespace

TEST_CASE("A node in a half-space is pushed out by stiffness, damping and the area of its cloth") {
  // 1 m2: 1e5 * 0.01 - 100 * (-2) = 1200 N; on its way out 100 N less for each m/s, never a pull.
  CHECK((Incline(0, Vec<3>(0.6, 0, 0.8) * -2).push(1e-3) - 1200 * Vec<3>(0.6, 0, 0.8)).norm() < 1e-9);
  CHECK((Incline(0, Vec<3>(0.6, 0, 0.8) * 4).push(1e-3) - 600 * Vec<3>(0.6, 0, 0.8)).norm() < 1e-9);
  CHECK(Incline(0, Vec<3>(0.6, 0, 0.8) * 40).push(1e-3).norm() < 1e-9);
  Incline slope(0.3, Vec<3>::Zero());
  slope.push(1e-3);
  CHECK(slope.state.rigid_contacts[0].points == Array<std::uint32_t>{0});
  CHECK(vector_at(slope.state.membranes[0].load, 1).norm() == 0);
}

TEST_CASE("Friction is a spring against the way along the surface, in any direction, up to mu times the normal force") {
  const Vec<3> velocity = 3 * Vec<3>(0.8, 0, -0.6) + 4 * Vec<3>(0, 1, 0);  // 5 m/s along the slope
  Incline slope(0.5, velocity);
  // 1 ms: 5 mm, 500 N, at the limit of 0.5 * 1000 N; half of that after half the way.
  CHECK((slope.push(0.5e-3) - 1000 * slope.normal + 250 * velocity / 5).norm() < 1e-9);
  CHECK((slope.push(0.5e-3) - 1000 * slope.normal + 500 * velocity / 5).norm() < 1e-9);
  CHECK(slope.state.rigid_contacts[0].friction_work == near_zero(1e-9));
  CHECK((slope.push(1e-3) - 1000 * slope.normal + 500 * velocity / 5).norm() < 1e-9);  // slips 5 mm
  CHECK(slope.state.rigid_contacts[0].friction_work == near(500 * 5e-3, 1e-9));
  CHECK(slope.state.rigid_contacts[0].normal_sum == near(1000.0, 1e-12));
  CHECK(slope.state.rigid_contacts[0].friction_sum == near(500.0, 1e-12));
}

TEST_CASE("A wall in space that moves takes a node along, and its work is counted") {
  OnBody on(spec_of(BoxShape{{0, 0, 0}, {5, 5, 1}}), {2, 2, 0.99}, {0, 3, 0});
  on.state.rigid[0].velocity = {0, 3, 0};
  // 1e5 Pa/m, 1 m2, 0.01 m: 1000 N up; no way along the wall, no friction.
  CHECK((on.push(1e-3) - Vec<3>(0, 0, 1000)).norm() < 1e-9);
  CHECK(on.state.rigid_contacts[0].driving_work == near_zero(1e-12));
  on.state.rigid[0].velocity = {0, 5, 0};
  // The wall is 2 m/s faster: 1 ms, 2 mm, 200 N along, 1 J of the wall at 5 m/s.
  CHECK((on.push(1e-3) - Vec<3>(0, 200, 1000)).norm() < 1e-9);
  CHECK(on.state.rigid_contacts[0].driving_work == near(1.0, 1e-12));
}

TEST_CASE("A node that comes from one face of a prism to the next keeps its spring, along the new face") {
  const RigidSpec roof = spec_of(PrismShape{{{0, -3, -3}, {0, 3, -3}, {0, 0, 0}}, 10});
  const double slope = std::sqrt(0.5);
  const Vec<3> left(0, -slope, slope), right(0, slope, slope);
  OnBody on(roof, Vec<3>(5, 0, -1) + Vec<3>(0, -1, 0) - 0.02 * left, Vec<3>(2, 0, 0) + right);
  // 2000 N out of the left face; 2 mm along x and 1 mm up the slope, 1e5 N/m.
  CHECK((on.push(1e-3) - 2000 * left + 100 * (Vec<3>(2, 0, 0) + right)).norm() < 1e-6);
  const Vec<3> there = Vec<3>(5, 1, -1) - 0.02 * right;
  for (int a = 0; a < 3; ++a) on.state.membranes[0].x[a][0] = there[a];
  for (int a = 0; a < 3; ++a) on.state.membranes[0].v[a][0] = 0;
  CHECK((on.push(1e-3) - 2000 * right + 100 * Vec<3>(2, 0, 0)).norm() < 1e-6);
}
