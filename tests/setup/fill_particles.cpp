// Bodies filled with particles: area, centre and layers of the shape, the lattice, jitter.
#include <doctest/doctest.h>
#include <geodrop/base/error.hpp>
#include <geodrop/geometry/shapes.hpp>
#include <geodrop/step/pipeline.hpp>

#include <numbers>
#include <random>

#include "support/near.hpp"
#include "support/scene_files.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

/// Basin of 8 m x 6 m of water around an ellipse of soil, h = 0.25 m.
Scene basin_scene(double tilt = 0) {
  Scene scene;
  scene.grid.lower = {-4, 0};
  scene.grid.upper = {4, 8};
  scene.grid.spacing = 0.25;
  scene.walls.lower.assign(2, WallKind::slip);
  scene.walls.upper.assign(2, WallKind::slip);
  scene.gravity = {0, -10};
  scene.time.end = 1;
  scene.materials = {{"water", NewtonianSpec{1000, 1e9, 0}, {}},
                     {"soil", MohrCoulombSpec{2000, 1e7, 0.3, 0, 30, 0, 0, {}}, {}}};
  BodySpec water, bag;
  water.name = "water";
  water.material = "water";
  water.shape = BoxShape{{-4, 0}, {4, 6}};
  water.minus = {"bag"};
  water.initial_stress = ZeroStressSpec{};
  bag.name = "bag";
  bag.material = "soil";
  bag.shape = EllipseShape{{0.313, 3.171}, {0.77, 1.9}, tilt};
  bag.initial_stress = ZeroStressSpec{};
  bag.layers = 5;
  water.initial_velocity = bag.initial_velocity = UniformVelocitySpec{{0, 0}};
  scene.bodies = {water, bag};
  return scene;
}

struct Moments {
  double area = 0, x = 0, y = 0;
};
Moments moments(const Body<2>& body) {
  Moments m;
  for (std::size_t p = 0; p < body.size(); ++p) {
    m.area += body.volume(p);
    m.x += body.volume(p) * body.x[0][p];
    m.y += body.volume(p) * body.x[1][p];
  }
  m.x /= m.area;
  m.y /= m.area;
  return m;
}

}  // namespace

TEST_CASE("Particles of an ellipse have its area and centre, upright and tilted; the water has the rest") {
  for (const double tilt : {0.0, 27.0}) {
    CAPTURE(tilt);
    const State<2> state = build_state<2>(basin_scene(tilt));
    const double ellipse = std::numbers::pi * 0.77 * 1.9, box = 48, rest = box - ellipse;
    const Moments bag = moments(state.bodies[1]), water = moments(state.bodies[0]);
    CHECK(bag.area == near(ellipse, 1.5e-7));
    CHECK(std::abs(bag.x - 0.313) < 1e-3 * 1.9);
    CHECK(std::abs(bag.y - 3.171) < 1e-3 * 1.9);
    CHECK(water.area == near(rest, 1.5e-8));
    CHECK(std::abs(water.x - -0.313 * ellipse / rest) < 1e-3 * 1.9);
    CHECK(std::abs(water.y - (3 * box - 3.171 * ellipse) / rest) < 1e-3 * 1.9);
  }
}

TEST_CASE("No particle of the water lies in the bag, and each body's particles lie in it") {
  const Scene scene = basin_scene();
  const State<2> state = build_state<2>(scene);
  const auto inside = [](double x, double y) {
    return std::pow((x - 0.313) / 0.77, 2) + std::pow((y - 3.171) / 1.9, 2);
  };
  for (std::size_t p = 0; p < state.bodies[0].size(); ++p)
    CHECK(inside(state.bodies[0].x[0][p], state.bodies[0].x[1][p]) > 0.98);
  for (std::size_t p = 0; p < state.bodies[1].size(); ++p)
    CHECK(inside(state.bodies[1].x[0][p], state.bodies[1].x[1][p]) < 1);
}

