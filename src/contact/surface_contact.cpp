#include "surface_contact.hpp"

#include <geodrop/base/find_named.hpp>
#include <geodrop/geometry/shapes.hpp>
#include <geodrop/grid/graded_axis.hpp>

#include <algorithm>
#include <cmath>

#include "grid/point_support.hpp"
#include "membrane/bounds.hpp"
#include "node_length.hpp"
#include "penalty.hpp"

namespace geodrop {
namespace {

/// The along direction of slip: the normal turned clockwise.
Vec<2> tangent(const Vec<2>& normal) { return {normal[1], -normal[0]}; }

/// Spring and side of a point, from the step before.
struct Memory {
  double slip = 0;
  std::int8_t side = 0;
};

/// What the contact knew of its points, looked up in ascending order of their ids.
class Memories {
 public:
  explicit Memories(const RigidContact<2>& contact)
      : points_(contact.points), slip_(contact.slip), side_(contact.side) {}
  Memory of(std::uint32_t id) {
    while (next_ < points_.size() && points_[next_] < id) ++next_;
    if (next_ == points_.size() || points_[next_] != id) return {};
    return {slip_[next_], side_[next_]};
  }

 private:
  Array<std::uint32_t> points_;
  Array<double> slip_;
  Array<std::int8_t> side_;
  std::size_t next_ = 0;
};

void forget_points(RigidContact<2>& contact) {
  contact.points.clear();
  contact.slip.clear();
  contact.side.clear();
  contact.normal_force = contact.friction_force = {};
  contact.normal_sum = contact.friction_sum = 0;
}

/// One point in contact, `v` [m/s] over the surface: its force; keeps its memory and adds to the sums.
Vec<2> push(const ContactPoint& point, const RigidSurface::Gap& gap, const Vec<2>& v, double slip, double dt,
            RigidContact<2>& contact) {
  const Vec<2> along = tangent(gap.normal);
  const double v_n = gap.normal.dot(v);
  slip += dt * along.dot(v);
  const PenaltyForce force = penalty_force(penalty_of(contact, point.length), point.reach - gap.size, v_n, slip);
  contact.friction_work += std::abs(force.friction) * std::abs(slip - force.stretch);
  contact.damping_work += (force.elastic - force.normal) * v_n * dt;
  contact.points.push_back(point.id);
  contact.slip.push_back(force.stretch);
  contact.side.push_back(gap.side);
  contact.normal_sum += force.normal;
  contact.friction_sum += force.friction;
  for (int a = 0; a < 2; ++a) {
    contact.normal_force[a] += force.normal * gap.normal[a];
    contact.friction_force[a] += force.friction * along[a];
  }
  return force.normal * gap.normal + force.friction * along;
}

void add_membrane_contact(const RigidSurface& surface, double dt, Membrane<2>& membrane, RigidContact<2>& contact) {
  const Box<2> box = bounds(membrane, 0);
  std::vector<ContactPoint> points;
  if (surface.may_touch(box.lower, box.upper, 0))
    for (std::uint32_t k = 0; k < membrane.nodes(); ++k)
      points.push_back({k, vector_at(membrane.x, k), vector_at(membrane.v, k), node_length(membrane, k), 0});
  const std::vector<Vec<2>> forces = contact_forces(surface, points, dt, contact);
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int a = 0; a < 2; ++a) membrane.load[a][points[i].id] += forces[i][a];
}

/// Half the width of each particle, by id; of those that an outline cuts, their distance from it (no less than a share
/// of 2 % of a site has): a body that lies on a surface then just touches it.
Array<double> particle_reach(const Scene& scene, const Body<2>& body) {
  const BodySpec& spec = *find_body(scene, body.name);
  Array<double> reach(body.size());
  for (std::size_t p = 0; p < body.size(); ++p) {
    const Point x{body.initial_x[0][body.id[p]], body.initial_x[1][body.id[p]]};
    const double half = 0.5 * std::sqrt(body.mass[p] / reference_density(body.material));
    double least = half;
    least = std::min(least, distance_to_outline(spec.shape, x));
    for (const std::string& cut : spec.minus)
      least = std::min(least, distance_to_outline(find_body(scene, cut)->shape, x));
    reach[body.id[p]] = std::max(least, 0.02 * half);
  }
  return reach;
}

/// Length of surface that belongs to a particle: its volume over its width across the surface [m].
double particle_length(const Body<2>& body, std::size_t p, double reach) {
  return body.mass[p] / (reference_density(body.material) * 2 * reach);
}

/// The particles of a slab that may touch: a box around the slab, a cell of drift included, is looked at first.
void find_in_slab(const RigidSurface& surface, const GridLayout<2>& layout, const Body<2>& body,
                  const RigidContact<2>& contact, int slab, std::vector<ContactPoint>& found) {
  const std::size_t begin = body.slab_begin[slab], end = body.slab_begin[slab + 1];
  if (begin == end) return;
  const double reach = layout.h;  // no particle is wider
  const auto level = [&](int row) {
    return layout.node(1, std::clamp(row, -GridLayout<2>::pad, layout.cells[1] + GridLayout<2>::pad - 1));
  };
  const Vec<2> lower(layout.lower[0], level(slab * slab_width<2> - 2));
  const Vec<2> upper(layout.upper[0], level((slab + 1) * slab_width<2> + 1));
  if (!surface.may_touch(lower, upper, reach)) return;
  for (std::size_t p = begin; p < end; ++p) {
    const Vec<2> x = vector_at(body.x, p);
    const double to_surface = contact.reach[body.id[p]];
    if (surface.may_touch(x, x, to_surface))
      found.push_back({body.id[p], x, vector_at(body.v, p), particle_length(body, p, to_surface), to_surface});
  }
}

std::vector<ContactPoint> find_particles(const RigidSurface& surface, const GridLayout<2>& layout, const Body<2>& body,
                                         const RigidContact<2>& contact) {
  const auto slabs = static_cast<std::ptrdiff_t>(body.slab_begin.size()) - 1;
  std::vector<std::vector<ContactPoint>> of_slab(slabs);
#pragma omp parallel for schedule(static) if (body.size() > 1000)
  for (std::ptrdiff_t s = 0; s < slabs; ++s)
    find_in_slab(surface, layout, body, contact, static_cast<int>(s), of_slab[s]);
  std::vector<ContactPoint> points;
  for (const auto& some : of_slab) points.insert(points.end(), some.begin(), some.end());
  std::sort(points.begin(), points.end(), [](const ContactPoint& a, const ContactPoint& b) { return a.id < b.id; });
  return points;
}

void add_particle_contact(const RigidSurface& surface, double dt, const Body<2>& body, Grid<2>& grid,
                          RigidContact<2>& contact) {
  const std::vector<ContactPoint> points = find_particles(surface, grid.layout, body, contact);
  const std::vector<Vec<2>> forces = contact_forces(surface, points, dt, contact);
  const bool separate = !grid.force.empty();
  Array<Vec4>& field = separate ? grid.force : grid.sum;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec4 f = (separate ? 1.0 : dt) * Vec4{forces[i][0], forces[i][1]};
    const PointSupport<2> support(grid.layout, {points[i].x[0], points[i].x[1]}, body.half_size);
    support.for_each_node(grid.layout, [&](int node, double weight) { field[node] += weight * f; });
  }
}

}  // namespace

