// Membranes on membranes and on their own folds: forces by hand, momentum, friction, and what must not touch.
#include "contact/membrane_contact.hpp"

#include <doctest/doctest.h>
#include <geodrop/step/pipeline.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "membrane/membrane_force.hpp"
#include "support/near.hpp"
#include "support/scene_files.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double dt = 0.01, stiffness = 2e5, reach = 0.2;
using Points = std::vector<std::array<double, 2>>;

Membrane<2> membrane_through(const std::string& name, const Points& points, bool closed) {
  Membrane<2> m;
  m.name = m.body = name;
  m.closed = closed;
  for (const auto& point : points)
    for (int a = 0; a < 2; ++a) m.x[a].push_back(point[a]);
  const std::size_t n = points.size(), segments = closed ? n : n - 1;
  for (auto* values : {&m.v, &m.load})
    for (auto& component : *values) component.assign(n, 0.0);
  m.mass.assign(n, 1.0);
  for (std::size_t s = 0; s < segments; ++s) {
    const auto &a = points[s], &b = points[(s + 1) % n];
    m.rest_length.push_back(std::hypot(b[0] - a[0], b[1] - a[1]));
  }
  return m;
}

/// From `from` to `to` in steps of about `spacing`.
Points line(std::array<double, 2> from, std::array<double, 2> to, double spacing) {
  const int steps = std::max(1, static_cast<int>(std::lround(std::hypot(to[0] - from[0], to[1] - from[1]) / spacing)));
  Points points;
  for (int k = 0; k <= steps; ++k)
    points.push_back({from[0] + (to[0] - from[0]) * k / steps, from[1] + (to[1] - from[1]) * k / steps});
  return points;
}

/// The sides of a closed polygon in steps of about `spacing`.
Points outline_of(const Points& corners, double spacing) {
  Points points;
  for (std::size_t c = 0; c < corners.size(); ++c) {
    const Points side = line(corners[c], corners[(c + 1) % corners.size()], spacing);
    points.insert(points.end(), side.begin(), side.end() - 1);
  }
  return points;
}

/// Two membranes that touch, the bodies on the left (1) or right (-1) of them.
State<2> touching(const Membrane<2>& a, const Membrane<2>& b, std::array<double, 2> outward, double friction) {
  State<2> state;
  state.membranes = {a, b};
  MembraneContact<2> contact{{a.name, b.name}, outward, friction, stiffness, 0, reach, {}};
  contact.slip = {Array<double>(a.nodes(), 0.0), Array<double>(b.nodes(), 0.0)};
  state.membrane_contacts = {contact};
  return state;
}

/// A membrane that may touch itself; its body is on the left.
State<2> folded(const Points& points) {
  State<2> state;
  state.membranes = {membrane_through("bag", points, true)};
  MembraneContact<2> contact{{"bag", "bag"}, {1, 1}, 0.3, stiffness, 0, reach, {}};
  contact.slip = {Array<double>(points.size(), 0.0), Array<double>(points.size(), 0.0)};
  state.membrane_contacts = {contact};
  return state;
}

void step(State<2>& state) {
  clear_membrane_loads(state);
  add_membrane_contacts(state, dt);
}

std::array<double, 2> resultant(const Membrane<2>& m) {
  return {std::accumulate(m.load[0].begin(), m.load[0].end(), 0.0),
          std::accumulate(m.load[1].begin(), m.load[1].end(), 0.0)};
}

/// Sum of the magnitudes of all loads [N].
double load_size(const State<2>& state) {
  double sum = 0;
  for (const auto& m : state.membranes)
    for (std::size_t k = 0; k < m.nodes(); ++k) sum += std::hypot(m.load[0][k], m.load[1][k]);
  return sum;
}

void set_velocity(Membrane<2>& m, double x, double y) {
  m.v[0].assign(m.nodes(), x);
  m.v[1].assign(m.nodes(), y);
}

constexpr double coarse = 0.05, fine = 0.04, depth = 1e-3, length = 4;

/// The second, 4 m long, is 1 mm deep in the first, which is 10 m long; their nodes do not match.
State<2> flat(double friction, double sink = depth) {
  return touching(membrane_through("ground", line({0, 0}, {10, 0}, coarse), false),
                  membrane_through("sheet", line({3, -sink}, {3 + length, -sink}, fine), false), {-1, 1}, friction);
}

