// Membrane nodes on rigid ground: forces by hand, and what rests on it weighs what it should.
#include "contact/surface_contact.hpp"

#include <doctest/doctest.h>
#include <geodrop/step/pipeline.hpp>

#include <numeric>

#include "membrane/membrane_force.hpp"
#include "support/near.hpp"
#include "support/scene_files.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double dt = 0.01, stiffness = 2e5;

/// An open line of three nodes above, on and 1 mm inside level ground at y = 1; their lengths: 0.2, 0.35, 0.15 m.
State<2> line_on_ground(double friction) {
  Membrane<2> m;
  m.name = "sheet";
  m.closed = false;
  m.x = {Array<double>{0.5, 0.9, 1.2}, Array<double>{1.001, 1.0, 0.999}};
  for (auto* values : {&m.v, &m.load})
    for (auto& component : *values) component.assign(3, 0.0);
  m.mass.assign(3, 1.0);
  m.rest_length = {0.4, 0.3};
  RigidContact<2> contact;
  contact.touching = "sheet";
  contact.rigid = "ground";
  contact.friction = friction;
  contact.stiffness = stiffness;
  RigidBody<2> ground;
  ground.name = "ground";
  ground.half_plane = true;
  ground.from = ground.to = {0, 1};
  ground.normal = {0, 1};
  State<2> state;
  state.membranes = {m};
  state.rigid = {ground};
  state.rigid_contacts = {contact};
  return state;
}

/// One more step of contact; the load of the node that is inside.
std::array<double, 2> load_inside(State<2>& state) {
  clear_membrane_loads(state);
  add_contact_forces(state, dt);
  return {state.membranes[0].load[0][2], state.membranes[0].load[1][2]};
}

/// Steps until the run is over; true if that is because it has come to rest.
bool comes_to_rest(const Scene& scene, State<2>& state) {
  Grids<2> grid = make_grids<2>(scene);
  Pipeline<2> pipeline = build_pipeline<2>(scene);
  while (!is_over(scene, state)) advance(pipeline, state, grid);
  return state.t < scene.time.end;
}

/// Weight of all particles and membranes [N].
double weight(const Scene& scene, const State<2>& state) {
  double mass = 0;
  for (const auto& body : state.bodies) mass = std::accumulate(body.mass.begin(), body.mass.end(), mass);
  for (const auto& m : state.membranes) mass = std::accumulate(m.mass.begin(), m.mass.end(), mass);
  return -scene.gravity[1] * mass;
}

/// Sum of the contact forces [N].
std::array<double, 2> contact_force(State<2>& state) {
  clear_membrane_loads(state);
  add_contact_forces(state, 0);
  const RigidContact<2>& contact = state.rigid_contacts[0];
  return {contact.normal_force[0] + contact.friction_force[0], contact.normal_force[1] + contact.friction_force[1]};
}

}  // namespace

TEST_CASE("Penetration times stiffness times the node's length, straight up; no force with a gap") {
  State<2> state = line_on_ground(0);
  CHECK(load_inside(state)[1] == near(stiffness * 0.15 * 1e-3, 1e-12));
  for (int k = 0; k < 2; ++k)
    for (int a = 0; a < 2; ++a) CHECK(state.membranes[0].load[a][k] == 0);
  CHECK(state.membranes[0].load[0][2] == 0);
}

TEST_CASE("The length of a node is half of the segments beside it, also where a membrane closes") {
  State<2> state = line_on_ground(0);
  Membrane<2>& m = state.membranes[0];
  m.x[1].assign(3, 0.999);
  load_inside(state);
  const double open[] = {0.2, 0.35, 0.15};
  for (int k = 0; k < 3; ++k) CHECK(m.load[1][k] == near(stiffness * 1e-3 * open[k], 1e-11));
  m.closed = true;
  m.rest_length.push_back(0.8);
  load_inside(state);
  const double closed[] = {0.6, 0.35, 0.55};
  for (int k = 0; k < 3; ++k) CHECK(m.load[1][k] == near(stiffness * 1e-3 * closed[k], 1e-11));
}

