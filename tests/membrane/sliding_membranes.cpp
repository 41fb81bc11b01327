// Membranes that slide over what is inside: friction of resting sand, mass and momentum, nodes evened out, the gauge.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "membrane/contents_pressure.hpp"
#include "membrane/even_out_nodes.hpp"
#include "membrane/membrane_force.hpp"
#include "membrane/outline.hpp"
#include "membrane/slide_membranes.hpp"
#include "membrane/tension_gauge.hpp"
#include "support/near.hpp"
#include "support/random_particles.hpp"
#include "support/small_state.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double stiffness = 1e6, cloth_density = 0.6;  ///< [N/m], [kg/m2]

double sum(const Array<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

/// A line through points, unstrained, that slides.
Membrane<2> line_through(const std::vector<std::array<double, 2>>& points, bool closed) {
  Membrane<2> m;
  m.name = "cloth";
  m.body = "sand";
  m.closed = closed;
  m.axial_stiffness = stiffness;
  m.gauge_length = 0.2;
  for (const auto& point : points)
    for (int a = 0; a < 2; ++a) m.x[a].push_back(point[a]);
  for (auto& v : m.v) v.assign(points.size(), 0.0);
  m.mass.assign(points.size(), 0.0);
  m.rest_length.assign(closed ? points.size() : points.size() - 1, 0.0);
  for (std::size_t s = 0; s < m.segments(); ++s) m.rest_length[s] = segment_length(m, s);
  m.mass[0] = cloth_density * sum(m.rest_length);
  share_mass(m);
  for (const double rest : m.rest_length) m.share.push_back(rest / sum(m.rest_length));
  m.strain.assign(m.segments(), 0.0);
  m.tension.assign(m.segments(), 0.0);
  m.contents_pressure.assign(points.size(), 0.0);
  m.gauge.sums.assign(gauge_slots * m.segments(), 0.0);
  return m;
}

Membrane<2> circle(std::size_t nodes, double radius) {
  std::vector<std::array<double, 2>> points;
  for (std::size_t k = 0; k < nodes; ++k) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(nodes);
    points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return line_through(points, true);
}

/// Sand below y = 0 with the same stress everywhere, and a cloth of 4 m on it.
State<2> sand_under_cloth(double vertical, double horizontal) {
  std::vector<std::array<double, 2>> places;
  for (int i = 0; i < 48; ++i)
    for (int j = 0; j < 4; ++j) places.push_back({0.0625 + 0.125 * i, -0.0625 - 0.125 * j});
  State<2> state;
  state.bodies = {body_at(small_scene().materials[1], places, 1600 * 0.125 * 0.125)};
  Body<2>& sand = state.bodies[0];
  sand.name = "sand";
  for (auto& component : sand.stress) component.assign(sand.size(), 0.0);
  std::fill(sand.stress[0].begin(), sand.stress[0].end(), -horizontal);
  std::fill(sand.stress[1].begin(), sand.stress[1].end(), -vertical);
  std::vector<std::array<double, 2>> points;
  for (int k = 0; k <= 64; ++k) points.push_back({1 + 0.0625 * k, 0.0});
  state.membranes = {line_through(points, false)};
  return state;
}

Grids<2> grid_of_quarter_metres() {
  GridSpec grid;
  grid.lower = {-4, -4};
  grid.upper = {8, 4};
  grid.spacing = 0.25;
  const std::vector<WallKind> slip(2, WallKind::slip);
  Grids<2> grids(1);
  grids[0].layout = GridLayout<2>(grid, WallsSpec{slip, slip});
  return grids;
}

/// Pulls the last node on by `way` in small steps, as the grid would.
void pull(State<2>& state, double way) {
  constexpr int steps = 400;
  const Grids<2> grids = grid_of_quarter_metres();
  MembraneSlide slide({0, 0});
  for (int step = 0; step < steps; ++step) {
    state.membranes[0].x[0].back() += way / steps;
    slide.slide(state, grids);
  }
  update_tension(state.membranes[0]);
}

}  // namespace