/// Outlines that cross each other in many places, moving in all directions.
State<2> irregular(unsigned seed) {
  std::mt19937 engine(seed);
  const auto random = [&](double low, double high) { return std::uniform_real_distribution<>(low, high)(engine); };
  const auto star = [&](const char* name, double x, int nodes) {
    Points points;
    for (int k = 0; k < nodes; ++k) {
      const double angle = 2 * std::numbers::pi * k / nodes, radius = 1 + random(-0.08, 0.08);
      points.push_back({x + radius * std::cos(angle), radius * std::sin(angle)});
    }
    Membrane<2> m = membrane_through(name, points, true);
    for (auto& component : m.v)
      for (double& v : component) v = random(-1, 1);
    return m;
  };
  const Membrane<2> a = star("left", -0.95, 97), b = star("right", 0.95, 71);
  return touching(a, b, {1, 1}, 0.4);
}

}  // namespace

TEST_CASE("Flat membranes press with stiffness times depth times their common length, both half passes together") {
  State<2> state = flat(0);
  step(state);
  const double exact = stiffness * depth * length;
  const auto below = resultant(state.membranes[0]), above = resultant(state.membranes[1]);
  // Nodes of the ground count whole or not at all at the two ends of the sheet: half a pass, half a spacing each.
  CHECK(std::abs(above[1] - exact) < 1.001 * stiffness * depth * 0.5 * coarse);
  CHECK(below[1] == near(-above[1], 1e-12));
  CHECK(std::abs(above[0]) < 1e-12 * exact);
  CHECK(state.membrane_contacts[0].normal_force == near(above[1], 1e-12));
  CHECK(state.membrane_contacts[0].force[0] == near_zero(1e-12 * exact));
  CHECK(state.membrane_contacts[0].force[1] == near(below[1], 1e-12));
}

TEST_CASE("Each pass gives half: a node gets half its own length's force, and its share of the other's") {
  // A single segment over a node in the middle of long segments: both passes by hand.
  State<2> state = touching(membrane_through("ground", {{-0.1, 0}, {0.1, 0}, {0.3, 0}}, false),
                            membrane_through("sheet", {{-0.05, -depth}, {0.15, -depth}}, false), {-1, 1}, 0);
  step(state);
  const auto& ground = state.membranes[0].load[1];
  const auto& sheet = state.membranes[1].load[1];
  const double p = 0.5 * stiffness * depth;
  // Sheet's nodes, 0.1 m each: at 1/4 of the first segment, at 1/4 of the second.
  // Ground's middle node, 0.2 m: at 3/4 of the sheet. Its outer nodes lie beyond the ends of the sheet.
  CHECK(ground[0] == near(-p * 0.1 * 0.75, 1e-9));
  CHECK(ground[1] == near(-p * (0.1 * 0.25 + 0.1 * 0.75 + 0.2), 1e-9));
  CHECK(ground[2] == near(-p * 0.1 * 0.25, 1e-9));
  CHECK(sheet[0] == near(p * (0.1 + 0.2 * 0.25), 1e-9));
  CHECK(sheet[1] == near(p * (0.1 + 0.2 * 0.75), 1e-9));
}

TEST_CASE("No force with a gap, nor beyond the reach, nor on what waits to be placed") {
  State<2> apart = flat(0.3, -1e-6);
  step(apart);
  CHECK(load_size(apart) == 0);
  CHECK(apart.membrane_contacts[0].normal_force == 0);
  State<2> inside = flat(0.3, 0.9 * reach), beyond = flat(0.3, 1.1 * reach);
  step(inside);
  step(beyond);
  CHECK(load_size(inside) > 0);
  CHECK(load_size(beyond) == 0);
  Points ground = line({0, 0}, {10, 0}, coarse), sheet = line({3, -1.1 * reach}, {7, -1.1 * reach}, fine);
  ground.push_back({10, -1});  // also where their boxes overlap
  sheet.push_back({12, -1});
  sheet.push_back({12, 1});
  beyond = touching(membrane_through("ground", ground, false), membrane_through("sheet", sheet, false), {-1, 1}, 0);
  step(beyond);
  CHECK(load_size(beyond) == 0);
  State<2> waits = flat(0.3);
  waits.membranes[1].field = waiting;
  step(waits);
  CHECK(load_size(waits) == 0);
}

TEST_CASE("Contact adds to the loads that are there") {
  State<2> state = flat(0), more = flat(0);
  step(state);
  more.membranes[1].load[1].assign(more.membranes[1].nodes(), 7.0);
  add_membrane_contacts(more, dt);
  for (std::size_t k = 0; k < more.membranes[1].nodes(); ++k)
    CHECK(more.membranes[1].load[1][k] == near(7 + state.membranes[1].load[1][k], 1e-12));
}