TEST_CASE("Contact is as stiff as the line of a membrane that slides is long, wherever its slack cloth lies") {
  State<2> state = line_on_ground(0);
  Membrane<2>& m = state.membranes[0];
  m.x[1].assign(3, 0.999);
  m.share = {4.0 / 7, 3.0 / 7};
  m.rest_length = {0.4, 4.0};
  load_inside(state);
  const double line[] = {0.2, 0.35, 0.15};
  for (int k = 0; k < 3; ++k) CHECK(m.load[1][k] == near(stiffness * 1e-3 * line[k], 1e-11));
}

TEST_CASE("Contact adds to the loads that are there") {
  State<2> state = line_on_ground(0);
  clear_membrane_loads(state);
  state.membranes[0].load[1][2] = 7;
  add_contact_forces(state, dt);
  CHECK(state.membranes[0].load[1][2] == near(7 + stiffness * 0.15 * 1e-3, 1e-12));
}

TEST_CASE("A slope pushes along its normal, and drags along itself only") {
  State<2> state = line_on_ground(10);
  state.rigid[0].normal = {-0.6, 0.8};
  state.rigid[0].from = {1.2 - 0.6 * 1e-3, 0.999 + 0.8 * 1e-3};                    // the last node is 1 mm inside
  for (int k = 0; k < 2; ++k) state.membranes[0].x[0][k] = -5;                     // and the others are far outside
  state.membranes[0].v = {Array<double>{0, 0, -0.06}, Array<double>{0, 0, 0.08}};  // along the normal
  auto load = load_inside(state);
  const double push = stiffness * 0.15 * 1e-3;
  CHECK(load[0] == near(-0.6 * push, 1e-9));
  CHECK(load[1] == near(0.8 * push, 1e-9));
  state.membranes[0].v = {Array<double>{0, 0, 0.008}, Array<double>{0, 0, 0.006}};  // along the slope, 1 cm/s
  load = load_inside(state);
  const double drag = stiffness * 0.15 * 0.01 * dt;
  CHECK(load[0] == near(-0.6 * push - 0.8 * drag, 1e-9));
  CHECK(load[1] == near(0.8 * push - 0.6 * drag, 1e-9));
}

TEST_CASE("Friction sticks as a spring, slips at mu times the push, and always opposes the motion") {
  constexpr double mu = 0.5, spring = stiffness * 0.15, limit = mu * spring * 1e-3;
  for (const double sense : {1.0, -1.0}) {
    CAPTURE(sense);
    State<2> state = line_on_ground(mu);
    state.membranes[0].v[0][2] = sense * 0.02;  // 0.2 mm a step: slips from 0.5 mm on
    for (int step = 1; step <= 2; ++step) CHECK(load_inside(state)[0] == near(-sense * spring * 0.2e-3 * step, 1e-11));
    for (int step = 0; step < 20; ++step)
      if (step > 0)
        CHECK(load_inside(state)[0] == near(-sense * limit, 1e-11));
      else
        load_inside(state);
    CHECK(state.membranes[0].load[1][2] == near(spring * 1e-3, 1e-11));
    // Turned round, the spring gives back what the limit left of it, not all that it was dragged along.
    state.membranes[0].v[0][2] = -sense * 0.02;
    CHECK(load_inside(state)[0] == near(-sense * (limit - spring * 0.2e-3), 1e-11));
  }
}