TEST_CASE("Cloth pulled over resting sand: T2 = T1 + mu p' s, with the pressure across the cloth") {
  for (const double mu : {0.2, 0.5}) {
    CAPTURE(mu);
    State<2> state = sand_under_cloth(20e3, 7e3);
    Membrane<2>& cloth = state.membranes[0];
    cloth.contents_friction = mu;
    // The length that slides, stretched: the way of its end is the integral of e / (1 + e), e = mu p' s / J.
    const double slides = 3, friction = mu * 20e3, rate = friction / stiffness;
    const double way = slides - std::log1p(rate * slides) / rate;
    pull(state, way);
    for (std::size_t k = 1; k < 64; ++k) CHECK(cloth.contents_pressure[k] == near(20e3, 1e-12));
    for (std::size_t s = 24; s < 63; ++s) {
      const double from_end = cloth.x[0].back() - 0.5 * (cloth.x[0][s] + cloth.x[0][s + 1]);
      CHECK(cloth.tension[s] == near(friction * (slides - from_end), 0.01));
      CHECK(cloth.tension[s + 1] - cloth.tension[s] ==
            near(friction * 0.5 * (cloth.x[0][s + 2] - cloth.x[0][s]), 0.005));
    }
    CHECK(cloth.tension[10] == 0);
    CHECK(sum(cloth.rest_length) == near(4.0, 1e-14));
  }
}

TEST_CASE(
    "Of the shear of water the sand under the cloth gets mu p' at most, a fluid nothing: the cloth bears the rest") {
  constexpr double limit = 6e3, spacing = 0.0625;  // mu p' [Pa], of nodes [m]
  struct Case {
    double contents_friction, shear, borne;  ///< [-], [Pa], [Pa]
    Shear law;
  };
  for (const auto& [mu, shear, borne, law] :
       {Case{0.3, 0.5 * limit, 0, Shear::wall_law}, Case{0.3, 1.5 * limit, 0.5 * limit, Shear::rough_wall},
        Case{0.3, -1.5 * limit, -0.5 * limit, Shear::no_slip}, Case{0, 200, 200, Shear::wall_law},
        Case{0, 200, 0, Shear::no_slip}}) {  // two fluids that stick to each other past the cloth
    CAPTURE(mu);
    CAPTURE(shear);
    State<2> state = sand_under_cloth(20e3, 7e3);
    Membrane<2>& cloth = state.membranes[0];
    cloth.contents_friction = mu;
    if (mu == 0) cloth.contents_pressure.clear();
    cloth.shear = law;
    cloth.water_shear.assign(cloth.segments(), shear);
    for (int step = 0; step < 50; ++step) {  // until the drag of sliding is gone
      MembraneSlide({0, 0}).slide(state, grid_of_quarter_metres());
      update_tension(cloth);
    }
    const std::size_t last = cloth.segments() - 1;  // slack gathers at the end that the water flows to
    for (std::size_t s = 0; s <= last; ++s) {
      const auto behind = static_cast<double>(borne > 0 ? last - s : s);
      CHECK(cloth.tension[s] == within(std::abs(borne) * spacing * behind, 1e-3 * std::abs(borne) + 1e-6));
    }
    for (std::size_t k = 1; k <= last; ++k) {
      const double handed_on = cloth.tension[k] - cloth.tension[k - 1] + shear * spacing;
      CHECK(handed_on == within((shear - borne) * spacing, 1e-3 * std::abs(shear) * spacing));
    }
  }
}

