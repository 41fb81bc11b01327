#include "surface_contact.hpp"

#include <geodrop/base/find_named.hpp>
#include <geodrop/geometry/shapes.hpp>
#include <geodrop/grid/graded_axis.hpp>

#include <algorithm>
#include <cmath>

#include "grid/point_support.hpp"
#include "membrane/bounds.hpp"
#include "near_surface.hpp"
#include "node_length.hpp"
#include "penalty.hpp"

namespace geodrop {
namespace {

/// The along direction of slip: the normal turned clockwise.
Vec<2> tangent(const Vec<2>& normal) { return {normal[1], -normal[0]}; }

/// What the contact knew of its points, looked up in ascending order of their ids.
class Memories {
 public:
  explicit Memories(const RigidContact<2>& contact)
      : points_(contact.points), slip_(contact.slip), side_(contact.side), piece_(contact.piece) {}
  /// None of a point that did not touch.
  std::int8_t side_of(std::uint32_t id) {
    while (next_ < points_.size() && points_[next_] < id) ++next_;
    return next_ < points_.size() && points_[next_] == id ? side_[next_] : std::int8_t{0};
  }
  /// Stretch at one of the faces that the point, the last one asked for, touches. From one face to the next it stays.
  double slip_at(const SurfaceGap& face, const SurfaceTouch& touch, std::uint32_t id) const {
    if (next_ == points_.size() || points_[next_] != id) return 0;
    const bool two_before = next_ + 1 < points_.size() && points_[next_ + 1] == id;
    if (piece_.empty() || (touch.count == 1 && !two_before)) return slip_[next_];
    if (piece_[next_] == face.piece) return slip_[next_];
    return two_before && piece_[next_ + 1] == face.piece ? slip_[next_ + 1] : 0;
  }