std::vector<Vec<2>> contact_forces(const RigidSurface& surface, const std::vector<ContactPoint>& points, double dt,
                                   RigidContact<2>& contact) {
  Memories memories(contact);
  forget_points(contact);
  std::vector<Vec<2>> forces(points.size(), Vec<2>::Zero());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Memory memory = memories.of(points[i].id);
    const auto gap = surface.gap(points[i].x, memory.side);
    if (!gap || !(gap->size < points[i].reach)) continue;
    const Vec<2> driven = surface.velocity(points[i].x);
    forces[i] = push(points[i], *gap, points[i].v - driven, memory.slip, dt, contact);
    contact.driving_work += dt * forces[i].dot(driven);
  }
  return forces;
}

RigidContact<2> make_rigid_contact(const Scene& scene, const ContactSpec& spec, const State<2>& state) {
  const ContactPair pair = contact_pair(scene, spec);
  RigidContact<2> contact;
  contact.touching = pair.touching;
  contact.rigid = pair.other;
  contact.bare = pair.kind == ContactPair::Kind::body_on_rigid;
  contact.friction = spec.friction;
  const Body<2>& body = touching_body(state, contact);
  const Material& material = body.material;
  contact.stiffness = spec.stiffness * impedance(material) * wave_speed(material) / finest_spacing(scene.grid);
  contact.damping = spec.damping * impedance(material);
  if (contact.bare) contact.reach = particle_reach(scene, body);
  return contact;
}

void add_contact_forces(State<2>& state, double dt) {
  for (RigidContact<2>& contact : state.rigid_contacts) {
    if (contact.bare) continue;
    const RigidBody<2>& rigid = find_named(state.rigid, contact.rigid);
    if (rigid.present && find_named(state.membranes, contact.touching).field != waiting)
      add_membrane_contact(RigidSurface(rigid), dt, find_named(state.membranes, contact.touching), contact);
    else
      forget_points(contact);
  }
}

void contact_to_grid(State<2>& state, Grid<2>& grid, double dt) {
  for (RigidContact<2>& contact : state.rigid_contacts) {
    if (!contact.bare || find_named(state.bodies, contact.touching).field != grid.field) continue;
    const RigidBody<2>& rigid = find_named(state.rigid, contact.rigid);
    if (rigid.present)
      add_particle_contact(RigidSurface(rigid), dt, find_named(state.bodies, contact.touching), grid, contact);
    else
      forget_points(contact);
  }
}

// Contacts are for the plane.

}  // namespace geodrop