TEST_CASE("Sand with open voids presses on the cloth with what it bears between them") {
  State<2> state = sand_under_cloth(20e3, 7e3);
  Body<2>& sand = state.bodies[0];
  MohrCoulombWithVoids open{};
  open.density = 1600;
  open.tension_cutoff = 1e3;  // below the apex at 5196 Pa
  open.cohesion = 3e3;
  open.sin_phi = 0.5;
  open.cos_phi = std::sqrt(0.75);
  sand.material = open;
  sand.gap.assign(sand.size(), std::log(2.0));
  state.membranes[0].contents_friction = 0.5;
  pull(state, 1e-3);
  for (std::size_t k = 1; k < 64; ++k) CHECK(state.membranes[0].contents_pressure[k] == near(10e3, 1e-12));
}

TEST_CASE(
    "Inside a sharp membrane an empty corner presses on nothing, one half full of sand with half of its pressure") {
  State<2> state = sand_under_cloth(20e3, 7e3);
  Grids<2> grids = grid_of_quarter_metres();
  Grid<2>& grid = grids[0];
  grid.taken.assign(grid.layout.nodes(), 0.0);
  for_each_node(grid.layout, 0, [&](int cell, const std::array<int, 2>& at) {
    const double middle = grid.layout.node(1, at[1]);  // of the cell; what lies above y = 0 is another body's
    grid.taken[cell] = std::clamp(0.5 + middle / grid.layout.h, 0.0, 1.0);
  });
  Body<2>& sand = state.bodies[0];
  // Of each two columns one is there; from x = 4 m on all are, and beyond x = 5 m none.
  for (std::size_t p = 0; p < sand.size(); ++p) {
    const bool even = static_cast<int>(sand.x[0][p] / 0.125) % 2 == 0;
    if (sand.x[0][p] < 4 ? !even : sand.x[0][p] > 5) sand.mass[p] = 0;
  }
  ContentsPressure().update(state, grid, state.membranes[0]);
  const auto pressure_at = [&](double x) {
    return state.membranes[0].contents_pressure[static_cast<std::size_t>(std::lround((x - 1) / 0.0625))];
  };
  CHECK(pressure_at(2.5) == near(10e3, 1e-12));
  CHECK(pressure_at(4.5) == near(20e3, 1e-12));
  CHECK(pressure_at(5.0) == near(10e3, 1e-12));
}

TEST_CASE("Mass goes with the rest length; mass and momentum of the whole are kept") {
  Random random;
  State<2> state = sand_under_cloth(0, 0);
  for (const bool closed : {false, true}) {
    Membrane<2>& cloth = state.membranes[0];
    if (closed) cloth = circle(40, 1.0);
    for (auto& v : cloth.v)
      for (double& component : v) component = random.uniform(-1, 1);
    for (double& x : cloth.x[0]) x += random.uniform(-0.01, 0.01);
    double momentum[2] = {}, rest = sum(cloth.rest_length), mass = sum(cloth.mass);
    const Array<double> masses = cloth.mass;
    for (int a = 0; a < 2; ++a)
      for (std::size_t k = 0; k < cloth.nodes(); ++k) momentum[a] += cloth.mass[k] * cloth.v[a][k];
    cloth.contents_friction = closed ? 0 : 0.3;
    MembraneSlide({0, -9.81}).slide(state, grid_of_quarter_metres());
    CHECK(sum(cloth.rest_length) == near(rest, 1e-14));
    CHECK(sum(cloth.mass) == near(mass, 1e-14));
    double changed = 0;
    for (std::size_t k = 0; k < cloth.nodes(); ++k)
      changed = std::max(changed, std::abs(cloth.mass[k] / masses[k] - 1));
    CHECK(changed > 0.01);
    for (int a = 0; a < 2; ++a) {
      double now = 0;
      for (std::size_t k = 0; k < cloth.nodes(); ++k) now += cloth.mass[k] * cloth.v[a][k];
      CHECK(now == within(momentum[a], 1e-14 * mass));
    }
  }
}

