// Membranes of triangles on each other: forces by hand, momentum, friction, and what must not touch.
#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "contact/membrane_contact.hpp"
#include "membrane/part_size.hpp"
#include "support/near.hpp"
#include "support/surfaces.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double dt = 0.01, stiffness = 2e5, reach = 0.2, depth = 1e-3;

/// The faces of a box in n x n x n steps, two triangles each.
TriangleSurface box_surface(const Corner& lower, const Corner& upper, int n) {
  TriangleSurface box;
  std::map<std::array<int, 3>, std::uint32_t> number;
  const auto point = [&](const std::array<int, 3>& at) {
    const auto [place, is_new] = number.try_emplace(at, static_cast<std::uint32_t>(box.points.size()));
    Corner x;
    for (std::size_t a = 0; a < 3; ++a) x[a] = lower[a] + (upper[a] - lower[a]) * at[a] / n;
    if (is_new) box.points.push_back(x);
    return place->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const bool high : {false, true})
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const auto corner = [&](int di, int dj) {
            std::array<int, 3> at{};
            at[axis] = high ? n : 0;
            at[(axis + 1) % 3] = i + di;
            at[(axis + 2) % 3] = j + dj;
            return point(at);
          };
          const std::uint32_t a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
          if (high)
            box.triangles.insert(box.triangles.end(), {{a, b, c}, {a, c, d}});
          else
            box.triangles.insert(box.triangles.end(), {{a, c, b}, {a, d, c}});
        }
  return box;
}

Membrane<3> cloth(const std::string& name, const TriangleSurface& surface) {
  REQUIRE(fault_of(surface) == "");
  Membrane<3> membrane = membrane_of(surface);
  membrane.name = membrane.body = name;
  for (auto* values : {&membrane.v, &membrane.load})
    for (auto& component : *values) component.assign(membrane.nodes(), 0.0);
  for (std::size_t t = 0; t < membrane.triangles.size(); ++t) membrane.triangles.rest_area[t] = size_of(membrane, t);
  return membrane;
}

State<3> touching(const Membrane<3>& one, const Membrane<3>& other, double friction) {
  State<3> state;
  state.membranes = {one, other};
  MembraneContact<3> contact{{one.name, other.name}, {1, 1}, friction, stiffness, 0, reach, {}};
  contact.slip = {Array<double>(3 * one.nodes(), 0.0), Array<double>(3 * other.nodes(), 0.0)};
  state.membrane_contacts = {contact};
  return state;
}

/// A slab of 1 m x 1 m, 1 mm deep in the ground, whose triangles are others.
State<3> flat(double friction) {
  return touching(cloth("ground", box_surface({0, 0, -1}, {3, 3, 0}, 30)),
                  cloth("slab", box_surface({1.03, 1.02, -depth}, {2.03, 2.02, 0.5}, 11)), friction);
}

void step(State<3>& state) {
  for (Membrane<3>& membrane : state.membranes)
    for (Array<double>& component : membrane.load) std::fill(component.begin(), component.end(), 0.0);
  add_membrane_contacts(state, dt);
}

Vec<3> resultant(const Membrane<3>& membrane) {
  Vec<3> sum;
  for (int a = 0; a < 3; ++a) sum[a] = std::accumulate(membrane.load[a].begin(), membrane.load[a].end(), 0.0);
  return sum;
}

Vec<3> moment(const Membrane<3>& membrane) {
  Vec<3> sum = Vec<3>::Zero();
  for (std::size_t k = 0; k < membrane.nodes(); ++k) sum += vector_at(membrane.x, k).cross(vector_at(membrane.load, k));
  return sum;
}

void move(Membrane<3>& membrane, const Vec<3>& velocity) {
  for (int a = 0; a < 3; ++a) membrane.v[a].assign(membrane.nodes(), velocity[a]);
}

}  // namespace

TEST_CASE("In space two faces push by stiffness, depth and the area that they have in common, both passes half") {
  State<3> state = flat(0.3);
  step(state);
  const MembraneContact<3>& contact = state.membrane_contacts[0];
  const double expected = stiffness * depth * 1.0;
  // At its rim a slab's nodes stand for a part of its sides, too, and the normals are slanted.
  CHECK(contact.force[2] == near(-expected, 0.15));
  CHECK(contact.normal_force == near(expected, 0.15));
  // A node in the middle of the slab, and all that the ground under it bears.
  const Membrane<3>& slab = state.membranes[1];
  double of_middle = 0, nodes = 0;
  for (std::size_t k = 0; k < slab.nodes(); ++k)
    if (slab.x[2][k] < 0 && std::abs(slab.x[0][k] - 1.53) < 0.3 && std::abs(slab.x[1][k] - 1.52) < 0.3) {
      of_middle += slab.load[2][k];
      ++nodes;
    }
  CHECK(of_middle / nodes == near(expected / (11 * 11), 0.03));
}