TEST_CASE("Outlines that cross keep their momentum to round-off, also while they rub") {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    CAPTURE(seed);
    State<2> state = irregular(seed);
    for (int k = 0; k < 3; ++k) step(state);
    const double size = load_size(state);
    CHECK(size > 0);
    const auto left = resultant(state.membranes[0]), right = resultant(state.membranes[1]);
    CHECK(left[0] < 0);  // pushed apart
    for (int a = 0; a < 2; ++a) {
      CHECK(std::abs(left[a] + right[a]) < 1e-13 * size);
      CHECK(std::abs(state.membrane_contacts[0].force[a] - left[a]) < 1e-13 * size);
    }
  }
}

TEST_CASE("The order of the two names does not matter, but for round-off") {
  State<2> one = irregular(3), other = one;
  MembraneContact<2>& contact = other.membrane_contacts[0];
  std::swap(contact.between[0], contact.between[1]);
  std::swap(contact.outward[0], contact.outward[1]);
  std::swap(contact.slip[0], contact.slip[1]);
  for (int k = 0; k < 3; ++k) {
    step(one);
    step(other);
  }
  const double size = load_size(one);
  for (int m = 0; m < 2; ++m)
    for (int a = 0; a < 2; ++a)
      for (std::size_t k = 0; k < one.membranes[m].nodes(); ++k)
        CHECK(std::abs(one.membranes[m].load[a][k] - other.membranes[m].load[a][k]) < 1e-13 * size);
  for (int a = 0; a < 2; ++a)
    CHECK(std::abs(one.membrane_contacts[0].force[a] + other.membrane_contacts[0].force[a]) < 1e-13 * size);
}

TEST_CASE("Friction sticks as a spring, slips at mu times the normal force, and opposes the relative motion") {
  constexpr double mu = 0.5, speed = 0.02;  // 0.2 mm a step, slips from 0.5 mm on
  for (const double sense : {1.0, -1.0}) {
    CAPTURE(sense);
    State<2> state = flat(mu);
    set_velocity(state.membranes[0], 0.3, 0.1);  // both move: only the difference counts
    set_velocity(state.membranes[1], 0.3 + sense * speed, 0.1);
    for (int k = 1; k <= 2; ++k) {
      step(state);
      const double normal = state.membrane_contacts[0].normal_force;
      CHECK(resultant(state.membranes[1])[0] == near(-sense * normal * speed * dt * k / depth, 1e-9));
    }
    for (int k = 0; k < 5; ++k) step(state);
    const double limit = mu * state.membrane_contacts[0].normal_force;
    CHECK(resultant(state.membranes[1])[0] == near(-sense * limit, 1e-9));
    CHECK(resultant(state.membranes[0])[0] == near(sense * limit, 1e-9));
    // Turned round, the springs give back what the limit left of them, not all that they were dragged along.
    set_velocity(state.membranes[1], 0.3 - sense * speed, 0.1);
    step(state);
    CHECK(resultant(state.membranes[1])[0] == near(-sense * limit * (1 - 0.2 / 0.5), 1e-9));
  }
}

TEST_CASE("Membranes that let water through rub with the lesser of what the grains in both bear") {
  constexpr double mu = 0.5;
  for (const auto& [one, other, share] : {std::array{0.2, 0.6, 0.2}, {0.6, 0.2, 0.2}, {3.0, 3.0, 1.0}}) {
    State<2> state = flat(mu);
    for (const auto& [m, part] : {std::pair(&state.membranes[0], one), {&state.membranes[1], other}}) {
      m->permeance = 3e-5;
      m->contents_pressure.assign(m->nodes(), part * stiffness * depth);
    }
    set_velocity(state.membranes[1], 1, 0);
    step(state);
    CHECK(resultant(state.membranes[1])[0] == near(-mu * share * state.membrane_contacts[0].normal_force, 1e-9));
  }
}

TEST_CASE("Springs of nodes that let go are slack") {
  for (const double height : {1e-4, 5.0}) {  // nearby and far away
    CAPTURE(height);
    State<2> state = flat(0.5);
    set_velocity(state.membranes[1], 0.02, 0);
    step(state);
    CHECK(resultant(state.membranes[1])[0] < 0);
    state.membranes[1].x[1].assign(state.membranes[1].nodes(), height);
    step(state);
    CHECK(load_size(state) == 0);
    for (const auto& slip : state.membrane_contacts[0].slip)
      for (const double xi : slip) CHECK(xi == 0);
    state.membranes[1].x[1].assign(state.membranes[1].nodes(), -depth);
    set_velocity(state.membranes[1], 0, 0);
    step(state);
    CHECK(load_size(state) > 0);
    CHECK(resultant(state.membranes[1])[0] == 0);
  }
}