TEST_CASE("What is rough on both sides holds the cloth, that outside with its force, or with what the grains bear") {
  constexpr double inside = 0.2, outside = 0.5, grains = 20e3, force = 50e3;  // [-], [-], [Pa], [Pa]
  for (const auto& [permeance, rubs] : {std::pair(0.0, force), {3e-5, grains}}) {
    State<2> state = sand_under_cloth(grains, 7e3);
    Membrane<2>& cloth = state.membranes[0];
    cloth.contents_friction = inside;
    cloth.permeance = permeance;
    RigidContact<2> rough;
    rough.touching = cloth.name;
    rough.friction = outside;
    state.rigid_contacts = {rough};
    for (auto& component : cloth.load) component.assign(cloth.nodes(), 0.0);
    cloth.load[1].assign(cloth.nodes(), -force * 0.0625);
    pull(state, 1e-3);
    const std::size_t last = cloth.segments() - 1;
    for (std::size_t s = last - 2; s < last; ++s)
      CHECK(cloth.tension[s + 1] - cloth.tension[s] ==
            near((inside * grains + outside * rubs) * 0.5 * (cloth.x[0][s + 2] - cloth.x[0][s]), 0.02));
  }
}

TEST_CASE("Cloth that passes whole nodes in a step takes their velocities along; no node gets faster than any was") {
  constexpr std::size_t nodes = 40, passes = 3;
  for (const double way : {1.0, -1.0}) {
    CAPTURE(way);
    State<2> state = sand_under_cloth(0, 0);
    Membrane<2>& cloth = state.membranes[0] = circle(nodes, 1.0);
    cloth.contents_friction = 0.3;
    RigidContact<2> rough;
    rough.touching = cloth.name;
    rough.friction = 0.5;
    state.rigid_contacts = {rough};
    // An even load along the line against the drag alone, z q = 1e-4 J q / l.
    const double load = way * 1e-4 * stiffness * passes;
    for (auto& component : cloth.load) component.assign(nodes, 0.0);
    for (std::size_t k = 0; k < nodes; ++k) {
      const auto along = tangent_at(cloth, k);
      for (int a = 0; a < 2; ++a) cloth.load[a][k] = load * along[a];
    }
    Random random;
    for (auto& v : cloth.v)
      for (double& component : v) component = random.uniform(-1, 1);
    const auto before = cloth.v;
    MembraneSlide({0, 0}).slide(state, grid_of_quarter_metres());
    for (std::size_t k = 0; k < nodes; ++k)
      for (int a = 0; a < 2; ++a)
        CHECK(cloth.v[a][k] == within(before[a][(k + nodes + (way > 0 ? -passes : passes)) % nodes], 1e-9));
  }
}

TEST_CASE("A hanging cloth over a fluid bears its own weight: T grows by it with the height") {
  std::vector<std::array<double, 2>> points;
  for (int k = 0; k <= 20; ++k) points.push_back({0.0, 0.1 * k});
  State<2> state = sand_under_cloth(0, 0);
  Membrane<2>& cloth = state.membranes[0] = line_through(points, false);
  cloth.contents_friction = 0;
  for (double& y : cloth.x[1]) y *= 1.001;
  MembraneSlide({0, -9.81}).slide(state, grid_of_quarter_metres());
  update_tension(cloth);
  CHECK(cloth.tension[19] - cloth.tension[0] == near(1.9 * cloth_density * 9.81, 1e-3));
}

