// Lengths of eddies beside walls and sharp membranes.
#include <doctest/doctest.h>

#include "boundary/eddy_length.hpp"
#include "cut/rough_wall.hpp"
#include "support/near.hpp"
#include "support/random_particles.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

/// One fluid of mixing length 0.1 m with a particle at each place.
template <int Dim>
State<Dim> water_at(const std::vector<std::array<double, Dim>>& places) {
  State<Dim> state;
  Newtonian water{1000, 1e6, 0.001, 0.1};
  state.bodies = {blank_body<Dim>(water, places.size())};
  state.bodies[0].eddy_length.assign(places.size(), 0.0);
  for (std::size_t p = 0; p < places.size(); ++p)
    for (int a = 0; a < Dim; ++a) state.bodies[0].x[a][p] = places[p][a];
  return state;
}

Membrane<2> outline(const std::vector<std::array<double, 2>>& points, double roughness) {
  Membrane<2> membrane;
  membrane.sharp = true;
  membrane.field = 1;
  membrane.roughness = roughness;
  for (const auto& point : points)
    for (int a = 0; a < 2; ++a) membrane.x[a].push_back(point[a]);
  membrane.mass.assign(points.size(), 0.0);
  membrane.rest_length.assign(points.size(), 1.0);
  return membrane;
}

template <int Dim>
std::vector<double> lengths(State<Dim>& state, WallKind wall) {
  const Grid<Dim> grid = make_grid<Dim>(box_scene<Dim>(10, 0.5, wall));
  NearOutlines<Dim> near_outlines;
  limit_eddies(grid.layout, near_outlines, state);
  return {state.bodies[0].eddy_length.begin(), state.bodies[0].eddy_length.end()};
}

}  // namespace

TEST_CASE("Eddies are 0.4 times the distance from a side where the flow sticks, and one length far from it") {
  State<2> plane = water_at<2>({{0.1, 2.5}, {2.5, 4.95}, {2.5, 2.5}, {4.8, 0.2}});
  const std::vector<double> sticking = lengths(plane, WallKind::no_slip);
  CHECK(sticking[0] == near(0.04, 1e-13));
  CHECK(sticking[1] == near(0.02, 1e-12));
  CHECK(sticking[2] == 0.1);
  CHECK(sticking[3] == near(0.08, 1e-12));
  for (const double length : lengths(plane, WallKind::slip)) CHECK(length == 0.1);
  State<3> space = water_at<3>({{2.5, 2.5, 0.05}, {2.5, 4.9, 0.2}});
  const std::vector<double> in_space = lengths(space, WallKind::no_slip);
  CHECK(in_space[0] == near(0.02, 1e-13));
  CHECK(in_space[1] == near(0.04, 1e-12));
}

TEST_CASE("Beside a rough sharp membrane they are 0.4 (d + k_s / 30); others and waiting ones hinder nothing") {
  State<2> state = water_at<2>({{2.0, 1.0}, {2.0, 0.9}, {3.15, 2.0}, {3.12, 3.16}, {2.0, 0.2}});
  state.membranes = {outline({{1, 1}, {3, 1}, {3, 3}, {1, 3}}, 0.03)};
  const std::vector<double> rough = lengths(state, WallKind::slip);
  CHECK(rough[0] == near(0.4 * 0.001, 1e-12));
  CHECK(rough[1] == near(0.4 * 0.101, 1e-12));
  CHECK(rough[2] == near(0.4 * 0.151, 1e-12));
  CHECK(rough[3] == near(0.4 * 0.201, 1e-12));  // from the corner: 0.12, 0.16
  CHECK(rough[4] == 0.1);
  state.membranes[0].sharp = false;
  for (const double length : lengths(state, WallKind::slip)) CHECK(length == 0.1);
  state.membranes[0].sharp = true;
  state.membranes[0].field = waiting;
  for (const double length : lengths(state, WallKind::slip)) CHECK(length == 0.1);
}

TEST_CASE("The squares find the nearest segment of random outlines") {
  Random random(17);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<std::array<double, 2>> places(200), corners(static_cast<std::size_t>(3 + trial));
    for (auto& place : places) place = {random.uniform(0, 5), random.uniform(0, 5)};
    for (auto& corner : corners) corner = {random.uniform(1, 4), random.uniform(1, 4)};
    State<2> state = water_at<2>(places);
    state.membranes = {outline(corners, 0)};
    const std::vector<double> found = lengths(state, WallKind::slip);
    for (std::size_t p = 0; p < places.size(); ++p) {
      double distance = 10;  // by many points of each segment
      for (std::size_t s = 0; s < corners.size(); ++s)
        for (int part = 0; part <= 4000; ++part) {
          const auto &from = corners[s], &to = corners[(s + 1) % corners.size()];
          const double x = from[0] + part / 4000.0 * (to[0] - from[0]), y = from[1] + part / 4000.0 * (to[1] - from[1]);
          distance = std::min(distance, std::hypot(x - places[p][0], y - places[p][1]));
        }
      REQUIRE(found[p] == within(std::min(0.1, 0.4 * distance), 4e-4));
    }
  }
}

TEST_CASE("In space the cubes find the nearest triangle of random surfaces") {
  Random random(19);
  constexpr double rough = 0.03;
  for (int trial = 0; trial < 10; ++trial) {
    std::vector<std::array<double, 3>> places(200);
    for (auto& place : places)
      for (double& x : place) x = random.uniform(0, 5);
    State<3> state = water_at<3>(places);
    Membrane<3> surface;
    surface.sharp = true;
    surface.roughness = rough;
    const auto triangles = static_cast<std::uint32_t>(1 + 3 * trial);
    for (std::uint32_t node = 0; node < 3 * triangles; ++node) {
      for (auto& x : surface.x) x.push_back(random.uniform(1, 4));
      surface.triangles.corner[node % 3].push_back(node);
    }
    surface.mass.assign(surface.x[0].size(), 0.0);
    surface.triangles.rest_area.assign(triangles, 1.0);
    state.membranes = {surface};
    const std::vector<double> found = lengths(state, WallKind::slip);
    for (std::size_t p = 0; p < places.size(); ++p) {
      double distance = 10;  // by many points of each triangle
      const Vec<3> at(places[p].data());
      for (std::uint32_t t = 0; t < triangles; ++t)
        for (int i = 0; i <= 200; ++i)
          for (int j = 0; i + j <= 200; ++j) {
            const Vec<3> point = i / 200.0 * vector_at(surface.x, 3 * t) + j / 200.0 * vector_at(surface.x, 3 * t + 1) +
                                 (200 - i - j) / 200.0 * vector_at(surface.x, 3 * t + 2);
            distance = std::min(distance, (point - at).norm());
          }
      REQUIRE(found[p] == within(std::min(0.1, 0.4 * (distance + rough / 30)), 4e-3));
    }
  }
}

TEST_CASE("The friction of a rough wall: 2 / (2.5 ln(30 y / k_s + 1))^2") {
  CHECK(rough_wall_friction(0.125, 0.003) == near(6.291642e-3, 1e-6));
  CHECK(rough_wall_friction(0.4375, 0.003) == near(4.552593e-3, 1e-6));
  CHECK(rough_wall_friction(0.1, 3.0) == near(2 * 0.16 / std::pow(std::log(2.0), 2), 1e-14));
}
