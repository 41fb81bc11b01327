// Membranes of triangles on each other, see membrane_contact.
#include <geodrop/base/find_named.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "geometry/triangle.hpp"
#include "membrane/bounds.hpp"
#include "membrane/triangles.hpp"
#include "membrane_contact.hpp"
#include "node_area.hpp"
#include "part_bins.hpp"
#include "penalty.hpp"

namespace geodrop {
namespace {

/// Of the triangles around it, by their areas.
std::vector<Vec<3>> node_normals(const Membrane<3>& membrane) {
  std::vector<Vec<3>> normals(membrane.nodes(), Vec<3>::Zero());
  for (std::size_t t = 0; t < membrane.triangles.size(); ++t) {
    const Vec<3> n = normal_of(membrane, t);
    for (const auto& corner : membrane.triangles.corner) normals[corner[t]] += n;
  }
  for (Vec<3>& n : normals) n.normalize();
  return normals;
}

/// Triangles of a membrane near a region.
PartBins<3> triangle_bins(const Membrane<3>& membrane, const Box<3>& region, double reach) {
  double largest = 0;  // from the middle to a corner
  PartBins<3>::Middles middles;
  for (std::size_t t = 0; t < membrane.triangles.size(); ++t) {
    const Vec<3> middle = middle_of(membrane, t);
    if (!region.holds(middle)) continue;
    for (const Vec<3>& corner : corners_of(membrane, t)) largest = std::max(largest, (corner - middle).norm());
    middles.emplace_back(t, middle);
  }
  return {middles, region, reach + largest};
}

/// Where a node meets the other membrane.
struct SpaceFoot {
  std::size_t triangle = 0;
  Vec<3> point = Vec<3>::Zero();  ///< [m]
  double distance = std::numeric_limits<double>::infinity();
};

/// The nearest triangle within reach that faces the node.
SpaceFoot nearest_foot(const Membrane<3>& master, const PartBins<3>& bins, const Vec<3>& x, const Vec<3>& normal,
                       double reach) {
  SpaceFoot best;
  bins.for_each_near(x, [&](std::size_t t) {
    if (normal.dot(normal_of(master, t)) >= 0) return;
    const Vec<3> point = nearest_point(corners_of(master, t), x);
    const double distance = (x - point).norm();
    if (distance < std::min(best.distance, reach)) best = {t, point, distance};
  });
  return best;
}

/// One of the two passes: nodes of `slave` on triangles of `master`.
struct SpacePass {
  Membrane<3>& slave;
  Membrane<3>& master;
  Array<double>& slip;  ///< of the nodes, a vector each
};

std::vector<SpaceFoot> find_feet(const SpacePass& pass, double reach) {
  std::vector<SpaceFoot> feet(pass.slave.nodes());
  const PartBins<3> bins = triangle_bins(pass.master, bounds(pass.slave, reach), reach);
  if (bins.empty()) return feet;
  const Box<3> around = bounds(pass.master, reach);
  const std::vector<Vec<3>> normals = node_normals(pass.slave);
  const auto n = static_cast<std::ptrdiff_t>(feet.size());
#pragma omp parallel for schedule(dynamic, 64)
  for (std::ptrdiff_t k = 0; k < n; ++k)
    if (const Vec<3> x = vector_at(pass.slave.x, k); around.holds(x))
      feet[k] = nearest_foot(pass.master, bins, x, normals[k], reach);
  return feet;
}

void add_load(Membrane<3>& membrane, std::size_t k, const Vec<3>& force) {
  for (int a = 0; a < 3; ++a) membrane.load[a][k] += force[a];
}

/// Sum of the forces on the slave. Lets the springs of nodes that do not touch go slack.
Vec<3> run_pass(const SpacePass& pass, MembraneContact<3>& contact, double dt) {
  Vec<3> sum = Vec<3>::Zero();
  const std::vector<SpaceFoot> feet = find_feet(pass, contact.reach);
  const std::vector<Vec<3>> normals = node_normals(pass.master);
  const Array<double> area = node_areas(pass.slave);
  for (std::size_t k = 0; k < feet.size(); ++k) {
    double* const slip = &pass.slip[3 * k];
    const Vec<3> stretch(slip);
    std::fill_n(slip, 3, 0.0);
    if (!std::isfinite(feet[k].distance)) continue;
    const auto share = corner_shares(corners_of(pass.master, feet[k].triangle), feet[k].point);
    Vec<3> normal = Vec<3>::Zero(), velocity = vector_at(pass.slave.v, k);
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t node = pass.master.triangles.corner[c][feet[k].triangle];
      normal += share[c] * normals[node];
      velocity -= share[c] * vector_at(pass.master.v, node);
    }
    normal.normalize();
    const double gap = normal.dot(vector_at(pass.slave.x, k) - feet[k].point);
    if (gap >= 0) continue;
    const SpacePenaltyForce push =
        penalty_force(penalty_of(contact, 0.5 * area[k]), -gap, normal, velocity, stretch, dt);
    std::copy(push.stretch.begin(), push.stretch.end(), slip);
    const Vec<3> force = push.normal * normal + push.friction;
    add_load(pass.slave, k, force);
    for (std::size_t c = 0; c < 3; ++c)
      add_load(pass.master, pass.master.triangles.corner[c][feet[k].triangle], -share[c] * force);
    contact.normal_force += push.normal;
    sum += force;
  }
  return sum;
}

}  // namespace

void add_membrane_contacts(State<3>& state, double dt) {
  for (MembraneContact<3>& contact : state.membrane_contacts) {
    Membrane<3>& one = find_named(state.membranes, contact.between[0]);
    Membrane<3>& other = find_named(state.membranes, contact.between[1]);
    if (one.field == waiting || other.field == waiting) continue;
    contact.normal_force = 0;
    const Vec<3> force =
        run_pass({one, other, contact.slip[0]}, contact, dt) - run_pass({other, one, contact.slip[1]}, contact, dt);
    contact.force = {force[0], force[1], force[2]};
  }
}

}  // namespace geodrop