TEST_CASE("A body inside another does not touch it: their normals agree") {
  const Points outer = outline_of({{0, 0}, {2, 0}, {2, 2}, {0, 2}}, 0.1);
  const Points inner = outline_of({{0.05, 0.05}, {1.95, 0.05}, {1.95, 1.95}, {0.05, 1.95}}, 0.1);
  State<2> state =
      touching(membrane_through("outer", outer, true), membrane_through("inner", inner, true), {1, 1}, 0.3);
  step(state);
  CHECK(load_size(state) == 0);
  // The wall of a hole faces it: that the inner one does touch.
  state.membrane_contacts[0].outward[0] = -1;
  for (double& x : state.membranes[1].x[0]) x += 0.06;
  step(state);
  CHECK(resultant(state.membranes[1])[0] < 0);
}

TEST_CASE("The lips of a fold push each other apart") {
  // A C that opens to the right; its lips, 1 m long, have closed by 1 mm too much.
  const double gap = -depth;
  const Points corners = {{0, 0},      {0, -1},        {2, -1},        {2, -0.5 * gap}, {1, -0.5 * gap}, {0.5, -0.01},
                          {0.5, 0.01}, {1, 0.5 * gap}, {2, 0.5 * gap}, {2, 1},          {0, 1}};
  State<2> state = folded(outline_of(corners, 0.1));
  step(state);
  const Membrane<2>& bag = state.membranes[0];
  double upper = 0, lower = 0;
  for (std::size_t k = 0; k < bag.nodes(); ++k) (k < bag.nodes() / 2 ? lower : upper) += bag.load[1][k];
  CHECK(upper == near(stiffness * depth * 1.0, 6e-5));  // a spacing is 0.1 m, and their tips are corners
  CHECK(lower == near(-upper, 1e-9));
}

TEST_CASE("The flanks of a thin bag do not meet from inside") {
  for (const double thickness : {0.15, 0.05, 0.01}) {
    CAPTURE(thickness);
    State<2> state = folded(outline_of({{0, 0}, {2, 0}, {2, thickness}, {0, thickness}}, 0.05));
    step(state);
    CHECK(load_size(state) == 0);
  }
}

TEST_CASE("A wedge of a bag, thin near its edge, does not press on itself") {
  State<2> state = folded(outline_of({{0, 0}, {2, -0.3}, {2, 0.3}}, 0.05));
  step(state);
  CHECK(load_size(state) == 0);
}

TEST_CASE("Contacts from a scene: outward side of open skins, stiffness of the softer body, slack springs") {
  struct Case {
    std::string ground;
    double outward;
  };
  for (const Case& c : {Case{"[[0.0,1.03],[10.0,1.03]]", -1}, Case{"[[10.0,1.03],[0.0,1.03]]", 1}}) {
    CAPTURE(c.ground);
    const Scene scene = read_scene(source_path("tests/scenes/block_on_slab.toml"),
                                   {"membranes.ground.points=" + c.ground, "contacts.0.stiffness=0.5",
                                    "materials.soft={model='linear_elastic',density=900.0,youngs_modulus=1e6,"
                                    "poissons_ratio=0.25}",
                                    "bodies.slab.material=soft"});
    const State<2> state = build_state<2>(scene);
    REQUIRE(state.membrane_contacts.size() == 1);
    const MembraneContact<2>& contact = state.membrane_contacts[0];
    CHECK(contact.outward == std::array<double, 2>{1, c.outward});  // of "skin", of "ground"
    CHECK(contact.friction == 0.15);
    const double modulus = 1e6 * 0.75 / (1.25 * 0.5);
    CHECK(contact.stiffness == near(0.5 * modulus / 0.125, 1e-12));
    for (int m = 0; m < 2; ++m) {
      CHECK(contact.slip[m] == Array<double>(state.membranes[1 - m].nodes(), 0.0));
      CHECK(state.membranes[m].load[0].size() == state.membranes[m].nodes());
    }
  }
}

TEST_CASE("The outward side of a closed skin follows its sense") {
  const Scene scene = read_scene(source_path("tests/scenes/block_on_slab.toml"));
  State<2> state = build_state<2>(scene);
  CHECK(make_membrane_contact(scene, scene.contacts[0], state).outward[0] == 1);
  for (auto& component : state.membranes[1].x) std::reverse(component.begin(), component.end());
  CHECK(make_membrane_contact(scene, scene.contacts[0], state).outward[0] == -1);
}