TEST_CASE("Evening out keeps rest length, mass, momentum and area, and the shape of a circle") {
  Membrane<2> cloth = circle(60, 1.5);
  for (std::size_t k = 0; k < 60; ++k) {  // nodes drift towards one place, on the circle
    const double angle = 2 * std::numbers::pi * static_cast<double>(k) / 60, drifted = angle + 0.75 * std::sin(angle);
    cloth.x[0][k] = 1.5 * std::cos(drifted);
    cloth.x[1][k] = 1.5 * std::sin(drifted);
    cloth.v[0][k] = -cloth.x[1][k];
    cloth.v[1][k] = cloth.x[0][k];
    cloth.rest_length[k] *= 1 + 0.1 * std::cos(angle);
  }
  share_mass(cloth);
  REQUIRE(is_uneven(cloth));
  const Membrane<2> old = cloth;
  even_out_nodes(cloth);
  CHECK_FALSE(is_uneven(cloth));
  CHECK(sum(cloth.rest_length) == near(sum(old.rest_length), 1e-14));
  CHECK(sum(cloth.mass) == near(sum(old.mass), 1e-14));
  CHECK(signed_area(cloth.x[0], cloth.x[1]) == near(signed_area(old.x[0], old.x[1]), 1e-14));
  for (int a = 0; a < 2; ++a) {
    double momentum = 0, before = 0;
    for (std::size_t k = 0; k < 60; ++k) {
      momentum += cloth.mass[k] * cloth.v[a][k];
      before += old.mass[k] * old.v[a][k];
    }
    CHECK(momentum == within(before, 1e-14 * sum(old.mass)));
  }
  for (std::size_t k = 0; k < 60; ++k) {
    CHECK(std::hypot(cloth.x[0][k], cloth.x[1][k]) ==
          within(1.5, 0.006));  // of chords up to 0.28 m: a sagitta of 0.0065
    CHECK(cloth.v[0][k] == within(-cloth.x[1][k], 0.02));
  }
  // Rest length stays where it was along the line.
  CHECK(cloth.rest_length[30] / cloth.rest_length[0] > 2);
}

TEST_CASE("Evening out keeps the ends of an open line, and its straight parts to the bit of rounding") {
  Membrane<2> cloth = line_through({{0, 0}, {1, 0.5}, {2, 1}, {3, 1.5}, {4, 2}}, false);
  cloth.x = {Array<double>{0, 0.2, 0.6, 3.5, 4}, Array<double>{0, 0.1, 0.3, 1.75, 2}};
  REQUIRE(is_uneven(cloth));
  even_out_nodes(cloth);
  for (int k = 0; k < 5; ++k) CHECK(cloth.x[1][k] == within(0.5 * cloth.x[0][k], 1e-14));
  CHECK(cloth.x[0][0] == 0);
  CHECK(cloth.x[0][4] == near(4, 1e-15));
  CHECK_FALSE(is_uneven(cloth));
}

TEST_CASE("Nothing slides where an anchor grips the cloth; beyond, over water, one tension from grip to grip") {
  for (const double friction : {0.0, 0.3}) {
    CAPTURE(friction);
    constexpr std::size_t nodes = 40, grip = 6;  // 1.5 cells of four segments
    State<2> state = sand_under_cloth(0, 0);
    Membrane<2>& cloth = state.membranes[0] = circle(nodes, 1.0);
    cloth.contents_friction = friction;
    cloth.half_size = 0.125;
    Anchor<2> anchor;
    anchor.membrane = cloth.name;
    anchor.node = 37;  // grips the nodes from 31 to 3, round the end of the line
    state.anchors.push_back(anchor);
    Random random;
    for (double& rest : cloth.rest_length) rest *= random.uniform(0.97, 0.99);
    const Array<double> before = cloth.rest_length;
    MembraneSlide({0, 0}).slide(state, grid_of_quarter_metres());
    update_tension(cloth);
    for (std::size_t k = 0; k < 2 * grip; ++k) {
      const std::size_t s = (anchor.node - grip + k) % nodes;
      CHECK(cloth.rest_length[s] == before[s]);
    }
    CHECK(sum(cloth.rest_length) == near(sum(before), 1e-13));
    const double tension = cloth.tension[10];
    CHECK(tension == near(0.02 * stiffness, 0.2));
    const double drag = friction > 0 ? 1e-3 : 1e-6;  // that of sliding over sand without stress: some N/m
    for (std::size_t s = 3; s < 31; ++s) CHECK(cloth.tension[s] == near(tension, drag));
    CHECK(std::abs(cloth.tension[35] / tension - 1) > 1e-3);
  }
}

