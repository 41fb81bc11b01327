// What else limits the time step, in closed form: eddies, and membranes that touch.
#include <doctest/doctest.h>
#include <geodrop/step/pipeline.hpp>

#include <cmath>

#include "step/stable_dt.hpp"
#include "support/near.hpp"
#include "support/random_particles.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double h = 0.2, courant = 0.5;

/// Bodies of water with c = 50 m/s, each with a membrane of no stiffness around it.
struct Case {
  Scene scene = box_scene<2>(10, h, WallKind::slip);
  State<2> state;
  GridLayout<2> layout{scene.grid, scene.walls};

  Body<2>& add_water(const std::string& name, double density) {
    Body<2> body = blank_body<2>(Newtonian{density, 2500 * density, 0}, 2);
    body.name = name;
    state.bodies.push_back(body);
    Membrane<2> membrane;
    membrane.name = name + " skin";
    membrane.body = name;
    state.membranes.push_back(membrane);
    return state.bodies.back();
  }
  double dt() const { return stable_dt(scene, state, layout); }
};

}  // namespace

TEST_CASE("Eddies add l sqrt(tau / rho) to the viscosity that limits the step, tau of the particle most sheared") {
  Case each;
  Body<2>& water = each.add_water("pool", 1000);
  water.material = Newtonian{1000, 2.5e6, 1000, 2.0};  // nu = 1 m2/s, l = 2 m
  water.stress[3] = {1e3, -4e3};                       // 2 m2/s of 1 kPa, 4 m2/s of 4 kPa
  CHECK(each.dt() == near(courant * h * h / (4 * 5), 1e-14));
  water.stress[3][1] = 0;
  CHECK(each.dt() == near(courant * h * h / (4 * 3), 1e-14));
  // tau^2 is half the square of the deviator: (4, -4) kPa along the axes are a shear of 4 kPa.
  water.stress[3] = {0, 0};
  water.stress[0][0] = 4e3;
  water.stress[1][0] = -4e3;
  CHECK(each.dt() == near(courant * h * h / (4 * 5), 1e-14));
}

TEST_CASE("Membranes that touch limit the step as two masses on one spring, 1/m = 1/m1 + 1/m2") {
  Case each;
  each.add_water("light", 1000);
  each.add_water("heavy", 3000);
  const double m = 750 * h;  // of 1000 h and 3000 h
  MembraneContact<2> contact{{"light skin", "heavy skin"}, {1, 1}, 0, 0, 0, h, {}};
  each.state.membrane_contacts = {contact};
  const auto dt = [&](double stiffness, double damping) {
    each.state.membrane_contacts[0].stiffness = stiffness;
    each.state.membrane_contacts[0].damping = damping;
    return each.dt();
  };
  CHECK(dt(0, 0) == near(courant * h / 50, 1e-14));
  CHECK(dt(5e7, 0) == near(std::sqrt(0.5 * m / 5e7), 1e-14));
  CHECK(dt(5e7, 1e5) == near(0.5 * m / 1e5, 1e-14));
  each.state.membrane_contacts[0].between = {"heavy skin", "light skin"};
  CHECK(dt(5e7, 0) == near(std::sqrt(0.5 * m / 5e7), 1e-14));
  each.state.membrane_contacts[0].between = {"light skin", "light skin"};  // its own folds
  CHECK(dt(5e7, 0) == near(std::sqrt(0.5 * 500 * h / 5e7), 1e-14));
}

TEST_CASE("A membrane limits the step together with the bodies of its velocity field, and no others") {
  Case each;
  each.add_water("bag", 1000);
  each.add_water("sea", 1000);
  State<2>& state = each.state;
  state.bodies[0].field = state.membranes[0].field = 1;
  state.bodies[1].material = Newtonian{1000, 1e7, 0};  // c = 100 m/s
  const auto dt = [&](double stiffness) {
    state.membranes[0].axial_stiffness = stiffness;
    return each.dt();
  };
  const auto at_speed = [](double square) { return courant * h / std::sqrt(square); };
  CHECK(dt(0) == near(at_speed(1e4), 1e-14));
  CHECK(dt(1000 * h * 7000) == near(at_speed(1e4), 1e-14));          // 2500 + 7000 in the bag
  CHECK(dt(1000 * h * 8000) == near(at_speed(2500 + 8000), 1e-14));  // the bag's is larger
  state.bodies[0].field = state.membranes[0].field = 0;              // all of them share the nodes
  CHECK(dt(1000 * h * 7000) == near(at_speed(1e4 + 7000), 1e-14));
  state.membranes[0].field = 2;  // and alone: J / (d rho h)
  CHECK(dt(1000 * h * 7000) == near(at_speed(1e4), 1e-14));
  CHECK(dt(1000 * h * 22000) == near(at_speed(11000), 1e-14));
}

TEST_CASE("Water that flows through a soil has a sixth of the square of its speed, as cells bear its pressure") {
  Scene scene = box_scene<2>(10, h, WallKind::slip);
  MohrCoulombSpec sand;
  sand.density = 1500;  // of grains, 2500 each
  sand.youngs_modulus = 1e7;
  sand.poissons_ratio = 0;
  sand.pores = CoupledSpec{0.4, 1e-4};
  scene.materials = {{"water", NewtonianSpec{1000, 2e6, 0}, {}}, {"sand", sand, {}}};
  scene.bodies.resize(2);
  scene.bodies[0].name = "pore water";
  scene.bodies[0].material = "water";
  scene.bodies[1].name = "soil";
  scene.bodies[1].material = "sand";
  scene.bodies[1].saturated_by = "pore water";
  State<2> state;
  state.bodies = {blank_body<2>(make_material(scene.materials[0]), 1),
                  blank_body<2>(make_material(scene.materials[1]), 1)};
  state.bodies[1].pressure = PressureSupport::cell;
  const double skeleton = 0.5e7 / 1500 + 1e7 / 3 / 1500 / 3, pores = 2e6 / 0.4 * (0.6 / 2500 + 0.4 / 1000);
  const double dt = stable_dt(scene, state, GridLayout<2>(scene.grid, scene.walls));
  CHECK(dt == near(courant * h / std::sqrt(skeleton + pores / 6), 1e-14));
}
