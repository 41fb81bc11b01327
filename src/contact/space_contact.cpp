#include "space_contact.hpp"

#include <geodrop/base/find_named.hpp>
#include <geodrop/grid/graded_axis.hpp>

#include <algorithm>
#include <cmath>

#include "node_area.hpp"
#include "penalty.hpp"
#include "space_surface.hpp"

namespace geodrop {
namespace {

/// Springs of the points of the step before, by node.
class Springs {
 public:
  explicit Springs(const RigidContact<3>& contact) : points_(contact.points), slip_(contact.slip) {}
  Vec<3> of(std::uint32_t node) {
    while (next_ < points_.size() && points_[next_] < node) ++next_;
    if (next_ == points_.size() || points_[next_] != node) return Vec<3>::Zero();
    return Vec<3>(&slip_[3 * next_]);
  }

 private:
  Array<std::uint32_t> points_;
  Array<double> slip_;
  std::size_t next_ = 0;
};

/// A node inside a rigid body; velocity over its surface.
struct Touch {
  double area;
  SpaceDepth depth;
  Vec<3> velocity, spring;
};

Vec<3> push(const Touch& touch, std::uint32_t node, double dt, RigidContact<3>& contact) {
  const Vec<3>& out = touch.depth.normal;
  const SpacePenaltyForce force =
      penalty_force(penalty_of(contact, touch.area), touch.depth.size, out, touch.velocity, touch.spring, dt);
  contact.friction_work += force.friction_work;
  contact.damping_work += (force.elastic - force.normal) * out.dot(touch.velocity) * dt;
  contact.points.push_back(node);
  contact.slip.insert(contact.slip.end(), force.stretch.begin(), force.stretch.end());
  contact.side.push_back(0);
  contact.normal_sum += force.normal;
  contact.friction_sum += force.friction.norm();
  for (int a = 0; a < 3; ++a) {
    contact.normal_force[a] += force.normal * out[a];
    contact.friction_force[a] += force.friction[a];
  }
  return force.normal * out + force.friction;
}

void add_contact(const SpaceSurface& surface, double dt, Membrane<3>& membrane, RigidContact<3>& contact) {
  Springs springs(contact);
  forget_points(contact);
  const Array<double> area = node_areas(membrane);
  for (std::uint32_t k = 0; k < membrane.nodes(); ++k) {
    const Vec<3> x = vector_at(membrane.x, k);
    const auto depth = surface.depth(x);
    if (!depth) continue;
    const Vec<3> driven = surface.velocity(x);
    const Vec<3> force = push({area[k], *depth, vector_at(membrane.v, k) - driven, springs.of(k)}, k, dt, contact);
    contact.driving_work += dt * force.dot(driven);
    for (int a = 0; a < 3; ++a) membrane.load[a][k] += force[a];
  }
}

}  // namespace

RigidContact<3> make_space_contact(const Scene& scene, const ContactSpec& spec, const State<3>& state) {
  const ContactPair pair = contact_pair(scene, spec);
  RigidContact<3> contact;
  contact.touching = pair.touching;
  contact.rigid = pair.other;
  contact.friction = spec.friction;
  const Membrane<3>& membrane = find_named(state.membranes, pair.touching);
  const double h = finest_spacing(scene.grid);
  for (const Body<3>& body : state.bodies) {
    if (body.name != membrane.body) continue;
    set_penalty(spec, body.material, h, contact);
    return contact;
  }
  contact.stiffness = spec.stiffness * membrane.axial_stiffness / (h * h);
  contact.damping = spec.damping * std::sqrt(membrane.axial_stiffness * membrane.triangles.mass_per_area) / h;
  return contact;
}

void add_space_contacts(State<3>& state, double dt) {
  for (RigidContact<3>& contact : state.rigid_contacts) {
    const RigidBody<3>& rigid = find_named(state.rigid, contact.rigid);
    Membrane<3>& membrane = find_named(state.membranes, contact.touching);
    if (rigid.present && membrane.field != waiting)
      add_contact(SpaceSurface(rigid), dt, membrane, contact);
    else
      forget_points(contact);
  }
}

}  // namespace geodrop