TEST_CASE("A box on grid lines is a whole lattice: every particle the same volume, ids in order") {
  Scene scene = basin_scene();
  scene.bodies = {scene.bodies[0]};
  scene.bodies[0].minus.clear();
  scene.bodies[0].particles_per_cell_axis = 3;
  const Body<2> body = build_state<2>(scene).bodies[0];
  REQUIRE(body.size() == 96 * 72);
  const double width = 0.25 / 3;
  for (std::size_t p = 0; p < body.size(); ++p) {
    CHECK(body.volume(p) == near(width * width, 1e-12));
    CHECK(body.id[p] == p);
    for (int a = 0; a < 2; ++a) {
      const double site = (body.x[a][p] - scene.grid.lower[a]) / width - 0.5;
      CHECK(std::abs(site - std::round(site)) < 1e-9);
      CHECK(body.initial_x[a][p] == body.x[a][p]);
    }
  }
}

TEST_CASE("Layers are level, from 0 at the bottom, all of the same thickness") {
  const State<2> state = build_state<2>(basin_scene());
  const Body<2>& bag = state.bodies[1];
  std::array<int, 5> count{};
  for (std::size_t p = 0; p < bag.size(); ++p) {
    const double share = (bag.x[1][p] - (3.171 - 1.9)) / 3.8;
    REQUIRE(bag.layer[p] < 5);
    ++count[bag.layer[p]];
    CHECK(std::abs(bag.layer[p] + 0.5 - 5 * share) < 0.65);  // half a layer, and half a particle at the ends
  }
  for (const int n : count) CHECK(n > 0);
  for (const auto layer : state.bodies[0].layer) CHECK(layer == 0);
}

TEST_CASE("Jitter moves particles by up to its share of their spacing, by the seed alone, and keeps the mass") {
  Scene scene = basin_scene();
  scene.bodies = {scene.bodies[0]};
  scene.bodies[0].minus.clear();
  const Body<2> still = build_state<2>(scene).bodies[0];
  scene.bodies[0].jitter = 0.3;
  scene.bodies[0].jitter_seed = 5;
  const Body<2> first = build_state<2>(scene).bodies[0], again = build_state<2>(scene).bodies[0];
  scene.bodies[0].jitter_seed = 6;
  const Body<2> other = build_state<2>(scene).bodies[0];
  CHECK(first.x == again.x);
  CHECK(first.x != other.x);
  CHECK(first.mass == still.mass);
  double largest = 0, sum = 0;
  for (std::size_t p = 0; p < still.size(); ++p) {
    const double moved = first.x[0][p] - still.x[0][p];
    largest = std::max(largest, std::abs(moved));
    sum += moved;
  }
  CHECK(largest < 0.3 * 0.125);
  CHECK(largest > 0.29 * 0.125);
  CHECK(std::abs(sum) / static_cast<double>(still.size()) < 0.002);  // 3072 values within +-0.0375: sigma 4e-4
}

TEST_CASE("A shape too thin for a particle is an error of the scene") {
  Scene scene = basin_scene();
  scene.bodies[1].shape = BoxShape{{0.001, 1}, {0.0011, 2}};
  CHECK_THROWS_AS(build_state<2>(scene), SceneError);
}

namespace {

/// The particles of one body of water alone in the basin.
Body<2> alone(const Shape& shape, double jitter = 0) {
  Scene scene = basin_scene();
  scene.bodies.resize(1);
  BodySpec& water = scene.bodies[0];
  water.minus.clear();
  water.shape = shape;
  water.jitter = jitter;
  return build_state<2>(scene).bodies[0];
}

}  // namespace