TEST_CASE("A geotextile that lets water through rubs with what its grains bear, a tight one with all") {
  constexpr double mu = 0.5, length = 0.15, normal = stiffness * length * 1e-3, grains = 60;  // [N], [Pa]
  struct Case {
    double permeance;
    Array<double> pressure;
    double friction;
  };
  for (const Case& is : {Case{3e-5, {1e6, 1e6, grains}, mu * grains * length}, Case{3e-5, {0, 0, 1e6}, mu * normal},
                         Case{0, {1e6, 1e6, grains}, mu * normal}, Case{3e-5, {}, mu * normal}}) {
    State<2> state = line_on_ground(mu);
    state.membranes[0].permeance = is.permeance;
    state.membranes[0].contents_pressure = is.pressure;
    state.membranes[0].v[0][2] = 1;
    const auto load = load_inside(state);
    CHECK(load[0] == near(-is.friction, 1e-11));
    CHECK(load[1] == near(normal, 1e-11));
  }
}

TEST_CASE("A node that lets go forgets its spring") {
  State<2> state = line_on_ground(0.5);
  state.membranes[0].v[0][2] = 0.02;
  CHECK(load_inside(state)[0] < 0);
  state.membranes[0].x[1][2] = 1.0001;
  CHECK(load_inside(state)[0] == 0);
  CHECK(state.rigid_contacts[0].points.empty());
  state.membranes[0].x[1][2] = 0.999;
  state.membranes[0].v[0][2] = 0;
  CHECK(load_inside(state)[0] == 0);
}

TEST_CASE("A contact from a scene: unit normal, stiffness over the modulus of waves, slack springs") {
  const Scene scene =
      read_scene(source_path("tests/scenes/tube.toml"),
                 {"contacts.0.stiffness=0.5", "rigid.ground.shape.normal=[0.0, 7.0]", "grid.spacing=0.2"});
  const State<2> state = build_state<2>(scene);
  REQUIRE(state.rigid_contacts.size() == 1);
  const RigidContact<2>& contact = state.rigid_contacts[0];
  CHECK_FALSE(contact.bare);
  REQUIRE(state.rigid.size() == 1);
  CHECK(state.rigid[0].half_plane);
  CHECK(state.rigid[0].normal == std::array<double, 2>{0, 1});
  CHECK(state.rigid[0].from[1] == 0);
  CHECK(contact.friction == 0.3);
  CHECK(contact.stiffness == near(0.5 * 1200 * 100 * 100 / 0.2, 1e-12));
  CHECK(contact.points.empty());
  CHECK(state.membranes[0].load[0].size() == state.membranes[0].nodes());
}

TEST_CASE("A tube at rest on the ground weighs what it should") {
  const Scene scene =
      read_scene(source_path("tests/scenes/tube.toml"), {"grid.spacing=0.2", "pumps=[]", "time.end=20"});
  State<2> state = build_state<2>(scene);
  CHECK(comes_to_rest(scene, state));
  const std::array<double, 2> force = contact_force(state);
  CHECK(force[1] == near(weight(scene, state), 0.004));
  CHECK(std::abs(force[0]) < 0.01 * force[1]);
}

TEST_CASE("A flat tube that a pump fills and lifts comes to rest, and weighs what it should") {
  const Scene scene = read_scene(source_path("tests/scenes/tube.toml"),
                                 {"grid.spacing=0.2", "time.end=6", "bodies.fluid.shape.semi_axes=[2.0,0.4]",
                                  "bodies.fluid.shape.centre.1=0.4", "pumps.0.rate=1.0", "pumps.0.to=2.0"});
  State<2> state = build_state<2>(scene);
  const double before = weight(scene, state);
  CHECK(comes_to_rest(scene, state));
  CHECK(weight(scene, state) - before == near(1200 * 9.81 * 1.99, 1e-9));
  CHECK(contact_force(state)[1] == near(weight(scene, state), 0.003));
}

TEST_CASE("An elastic block at rest on the ground weighs what it should") {
  const Scene scene = read_scene(source_path("tests/scenes/block.toml"));
  State<2> state = build_state<2>(scene);
  CHECK(comes_to_rest(scene, state));
  CHECK(contact_force(state)[1] == near(weight(scene, state), 6e-5));
}