TEST_CASE("In space what one membrane gives the other takes, and little turns by it") {
  State<3> state = flat(0.3);
  move(state.membranes[1], {3, -2, 0.1});
  step(state);
  const Vec<3> one = resultant(state.membranes[0]), other = resultant(state.membranes[1]);
  CHECK((one + other).norm() < 1e-12 * one.norm());
  for (int a = 0; a < 3; ++a) CHECK(state.membrane_contacts[0].force[a] == near(one[a], 1e-12));
  CHECK((moment(state.membranes[0]) + moment(state.membranes[1])).norm() < 2 * depth * one.norm());
}

TEST_CASE("In space friction is against the way of one over the other, up to mu times the normal force") {
  State<3> rests = flat(0.3);
  step(rests);
  const Vec<3> at_rest = resultant(rests.membranes[1]);  // the slanted normals at the rim push along, too
  const auto friction = [&](State<3>& state) { return Vec<3>(resultant(state.membranes[1]) - at_rest); };
  const Vec<3> way = Vec<3>(3, -4, 0) / 5, across = Vec<3>(4, 3, 0) / 5;
  State<3> slips = flat(0.3);
  move(slips.membranes[1], 50 * way);
  step(slips);
  CHECK(friction(slips).dot(way) == near(-0.3 * at_rest[2], 0.03));
  CHECK(std::abs(friction(slips).dot(across)) < 0.01 * at_rest[2]);
  // A hundredth of a millimetre stretches the springs; back again lets them go.
  State<3> sticks = flat(0.3);
  move(sticks.membranes[1], 1e-3 * way);
  step(sticks);
  CHECK(friction(sticks).dot(way) == near(-at_rest[2] / depth * 1e-5, 0.05));
  move(sticks.membranes[1], -1e-3 * way);
  step(sticks);
  CHECK(friction(sticks).norm() < 1e-9 * at_rest[2]);
  // Nothing rubs where both go together.
  State<3> together = flat(0.3);
  for (Membrane<3>& membrane : together.membranes) move(membrane, {1, 2, 0});
  step(together);
  CHECK(friction(together).norm() < 1e-9 * at_rest[2]);
}

TEST_CASE("In space springs go slack where membranes part, and nothing touches from behind or from afar") {
  State<3> state = flat(0.3);
  move(state.membranes[1], {1, 0, 0});
  step(state);
  REQUIRE(resultant(state.membranes[1])[0] < -1);
  for (double& z : state.membranes[1].x[2]) z += 2 * depth;
  step(state);
  CHECK(resultant(state.membranes[1]).norm() == 0);
  for (const Array<double>& slip : state.membrane_contacts[0].slip)
    for (const double stretch : slip) CHECK(stretch == 0);
  // A sheet of 2 cm: its lower face is nearer to what stands deep in it, but faces the same way.
  State<3> thin = touching(cloth("sheet", box_surface({0, 0, -0.02}, {3, 3, 0}, 30)),
                           cloth("slab", box_surface({1, 1, -0.015}, {2, 2, 0.5}, 11)), 0);
  step(thin);
  CHECK(resultant(thin.membranes[1])[2] > 0.8 * stiffness * 0.015);
}

TEST_CASE("In space a ball on a ball of other triangles is pushed along the line between them") {
  const double radius = 0.5, apart = 2 * radius - 0.01;
  const Vec<3> way = Vec<3>(1, 2, 2) / 3;
  State<3> state = touching(cloth("one", ellipsoid_surface({0, 0, 0}, {radius, radius, radius}, 0.03)),
                            cloth("other", ellipsoid_surface({apart * way[0], apart * way[1], apart * way[2]},
                                                             {radius, radius, radius}, 0.04)),
                            0.0);
  step(state);
  const Vec<3> force = resultant(state.membranes[1]);
  // The integral of the depth d - s^2/r over the disc of the radius sqrt(d r) in which they meet.
  const double expected = stiffness * 0.5 * 3.14159 * radius * 0.01 * 0.01;
  CHECK(force.dot(way) == near(expected, 0.1));
  CHECK((force - force.dot(way) * way).norm() < 0.05 * expected);
}