TEST_CASE("Boxes and polygons have their area and centre to rounding, wherever their edges lie in the lattice") {
  for (const double top : {1.0, 1.001, 1.002, 1.0026, 1.01, 1.015, 1.11, 1.1249}) {
    for (const double left : {-1.0, -1.003, -1.07}) {
      CAPTURE(top);
      CAPTURE(left);
      const Moments m = moments(alone(BoxShape{{left, 0}, {1, top}}));
      CHECK(m.area == near((1 - left) * top, 1e-9));
      CHECK(m.x == within((1 + left) / 2, 1e-15));
      CHECK(m.y == near(top / 2, 1e-9));
    }
  }
  // A wedge whose tip is thinner than 2 % of a site over more than two sites.
  const Moments wedge = moments(alone(PolygonShape{{{-2, 1.01}, {1, 1.01}, {1, 1.04}}}));
  CHECK(wedge.area == near(3 * 0.03 / 2, 1e-9));
  CHECK(wedge.x == near_zero(1e-15));
  CHECK(wedge.y == near(1.02, 1e-9));
  const Moments slope =
      moments(alone(HalfPlaneShape{{0, 3}, {0.01, 1}}));  // 3 m deep at x = 0, the centre of the basin
  CHECK(slope.area == near(24, 1e-9));
  const Moments notched = moments(alone(PolygonShape{{{-2, 1}, {2, 1}, {2, 5}, {0, 2}, {-2, 5}}}));
  CHECK(notched.area == near(10, 1e-9));
}

TEST_CASE("A strip of a tenth of a particle spacing is no void") {
  const Body<2> strip = alone(BoxShape{{-1, 1}, {1, 1.0125}});
  CHECK(strip.size() == 16);
  CHECK(moments(strip).area == near(2 * 0.0125, 1e-9));
}

TEST_CASE("What is cut out of a body is what the other has: the two fill the basin") {
  for (const double tilt : {0.0, 12.0, 45.0, 90.0}) {
    CAPTURE(tilt);
    const State<2> state = build_state<2>(basin_scene(tilt));
    const double bag = moments(state.bodies[1]).area, water = moments(state.bodies[0]).area;
    CHECK(bag == near(std::numbers::pi * 0.77 * 1.9, 1e-7));
    CHECK(bag + water == near(48, 1e-9));
  }
}

TEST_CASE("Jitter leaves the particles of cut sites in their body") {
  const PolygonShape triangle{{{-2, 1}, {2, 1.1}, {0.3, 4}}};
  const BoxShape film{{-2, 1.01}, {2, 1.03}};
  const HalfPlaneShape slope{{0, 3}, {1, 3}};
  for (const Shape& shape : {Shape{triangle}, Shape{film}, Shape{slope}}) {
    const Body<2> still = alone(shape), moved = alone(shape, 0.5);
    CAPTURE(shape.index());
    REQUIRE(moved.size() == still.size());
    std::size_t outside = 0, unmoved = 0;
    for (std::size_t p = 0; p < moved.size(); ++p) {
      const double x = moved.x[0][p], y = moved.x[1][p];
      if (!contains(shape, {x, y}) || std::abs(x) > 4 || y < 0) ++outside;
      if (x == still.x[0][p] && y == still.x[1][p]) ++unmoved;
      CHECK(moved.volume(p) == still.volume(p));
    }
    CHECK(outside == 0);
    CHECK(unmoved < moved.size() / 10);
  }
}

TEST_CASE("Jitter of whole sites is the plain random offset, also beside cut sites") {
  const Body<2> still = alone(BoxShape{{-4, 0}, {4, 6.01}}), moved = alone(BoxShape{{-4, 0}, {4, 6.01}}, 0.5);
  std::mt19937_64 generator(0);
  const auto next = [&] { return 2 * (static_cast<double>(generator() >> 11) / (1ULL << 53)) - 1; };
  for (std::size_t p = 0; p < 64 * 47; ++p)  // rows under the one at the surface
    for (int a = 0; a < 2; ++a) CHECK(moved.x[a][p] == near(still.x[a][p] + 0.5 * 0.125 * next(), 1e-12));
}
