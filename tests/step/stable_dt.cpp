// The time step in closed form for each thing that limits it, and its two ways of failing.
#include <doctest/doctest.h>
#include <geodrop/base/error.hpp>
#include <geodrop/scene/velocity_fields.hpp>
#include <geodrop/step/pipeline.hpp>

#include <cmath>
#include <limits>

#include "grid/bases.hpp"
#include "step/stable_dt.hpp"
#include "support/near.hpp"
#include "support/random_particles.hpp"
#include "support/scene_files.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

/// h = 0.2 m, C = 0.5; one body of water with c = 50 m/s (K = 2.5 MPa).
struct Case {
  Scene scene = box_scene<2>(10, 0.2, WallKind::slip);
  State<2> state;
  GridLayout<2> layout{scene.grid, scene.walls};
  Case() { state.bodies = {blank_body<2>(Newtonian{1000, 2.5e6, 0}, 1)}; }
  double dt() const { return stable_dt(scene, state, layout); }
};

std::string error_of(const Case& each) {
  try {
    each.dt();
  } catch (const RunError& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("dt = C h / (c + v)") {
  Case each;
  CHECK(each.dt() == near(0.5 * 0.2 / 50, 1e-14));
  each.state.v_max = 30;
  CHECK(each.dt() == near(0.5 * 0.2 / 80, 1e-14));
  each.scene.solver.courant = 0.25;
  CHECK(each.dt() == near(0.25 * 0.2 / 80, 1e-14));
}

TEST_CASE("The most strained particle of a neo-Hookean body sets the step") {
  Case each;
  const NeoHookean rubber{1000, 2e6, 1e6};
  Body<2> body = blank_body<2>(rubber, 3);
  for (int c = 0; c < 4; ++c) body.deformation[c].assign(3, c % 3 == 0 ? 1.0 : 0.0);
  each.state.bodies = {body};
  CHECK(each.dt() == near(0.5 * 0.2 / std::sqrt(3e6 / 1000), 1e-14));  // lambda + mu
  // Stretched twice along y: d rho c^2 = d lambda + |mu - lambda ln 2| + mu 2^2.
  each.state.bodies[0].deformation[3][1] = each.state.bodies[0].J[1] = 2;
  const double modulus = 2e6 + (2e6 * std::log(2.0) - 1e6 + 4e6) / 2;
  CHECK(each.dt() == near(0.5 * 0.2 / std::sqrt(modulus / 1000), 1e-14));
  // Squeezed to a half: d lambda + |mu + lambda ln 2| + mu across.
  each.state.bodies[0].deformation[3][1] = each.state.bodies[0].J[1] = 0.5;
  CHECK(each.dt() == near(0.5 * 0.2 / std::sqrt((2e6 + (1e6 + 2e6 * std::log(2.0) + 1e6) / 2) / 1000), 1e-14));
}

TEST_CASE("The stiffest body sets the step: of an undrained soil G + (K + K_f/n) / 3 where cells bear its pressure") {
  Case each;
  each.state.bodies.push_back(blank_body<2>(MohrCoulomb{2000, 6e6, 3e6, 0, 0.5, 0.8, 0, 0, 40e6}, 1));
  each.state.bodies[1].pressure = PressureSupport::cell;
  CHECK(each.dt() == near(0.1 / std::sqrt((3e6 + 46e6 / 3) / 2000), 1e-14));
  each.state.bodies[1].pressure = PressureSupport::particle;
  CHECK(each.dt() == near(0.1 / std::sqrt((46e6 + 1e6) / 2000), 1e-14));  // K + G / 3
  each.state.bodies[1].implicit_pores = {0};
  CHECK(each.dt() == near(0.1 / std::sqrt((6e6 + 1e6) / 2000), 1e-14));
}

TEST_CASE("Without the bound of splines and lumped masses, waves and membranes add up: K + 4/3 G, J / (rho h)") {
  Case each;
  each.state.bodies.push_back(blank_body<2>(MohrCoulomb{2000, 6e6, 3e6, 0, 0.5, 0.8, 0, 0, 40e6}, 1));
  Membrane<2> membrane;
  membrane.axial_stiffness = 1e6;
  each.state.bodies[1].name = membrane.body = "bag";
  each.state.membranes = {membrane};
  each.state.bodies[1].pressure = PressureSupport::cell;
  const double dt = 0.1 / std::sqrt((6e6 + 4e6 + 40e6) / 2000 + 1e6 / (2000 * 0.2));
  each.scene.solver.mass_matrix = MassMatrix::consistent;
  CHECK(each.dt() == near(dt, 1e-14));
  each.scene.solver.mass_matrix = MassMatrix::lumped;
  CHECK(each.dt() > 1.3 * dt);
  each.scene.grid.basis = Basis::gimp;
  CHECK(each.dt() == near(dt, 1e-14));
}

TEST_CASE(
    "The consistent mass beside membranes doubles the bound of the square of solids and membranes, not of fluids") {
  Case each;
  Membrane<2> membrane;
  membrane.axial_stiffness = 1e6;
  membrane.body = "bag";
  each.state.membranes = {membrane};
  each.state.bodies[0].name = "bag";
  const auto consistent = [&] {
    Case same = each;
    same.scene.solver.mass_matrix = MassMatrix::consistent_at_membranes;
    return same.dt();
  };
  const double cloth = 1e6 / (1000 * 0.2);
  CHECK(each.dt() == near(0.1 / std::sqrt(2500 + cloth), 1e-14));
  CHECK(consistent() == near(0.1 / std::sqrt(2500 + 2 * cloth), 1e-14));
  each.state.bodies = {blank_body<2>(LinearElastic{2000, 6e6, 3e6}, 1)};
  each.state.bodies[0].name = "bag";
  CHECK(consistent() == near(each.dt() / std::sqrt(2.0), 1e-14));
  each.state.membranes.clear();
  CHECK(consistent() == near(each.dt() / std::sqrt(2.0), 1e-14));
}

TEST_CASE("What waits for its stage limits the step as what is there") {
  Case each;
  each.state.bodies = {blank_body<2>(LinearElastic{2000, 6e6, 3e6}, 1)};
  const double there = each.dt();
  Membrane<2> membrane;
  membrane.axial_stiffness = 1;
  membrane.body = each.state.bodies[0].name = "bag";
  each.state.membranes = {membrane};
  each.state.bodies[0].field = each.state.membranes[0].field = waiting;
  CHECK(each.dt() == near(there, 1e-5));
  each.scene.solver.mass_matrix = MassMatrix::consistent_at_membranes;
  CHECK(each.dt() == near(there, 1e-5));
}

TEST_CASE("Bodies with water in their pores, and that water, keep the lumped mass and its limit") {
  const Scene scene = read_scene(source_path("cases/verification/saturated_bag_rests.toml"),
                                 {"solver.mass_matrix=consistent_at_membranes"});
  const std::vector<int> fields = velocity_fields(scene);
  const StepLimits limits(scene);
  for (std::size_t b = 0; b < fields.size(); ++b) {
    const bool around = scene.bodies[b].name == "water" || scene.bodies[b].name == "ground";
    CHECK(limits.inverse_mass[fields[b]] == (around ? 2 : 1));
  }
}

TEST_CASE("A membrane adds J / (rho h) of the body that it lies on to the stiffness along it") {
  Case each;
  each.state.bodies.push_back(blank_body<2>(MohrCoulomb{1600, 1e6, 6e5, 0, 0.5, 0.8, 0, 0, 0}, 1));
  each.state.bodies[1].name = "bag";
  Membrane<2> membrane;
  membrane.body = "bag";
  membrane.axial_stiffness = 1e6;
  each.state.membranes = {membrane};
  const double a = 1e6 / (1600 * 0.2);
  CHECK(each.dt() == near(0.1 / std::sqrt(2500 + a), 1e-14));  // of the water in the same field
  each.state.bodies.erase(each.state.bodies.begin());
  each.state.bodies[0].pressure = PressureSupport::cell;
  // Of the soil alone, K borne by cells: lambda = -2/3 G.
  const double G = 6e5 / 1600, lambda = -2.0 / 3 * G;
  const double both = lambda + 2 * G + a / 2 + std::sqrt(lambda * lambda + a * a / 4);
  CHECK(each.dt() == near(0.1 / std::sqrt(1e6 / 1600 / 3 + both / 2), 1e-14));
}

TEST_CASE("Penalties limit the step to h / (c sqrt(2 stiffness)), their damping to h / (2 c damping)") {
  Case each;
  RigidContact<2> contact;
  contact.touching = "body";
  contact.bare = true;
  each.state.rigid_contacts = {contact};
  const double P = 2.5e6, impedance = 1000 * 50, h = 0.2;
  const auto dt = [&](double stiffness, double damping) {
    each.state.rigid_contacts[0].stiffness = stiffness * P / h;
    each.state.rigid_contacts[0].damping = damping * impedance;
    return each.dt();
  };
  CHECK(dt(1, 1) == near(0.5 * h / 50, 1e-14));  // Courant's step is as short
  CHECK(dt(4, 0) == near(h / 50 / std::sqrt(8), 1e-14));
  each.scene.solver.courant = 1;
  CHECK(dt(1, 0) == near(h / 50 / std::sqrt(2), 1e-14));
  CHECK(dt(0.1, 0.8) == near(h / 50 / 1.6, 1e-14));
}

TEST_CASE("The fastest point of a rigid body counts as a particle does, if the body is there") {
  Case each;
  RigidBody<2> body;
  body.from = {0, 0};
  body.to = {0, 2};
  body.angle_rate = 5;  // about the origin
  each.state.rigid = {body};
  CHECK(each.dt() == near(0.5 * 0.2 / 60, 1e-14));
  each.state.v_max = 14;
  CHECK(each.dt() == near(0.5 * 0.2 / 64, 1e-14));
  each.state.v_max = 4;
  each.state.rigid[0].present = false;
  CHECK(each.dt() == near(0.5 * 0.2 / 54, 1e-14));
}

TEST_CASE("A viscous fluid limits the step by h^2 / nu") {
  // Diffusion on a grid is stable up to h^2 / (2 d nu), d = 2; Courant's share of it.
  Case each;
  each.state.bodies = {blank_body<2>(Newtonian{1000, 2.5e6, 4e4}, 1)};
  CHECK(each.dt() == near(0.5 * 0.04 / (4 * 40), 1e-14));
}

TEST_CASE("Damping shortens the step by sqrt(1 + xi^2) - xi") {
  Case each;
  each.state.damping_rate = 3000;
  const double dt = 0.002, xi = 3000 * dt / 4;  // xi = beta / (2 omega), omega = 2 / dt
  CHECK(each.dt() == near(dt * (std::sqrt(1 + xi * xi) - xi), 1e-14));
}

TEST_CASE("A speed that is not finite is an error of the run, with step and time") {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    Case each;
    each.state.v_max = bad;
    each.state.step = 4711;
    CHECK(error_of(each).find("not finite") != std::string::npos);
    CHECK(error_of(each).find("step 4711") != std::string::npos);
  }
}

TEST_CASE("The error of a velocity that is not finite names the first particle that has one") {
  Case each;
  each.state.bodies = {blank_body<2>(Newtonian{1000, 2.5e6, 0}, 5)};
  Body<2>& body = each.state.bodies[0];
  body.name = "bag";
  for (std::uint32_t p = 0; p < 5; ++p) body.id[p] = 40 + p;
  body.v[1][3] = body.v[0][4] = each.state.v_max = std::nan("");
  body.J[3] = 0.125;
  CHECK(error_of(each).find("'bag', particle id 43 (J = 0.125, x =") != std::string::npos);
}

TEST_CASE("A time step that would never reach the end is an error of the run") {
  Case each;
  each.state.v_max = 1e14;
  CHECK(error_of(each).find("collapsed") != std::string::npos);
  each.state.v_max = 1e3;
  CHECK(error_of(each).empty());
}

TEST_CASE("On graded axes the finest cell limits the step") {
  Case each;
  each.scene.grid.refine = {{0, 0.5, 1.5, 0.05, 1.2, {}}};
  each.layout = GridLayout<2>(each.scene.grid, each.scene.walls);
  CHECK(each.layout.finest == finest_spacing(each.scene.grid));
  CHECK(each.dt() == near(0.5 * each.layout.finest / 50, 1e-14));
  CHECK(each.dt() == near(0.5 * 0.05 / 50, 0.05));
}

namespace {

/// Largest sum of N'^2 / N of the splines of an axis, over places in a span [1/m2].
template <class SplinesAt>
double steepest(double low, double high, SplinesAt&& splines_at) {
  constexpr int places = 1000;
  double most = 0;
  for (int k = 1; k < places; ++k) {
    const double x = low + (high - low) * k / places;
    const ThreeWeights n = splines_at(x);
    most = std::max(most, n.g0 * n.g0 / n.w0 + n.g1 * n.g1 / n.w1 + n.g2 * n.g2 / n.w2);
  }
  return most;
}

}  // namespace

TEST_CASE("Quadratic splines: sum N'^2/N <= 6/h^2 along an axis bounds the frequency of any particles") {
  // Each particle alone has w^2 = K V sum |grad N|^2 / (N m) <= 6 d c^2 / h^2, and nodes that share particles no more.
  const double even = steepest(-0.5, 0.5, [](double r) { return Bspline2::at(r, 0); });
  CHECK(even <= 6);
  CHECK(even == near(6, 0.01));
  CHECK(2 / std::sqrt(6.0 * 2) == near(0.577, 1e-3));
  CHECK(2 / std::sqrt(6.0 * 3) == near(0.471, 1e-3));
  // The defaults are below; a scene says 0.5 and 0.45 where it says nothing.
  CHECK(read_scene(source_path("cases/hydrostatic_column.toml")).solver.courant < 2 / std::sqrt(12.0));
  CHECK(read_scene(source_path("cases/hydrostatic_column_3d.toml")).solver.courant < 2 / std::sqrt(18.0));
}

TEST_CASE("On graded axes the bound holds with the finest cell") {
  const Scene scene = graded_scene<2>(12, 0.25, WallKind::slip);
  const GridLayout<2> layout(scene.grid, scene.walls);
  for (int a = 0; a < 2; ++a)
    for (int i = 1; i < layout.cells[a]; ++i) {
      const KnotSpan& span = layout.knots[a][i + GridLayout<2>::pad];
      const double middle = layout.node(a, i), half = span.width / 2;
      const double most = steepest(middle - half, middle + half, [&](double x) { return GradedBspline2::at(span, x); });
      CHECK(most <= 6 / (layout.finest * layout.finest));
    }
}