 private:
  Array<std::uint32_t> points_;
  Array<double> slip_;
  Array<std::int8_t> side_;
  std::vector<std::uint32_t> piece_;
  std::size_t next_ = 0;
};

/// One point in contact, `v` [m/s] over the surface: its force; keeps its memory and adds to the sums.
Vec<2> push(const RigidSurface& surface, const ContactPoint& point, const RigidSurface::Gap& gap, const Vec<2>& v,
            double slip, double dt, RigidContact<2>& contact) {
  const Vec<2> along = tangent(gap.normal);
  const double v_n = gap.normal.dot(v);
  slip += dt * along.dot(v);
  const PenaltyForce force =
      penalty_force(penalty_of(contact, gap.share * point.length, point.rubbing), point.reach - gap.size, v_n, slip);
  contact.friction_work += std::abs(force.friction) * std::abs(slip - force.stretch);
  contact.damping_work += (force.elastic - force.normal) * v_n * dt;
  contact.points.push_back(point.id);
  contact.slip.push_back(force.stretch);
  contact.side.push_back(gap.side);
  if (surface.has_pieces()) contact.piece.push_back(gap.piece);
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
      points.push_back({k, vector_at(membrane.x, k), vector_at(membrane.v, k), node_length(membrane, k), 0,
                        rubbing_pressure(membrane, k)});
  const std::vector<SurfaceForce> forces = contact_forces(surface, points, dt, contact);
  for (const SurfaceForce& on : forces)
    for (int a = 0; a < 2; ++a) membrane.load[a][points[on.point].id] += on.force[a];
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

/// A fluid that lies on a surface touches it at the start as deep as its pressure presses it in, by id: without that it
/// is let go, and rings.
RareList<double> depth_at_start(const Newtonian& fluid, const Body<2>& body, double stiffness) {
  RareList<double> depth(body.size());
  for (std::size_t p = 0; p < body.size(); ++p)
    depth[body.id[p]] =
        std::max(0.0, fluid_pressure(fluid, body.J[p], body.gas_at(p), fluid.of_weight(body.x[1][p]))) / stiffness;
  return depth;
}

/// Length of surface that belongs to a particle: its volume over its width across the surface [m].
double particle_length(const Body<2>& body, std::size_t p, const RigidContact<2>& contact) {
  const double reach = contact.half_width[body.id[p]], at_rest = body.mass[p] / reference_density(body.material);
  if (contact.pressed_in.empty()) return at_rest / (2 * reach);
  return body.J[p] * at_rest / (2 * (reach - contact.pressed_in[body.id[p]]));
}

std::vector<ContactPoint> find_particles(const RigidSurface& surface, const GridLayout<2>& layout, const Body<2>& body,
                                         const RigidContact<2>& contact) {
  std::vector<std::vector<ContactPoint>> of_slab(body.slab_begin.size() - 1);
  for_each_near(surface, layout, body, contact.half_width, [&](std::size_t p, std::ptrdiff_t slab) {
    const double reach = contact.half_width[body.id[p]];
    of_slab[slab].push_back(
        {body.id[p], vector_at(body.x, p), vector_at(body.v, p), particle_length(body, p, contact), reach});
  });
  std::vector<ContactPoint> points;
  for (const auto& some : of_slab) points.insert(points.end(), some.begin(), some.end());
  std::sort(points.begin(), points.end(), [](const ContactPoint& a, const ContactPoint& b) { return a.id < b.id; });
  return points;
}

/// The surface may leave the domain beside a particle that is in it.
std::array<double, 2> in_reach_of_grid(const GridLayout<2>& layout, const Vec<2>& x) {
  std::array<double, 2> place;
  for (int a = 0; a < 2; ++a) place[a] = std::clamp(x[a], layout.particle_lower[a], layout.particle_upper[a]);
  return place;
}

/// Where the force on fluid acts: on the surface, where the pressure of particles ends. At the particle the two
/// balance on no node by itself (water beside a half-plane kept 0.6 m/s). No farther off than its reach: nodes there
/// may have no mass.
Vec<2> place_of_force(const ContactPoint& point, const RigidSurface::Gap& gap) {
  return point.x - std::clamp(gap.size, -point.reach, point.reach) * gap.normal;
}

/// The grid's, before forces act. A particle's own velocity has parts that the grid does not see and that a dashpot
/// cannot stop (FLIP: water at rest "dissipated" 3 kJ instead of 0.07 kJ).
Vec<2> grid_velocity(const Grid<2>& grid, const Vec<2>& x, double half_size) {
  const PointSupport<2> support(grid.layout, in_reach_of_grid(grid.layout, x), half_size);
  Vec4 sum{};
  double weights = 0;
  support.for_each_node(grid.layout, [&](int node, double weight) {
    const double mass = grid.sum[node][3];
    if (!(mass > 0)) return;
    sum += weight / mass * grid.sum[node];
    weights += weight;
  });
  return weights > 0 ? Vec<2>(Vec<2>(sum[0], sum[1]) / weights) : Vec<2>::Zero();
}

/// The velocities of the points become the grid's at the surface, and their half widths follow the flow: where it
/// spreads along the surface particles are flattened, dr = dt (v(x) - v(on)) . n. The depth then follows the velocity
/// at the place of the force, and contact takes as much energy as it gives (a dam break over an obstacle: 0.9 % of
/// energy gained, with constant widths 3.6 %). Widths go back to that of the start with 1 % of the wave speed: without
/// that water at rest settles at the surface. What has parted, and meets the surface again flatter, is as wide as it
/// is far off.
void follow_flow(const RigidSurface& surface, double dt, const Body<2>& body, const Grid<2>& grid,
                 std::vector<ContactPoint>& points, RigidContact<2>& contact) {
  constexpr double least = 0.25, most = 2, recovery = 0.01;
  const double back = recovery * wave_speed(body.material) * dt / grid.layout.finest;
  for (ContactPoint& point : points) {
    const auto gap = surface.gap(point.x, 0);
    if (!gap || !(gap->size < point.reach)) continue;
    point.v = grid_velocity(grid, place_of_force(point, *gap), body.half_size);
    const double at_start = contact.reach[point.id];
    const double spread = dt * gap->normal.dot(grid_velocity(grid, point.x, body.half_size) - point.v);
    const double change = touch_share(gap->size, point.reach) * (spread + back * (at_start - point.reach));
    const double pressed_in = contact.pressed_in[point.id], width = at_start - pressed_in;
    contact.half_width[point.id] =
        pressed_in + std::clamp(point.reach + change - pressed_in, least * width, most * width);
  }
}

/// Particles that have parted from the surface get their width back as far as they do not touch by that.
void recover_widths(const RigidSurface& surface, const GridLayout<2>& layout, const Body<2>& body,
                    RigidContact<2>& contact) {
  for_each_near(surface, layout, body, contact.reach, [&](std::size_t p, std::ptrdiff_t) {
    double& width = contact.half_width[body.id[p]];
    const double at_start = contact.reach[body.id[p]];
    const auto gap = width < at_start ? surface.gap(vector_at(body.x, p), 0) : std::nullopt;
    if (gap && gap->size >= width) width = std::min(at_start, gap->size);
  });
}

void add_particle_contact(const RigidSurface& surface, double dt, const Body<2>& body, Grid<2>& grid,
                          RigidContact<2>& contact) {
  // A solid keeps its widths, and is stiff enough to hold a force inside its edge; friction stops it sooner there.
  const bool fluid = std::holds_alternative<Newtonian>(body.material);
  if (fluid) recover_widths(surface, grid.layout, body, contact);
  std::vector<ContactPoint> points = find_particles(surface, grid.layout, body, contact);
  if (fluid) follow_flow(surface, dt, body, grid, points, contact);
  const std::vector<SurfaceForce> forces = contact_forces(surface, points, dt, contact);
  const bool separate = !grid.force.empty();
  Array<Vec4>& field = separate ? grid.force : grid.sum;
  for (const auto& [force, on, point] : forces) {
    const Vec4 f = (separate ? 1.0 : dt) * Vec4{force[0], force[1]};
    const PointSupport<2> support(grid.layout, in_reach_of_grid(grid.layout, fluid ? on : points[point].x),
                                  body.half_size);
    support.for_each_node(grid.layout, [&](int node, double weight) { field[node] += weight * f; });
  }
}

}  // namespace

std::vector<SurfaceForce> contact_forces(const RigidSurface& surface, const std::vector<ContactPoint>& points,
                                         double dt, RigidContact<2>& contact) {
  Memories memories(contact);
  forget_points(contact);
  std::vector<SurfaceForce> forces;
  for (std::size_t i = 0; i < points.size(); ++i) forces.push_back({Vec<2>::Zero(), points[i].x, i});
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SurfaceTouch touch = surface.touch(points[i].x, memories.side_of(points[i].id), points[i].reach);
    const Vec<2> driven = surface.velocity(points[i].x);
    for (const SurfaceGap& face : touch) {
      const double slip = memories.slip_at(face, touch, points[i].id);
      const SurfaceForce force{push(surface, points[i], face, points[i].v - driven, slip, dt, contact),
                               place_of_force(points[i], face), i};
      contact.driving_work += dt * force.force.dot(driven);
      if (&face == touch.begin())
        forces[i] = force;
      else
        forces.push_back(force);
    }
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
  set_penalty(spec, body.material, finest_spacing(scene.grid), contact);
  if (!contact.bare) return contact;
  contact.reach = particle_reach(scene, body);
  if (const auto* fluid = std::get_if<Newtonian>(&body.material)) {
    contact.pressed_in = depth_at_start(*fluid, body, contact.stiffness);
    for (std::size_t id = 0; id < body.size(); ++id) contact.reach[id] += contact.pressed_in[id];
  }
  contact.half_width = contact.reach;
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