TEST_CASE("Evening out leaves held nodes and the rest length between them, and rounds no kink off") {
  // A square of 1 m with nodes that have drifted along its sides; two of its corners are held.
  std::vector<std::array<double, 2>> points;
  for (int k = 0; k < 40; ++k) {
    const double way = 0.1 * (k % 10), x = k < 10 ? way : k < 20 ? 1 : k < 30 ? 1 - way : 0;
    points.push_back({x, k < 10 ? 0 : k < 20 ? way : k < 30 ? 1 : 1 - way});
  }
  Membrane<2> cloth = line_through(points, true);
  const std::vector<std::size_t> held{10, 30};
  for (int k = 1; k < 5; ++k) {  // away from a corner that is held, and from one that is not
    cloth.x[1][10 + k] = 0.4 + 0.02 * k;
    cloth.x[0][20 + k] = 0.6 - 0.02 * k;
  }
  REQUIRE(is_uneven(cloth, held));
  const Membrane<2> old = cloth;
  even_out_nodes(cloth, held);
  CHECK_FALSE(is_uneven(cloth, held));
  const auto part = [](const Array<double>& values) {
    return std::accumulate(values.begin() + 10, values.begin() + 30, 0.0);
  };
  for (const std::size_t k : held)
    for (int a = 0; a < 2; ++a) CHECK(cloth.x[a][k] == within(old.x[a][k], 1e-15));
  CHECK(part(cloth.rest_length) == near(part(old.rest_length), 1e-14));
  CHECK(sum(cloth.rest_length) == near(sum(old.rest_length), 1e-14));
  CHECK(signed_area(cloth.x[0], cloth.x[1]) == near(signed_area(old.x[0], old.x[1]), 1e-13));
  // The side that leaves a held corner stays straight; the other corner is rounded off.
  CHECK(std::abs(cloth.x[0][11] - cloth.x[0][14]) < 1e-3);
  CHECK(std::abs(cloth.x[1][21] - cloth.x[1][24]) > 5e-3);
}

TEST_CASE("The gauge: means over 0.2 m and 10 ms, whatever the steps; a shorter burst counts by its time") {
  for (const double dt : {3e-4, 7e-4, 2.5e-3}) {
    CAPTURE(dt);
    Membrane<2> cloth = circle(100, 1.0);  // segments of 0.0628 m
    const double segment = cloth.rest_length[0];
    double t = 0;
    const auto run_to = [&](double end) {
      while (t < end - 1e-12) {
        const double step = std::min(dt, end - t);
        add_to_gauge(t, step, cloth);
        t += step;
      }
    };
    cloth.tension[40] = 1000;
    run_to(0.009);
    CHECK(cloth.gauge.now == 0);  // no whole time has passed
    run_to(0.0105);
    CHECK(cloth.gauge.now == near(1000 * segment / 0.2, 1e-12));
    cloth.tension[41] = cloth.tension[42] = cloth.tension[43] = 1000;
    run_to(0.0305);
    CHECK(cloth.gauge.now == near(1000, 1e-12));
    CHECK(cloth.gauge.peak_time == within(0.021, 1e-12));
    cloth.tension.assign(100, 0.0);
    cloth.tension[99] = cloth.tension[0] = 4000;
    run_to(0.0355);
    cloth.tension.assign(100, 0.0);
    run_to(0.0405);
    restart_peak(cloth.gauge);
    CHECK(cloth.gauge.peak == near(0.5 * 4000 * 2 * segment / 0.2, 1e-9));
    CHECK(cloth.gauge.peak_at[0] == within(1, 0.01));
    run_to(0.0605);
    CHECK(cloth.gauge.now == 0);
  }
}
