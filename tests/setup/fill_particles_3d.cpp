// Bodies in space filled with particles: volume, centre and layers of the shape, the lattice, jitter.
#include <doctest/doctest.h>
#include <geodrop/geometry/shapes.hpp>
#include <geodrop/step/pipeline.hpp>

#include <algorithm>
#include <numbers>

#include "support/near.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

/// A basin of 4 m x 4 m x 6 m, h = 0.25 m, with one body of water in it.
Scene basin(const Shape& shape) {
  Scene scene;
  scene.dimension = 3;
  scene.grid.lower = {-2, -2, 0};
  scene.grid.upper = {2, 2, 6};
  scene.grid.spacing = 0.25;
  scene.walls.lower.assign(3, WallKind::slip);
  scene.walls.upper.assign(3, WallKind::slip);
  scene.gravity = {0, 0, -10};
  scene.time.end = 1;
  scene.materials = {{"water", NewtonianSpec{1000, 1e9, 0}, {}}};
  BodySpec water;
  water.name = "water";
  water.material = "water";
  water.shape = shape;
  water.initial_stress = ZeroStressSpec{};
  water.initial_velocity = UniformVelocitySpec{{0, 0, 0}};
  scene.bodies = {water};
  return scene;
}

Body<3> alone(const Shape& shape) { return build_state<3>(basin(shape)).bodies[0]; }

struct Moments {
  double volume = 0;
  Vec<3> centre = Vec<3>::Zero();
};
Moments moments(const Body<3>& body) {
  Moments m;
  for (std::size_t p = 0; p < body.size(); ++p) {
    m.volume += body.volume(p);
    m.centre += body.volume(p) * Vec<3>(body.x[0][p], body.x[1][p], body.x[2][p]);
  }
  m.centre /= m.volume;
  return m;
}

const EllipseShape ellipsoid{{0.313, -0.2, 3.171}, {0.77, 1.3, 1.9}, 0};
const double ellipsoid_volume = 4 * std::numbers::pi / 3 * 0.77 * 1.3 * 1.9;

}  // namespace

TEST_CASE("Particles of an ellipsoid have its volume and centre to 1e-6, at any spacing") {
  for (const double h : {1.0, 0.5, 0.25}) {
    CAPTURE(h);
    Scene scene = basin(ellipsoid);
    scene.grid.spacing = h;
    const Moments m = moments(build_state<3>(scene).bodies[0]);
    MESSAGE("h = ", h, ": volume error ", m.volume / ellipsoid_volume - 1);
    CHECK(m.volume == near(ellipsoid_volume, 4e-7));
    for (std::size_t a = 0; a < 3; ++a)
      CHECK(std::abs(m.centre[static_cast<Eigen::Index>(a)] - ellipsoid.centre[a]) < 1e-6);
  }
}

TEST_CASE("What is cut out of a body is what the other has: the two fill the basin below a slope") {
  // The slope passes through (0, 0, 5.5) over the middle of the base, so the basin holds 16 m2 times 5.5 m.
  Scene scene = basin(HalfPlaneShape{{0, 0, 5.5}, {0.1, 0.05, 1}});
  scene.bodies.push_back(scene.bodies[0]);
  scene.bodies[0].minus = {"bag"};
  scene.bodies[1].name = "bag";
  scene.bodies[1].shape = ellipsoid;
  scene.bodies[1].minus.clear();
  const State<3> state = build_state<3>(scene);
  const Moments water = moments(state.bodies[0]), bag = moments(state.bodies[1]);
  CHECK(water.volume == near(88 - ellipsoid_volume, 1.5e-8));
  CHECK(bag.volume == near(ellipsoid_volume, 1.5e-7));
  for (std::size_t p = 0; p < state.bodies[1].size(); ++p) {
    const auto& x = state.bodies[1].x;
    CHECK(contains(ellipsoid, {x[0][p], x[1][p], x[2][p]}));
  }
}

TEST_CASE("Half-spaces are cut exactly, wherever they pass") {
  // The corner that x + 2 y + 3 z <= 2.1 leaves at (-2, -2, 0): intercepts 8.1, 4.05, 2.7 beyond the walls x, y = 2.
  const Moments corner = moments(alone(HalfPlaneShape{{2.1, 0, 0}, {1, 2, 3}}));
  const double whole = 8.1 * 4.05 * 2.7 / 6;                       // tetrahedron
  const double beyond_x = whole * std::pow((8.1 - 4) / 8.1, 3);    // its part with x > 2
  const double beyond_y = whole * std::pow((4.05 - 4) / 4.05, 3);  // its part with y > 2
  CHECK(corner.volume == near(whole - beyond_x - beyond_y, 1e-9));
  const Moments level = moments(alone(HalfPlaneShape{{0, 0, 1.003}, {0, 0, 1}}));
  CHECK(level.volume == near(16 * 1.003, 1e-12));
  CHECK(level.centre[2] == near(1.003 / 2, 1e-12));
}

TEST_CASE("A box on grid lines is a whole lattice; one that is not has its volume to rounding") {
  const Body<3> body = alone(BoxShape{{-2, -2, 0}, {2, 2, 1.5}});
  REQUIRE(body.size() == 32 * 32 * 12);
  for (std::size_t p = 0; p < body.size(); ++p) {
    CHECK(body.volume(p) == near(0.125 * 0.125 * 0.125, 1e-12));
    CHECK(body.id[p] == p);
    const double lower[] = {-2, -2, 0};
    for (int a = 0; a < 3; ++a) {
      const double site = (body.x[a][p] - lower[a]) / 0.125 - 0.5;
      CHECK(std::abs(site - std::round(site)) < 1e-9);
    }
  }
  const Moments cut = moments(alone(BoxShape{{-1.003, -0.7, 0.01}, {1, 0.77, 1.11}}));
  CHECK(cut.volume == near(2.003 * 1.47 * 1.1, 1e-12));
  CHECK(cut.centre[0] == near(-0.0015, 1e-9));
  CHECK(cut.centre[1] == near(0.035, 1e-9));
  CHECK(cut.centre[2] == near(0.56, 1e-9));
}

TEST_CASE("Layers in space are bands of height z") {
  Scene scene = basin(ellipsoid);
  scene.bodies[0].layers = 4;
  const Body<3> bag = build_state<3>(scene).bodies[0];
  for (std::size_t p = 0; p < bag.size(); ++p) {
    const double share = (bag.x[2][p] - (3.171 - 1.9)) / 3.8;
    CHECK(std::abs(bag.layer[p] + 0.5 - 4 * share) < 0.65);  // half a layer, and half a particle at the ends
  }
}

TEST_CASE("Jitter in space moves particles along all axes and leaves them in their body") {
  Scene scene = basin(ellipsoid);
  const Body<3> still = build_state<3>(scene).bodies[0];
  scene.bodies[0].jitter = 0.3;
  const Body<3> moved = build_state<3>(scene).bodies[0];
  REQUIRE(moved.size() == still.size());
  std::array<double, 3> largest{};
  for (std::size_t p = 0; p < moved.size(); ++p) {
    for (int a = 0; a < 3; ++a) largest[a] = std::max(largest[a], std::abs(moved.x[a][p] - still.x[a][p]));
    CHECK(contains(ellipsoid, {moved.x[0][p], moved.x[1][p], moved.x[2][p]}));
  }
  for (const double most : largest) {
    CHECK(most < 0.3 * 0.125);
    CHECK(most > 0.28 * 0.125);
  }
}
