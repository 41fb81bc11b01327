#include "membrane_contact.hpp"

#include <geodrop/base/find_named.hpp>
#include <geodrop/grid/graded_axis.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/polygon.hpp"
#include "membrane/bounds.hpp"
#include "membrane/fluid_load.hpp"
#include "node_length.hpp"
#include "part_bins.hpp"
#include "penalty.hpp"

namespace geodrop {
namespace {

/// Outward unit normal of a segment; zero if it has no length.
Vec<2> segment_normal(const Membrane<2>& membrane, std::size_t s, double outward) {
  const Vec<2> d = vector_at(membrane.x, end_of_edge(s, membrane.nodes())) - vector_at(membrane.x, s);
  const double length = d.norm();
  return length > 0 ? Vec<2>(Vec<2>(d[1], -d[0]) * (outward / length)) : Vec<2>::Zero();
}

/// Of the segments beside it, their mean.
std::vector<Vec<2>> node_normals(const Membrane<2>& membrane, double outward) {
  std::vector<Vec<2>> normals(membrane.nodes(), Vec<2>::Zero());
  for (std::size_t s = 0; s < membrane.segments(); ++s) {
    const Vec<2> n = segment_normal(membrane, s, outward);
    normals[s] += n;
    normals[end_of_edge(s, membrane.nodes())] += n;
  }
  for (Vec<2>& n : normals) n.normalize();
  return normals;
}

/// Segments of a membrane near a region.
PartBins<2> segment_bins(const Membrane<2>& membrane, const Box<2>& region, double reach) {
  double longest = 0;
  PartBins<2>::Middles middles;
  for (std::size_t s = 0; s < membrane.segments(); ++s) {
    const Vec<2> a = vector_at(membrane.x, s), b = vector_at(membrane.x, end_of_edge(s, membrane.nodes()));
    const Vec<2> middle = 0.5 * (a + b);
    if (!region.holds(middle)) continue;
    longest = std::max(longest, (b - a).norm());
    middles.emplace_back(s, middle);
  }
  return {middles, region, reach + longest};
}

/// One of the two passes: nodes of `slave` on segments of `master`.
struct Pass {
  Membrane<2>& slave;
  Membrane<2>& master;
  Array<double>& slip;
  double slave_outward, master_outward;
  bool folds;
};

/// Where a node meets the other membrane.
struct Foot {
  std::size_t segment = 0;
  double share = 0;  ///< of the way from the segment's start to its end
  Vec<2> point;      ///< [m]
  double distance = std::numeric_limits<double>::infinity();
};

/// Own folds of an open membrane press only into this share of the reach: deeper is the other flank of a thin bag, seen
/// from inside.
constexpr double deepest_fold = 0.25;

/// Whether a node at `x`, behind its foot on the same membrane, sees the other flank of a thin bag from inside.
/// Of a closed one, what lies between them is then inside once; where folds have pressed into each other, it is inside
/// twice.
bool meets_from_inside(const Membrane<2>& membrane, const Vec<2>& x, const Vec<2>& foot, double deepest) {
  if (!membrane.closed) return (x - foot).norm() > deepest;
  return std::abs(winding_number(membrane.x[0], membrane.x[1], 0.5 * (x + foot))) < 2;
}

/// Whether a place on a segment, as a share of it, lies beyond an end of an open membrane, where nothing is.
bool beyond_end(const Membrane<2>& membrane, std::size_t s, double share) {
  constexpr double rounding = 1e-6;  // of a segment; skins may end together at a wall
  if (membrane.closed) return false;
  return (s == 0 && share < -rounding) || (s + 1 == membrane.segments() && share > 1 + rounding);
}

/// The nearest segment within reach that faces the node.
Foot nearest_foot(const Pass& pass, const PartBins<2>& bins, std::size_t k, const Vec<2>& normal, double reach) {
  const Vec<2> x = vector_at(pass.slave.x, k);
  Foot best;
  best.distance = reach;
  bool touches = false;
  bins.for_each_near(x, [&](std::size_t s) {
    if (normal.dot(segment_normal(pass.master, s, pass.master_outward)) >= 0) return;
    const Vec<2> a = vector_at(pass.master.x, s);
    const Vec<2> d = vector_at(pass.master.x, end_of_edge(s, pass.master.nodes())) - a;
    const double along = d.dot(x - a) / d.squaredNorm(), share = std::clamp(along, 0.0, 1.0);
    const Vec<2> point = a + share * d;
    const double distance = (x - point).norm();
    if (distance > best.distance || (touches && distance == best.distance)) return;
    best = {s, share, point, distance};
    touches = !beyond_end(pass.master, s, along);
  });
  if (!touches) best.distance = std::numeric_limits<double>::infinity();
  return best;
}

void add_load(Membrane<2>& membrane, std::size_t k, const Vec<2>& force) {
  for (int a = 0; a < 2; ++a) membrane.load[a][k] += force[a];
}

/// Force on the slave node; its reaction acts on the master. Lets the spring go slack where they do not touch.
Vec<2> push_node(const Pass& pass, const MembraneContact<2>& contact, double dt, std::size_t k, const Foot& foot,
                 const Vec<2>& normal, double& pressed) {
  const std::size_t end = end_of_edge(foot.segment, pass.master.nodes());
  const double gap = normal.dot(vector_at(pass.slave.x, k) - foot.point);
  if (gap >= 0 || (pass.folds && meets_from_inside(pass.slave, vector_at(pass.slave.x, k), foot.point,
                                                   deepest_fold * contact.reach))) {
    pass.slip[k] = 0;
    return Vec<2>::Zero();
  }
  const Vec<2> along(-normal[1], normal[0]);
  const Vec<2> v = vector_at(pass.slave.v, k) - (1 - foot.share) * vector_at(pass.master.v, foot.segment) -
                   foot.share * vector_at(pass.master.v, end);
  const double rubbing = std::min(rubbing_pressure(pass.slave, k), std::min(rubbing_pressure(pass.master, foot.segment),
                                                                            rubbing_pressure(pass.master, end)));
  const PenaltyForce push = penalty_force(penalty_of(contact, 0.5 * node_length(pass.slave, k), rubbing), -gap,
                                          normal.dot(v), pass.slip[k] + dt * along.dot(v));
  pass.slip[k] = push.stretch;
  Vec<2> force = push.normal * normal + push.friction * along;
  add_load(pass.slave, k, force);
  add_load(pass.master, foot.segment, -(1 - foot.share) * force);
  add_load(pass.master, end, -foot.share * force);
  pressed += push.normal;
  return force;
}

/// Sum of the forces on the slave.
Vec<2> run_pass(const Pass& pass, MembraneContact<2>& contact, double dt) {
  Vec<2> sum = Vec<2>::Zero();
  const Box<2> nearby = bounds(pass.slave, contact.reach);  // a flat skin has no thickness of its own
  const PartBins<2> bins = segment_bins(pass.master, nearby, contact.reach);
  if (bins.empty()) {
    std::fill(pass.slip.begin(), pass.slip.end(), 0.0);
    return sum;
  }
  const Box<2> around = bounds(pass.master, contact.reach);
  const auto slave_normals = node_normals(pass.slave, pass.slave_outward);
  const auto master_normals = node_normals(pass.master, pass.master_outward);
  for (std::size_t k = 0; k < pass.slave.nodes(); ++k) {
    Foot foot;
    if (around.holds(vector_at(pass.slave.x, k))) foot = nearest_foot(pass, bins, k, slave_normals[k], contact.reach);
    if (!std::isfinite(foot.distance)) {
      pass.slip[k] = 0;
      continue;
    }
    const Vec<2> normal = ((1 - foot.share) * master_normals[foot.segment] +
                           foot.share * master_normals[end_of_edge(foot.segment, pass.master.nodes())])
                              .normalized();
    sum += push_node(pass, contact, dt, k, foot, normal, contact.normal_force);
  }
  return sum;
}

/// 1 if the body lies on the left of its membrane. Of an open one, that of most of its particles as seen from the
/// nearest nodes.
double side_of_body(const State<2>& state, const Membrane<2>& membrane) {
  if (membrane.closed) return sense_of(membrane);
  const Body<2>& body = find_named(state.bodies, membrane.body);
  std::ptrdiff_t left = 0;
  for (std::size_t p = 0; p < body.size(); ++p) {
    const Vec<2> x = vector_at(body.x, p);
    double nearest = std::numeric_limits<double>::infinity(), side = 0;
    for (std::size_t s = 0; s < membrane.segments(); ++s) {
      const Vec<2> a = vector_at(membrane.x, s), d = vector_at(membrane.x, s + 1) - a;
      const double distance = (x - a - 0.5 * d).squaredNorm();
      if (distance >= nearest) continue;
      nearest = distance;
      side = d[0] * (x[1] - a[1]) - d[1] * (x[0] - a[0]);
    }
    left += side > 0 ? 1 : -1;
  }
  return left > 0 ? 1 : -1;
}

/// Outward normals of triangles are.
double side_of_body(const State<3>&, const Membrane<3>&) { return 1; }

template <int Dim>
const Material& material_behind(const State<Dim>& state, const Membrane<Dim>& membrane) {
  return find_named(state.bodies, membrane.body).material;
}

}  // namespace

template <int Dim>
MembraneContact<Dim> make_membrane_contact(const Scene& scene, const ContactSpec& spec, const State<Dim>& state) {
  constexpr std::size_t components = Dim == 2 ? 1 : 3;  // of a tangential spring
  MembraneContact<Dim> contact;
  contact.between = spec.between;
  contact.friction = spec.friction;
  contact.reach = finest_spacing(scene.grid);
  double modulus = std::numeric_limits<double>::infinity(), of_both = 0;
  for (int side = 0; side < 2; ++side) {
    const Membrane<Dim>& membrane = find_named(state.membranes, spec.between[side]);
    const Material& behind = material_behind(state, membrane);
    modulus = std::min(modulus, impedance(behind) * wave_speed(behind));
    of_both += 1 / impedance(behind);
    contact.outward[side] = side_of_body(state, membrane);
    contact.slip[side].assign(components * membrane.nodes(), 0.0);
  }
  contact.stiffness = spec.stiffness * modulus / finest_spacing(scene.grid);
  contact.damping = spec.damping / of_both;
  return contact;
}

template MembraneContact<2> make_membrane_contact(const Scene&, const ContactSpec&, const State<2>&);
template MembraneContact<3> make_membrane_contact(const Scene&, const ContactSpec&, const State<3>&);

void add_membrane_contacts(State<2>& state, double dt) {
  for (MembraneContact<2>& contact : state.membrane_contacts) {
    Membrane<2>& one = find_named(state.membranes, contact.between[0]);
    Membrane<2>& other = find_named(state.membranes, contact.between[1]);
    if (one.field == waiting || other.field == waiting) continue;
    const bool folds = &one == &other;
    contact.normal_force = 0;
    Vec<2> force = run_pass({one, other, contact.slip[0], contact.outward[0], contact.outward[1], folds}, contact, dt);
    if (!folds)
      force -= run_pass({other, one, contact.slip[1], contact.outward[1], contact.outward[0], folds}, contact, dt);
    contact.force = {force[0], force[1]};
  }
}

}  // namespace geodrop
