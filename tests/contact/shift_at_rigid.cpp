// Particles of water on the surface of a rigid body: where contact acts, and the shift that they do not do.
#include "contact/shift_at_rigid.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "support/near.hpp"
#include "support/water_at_plane.hpp"

using namespace geodrop;
using namespace geodrop::test;

TEST_CASE("A uniform pressure of particles and the contact that bears it leave no force on any node") {
  WaterAtPlane it({"bodies.water.pressure=particle", "gravity=[0,0]", "bodies.water.initial_stress={type=\"zero\"}"});
  constexpr double pressure = 1e4, depth = 1e-7;
  const double bulk = 1000 * 40.0 * 40.0;
  Body<2>& water = it.state.bodies[0];
  for (double& J : water.J) J = 1 / (1 + pressure / bulk);
  for (std::size_t p = 0; p < water.size(); ++p) {
    water.x[0][p] -= depth;
    water.mass[p] /= water.J[p];  // volumes stay those of the lattice
  }
  RigidContact<2>& contact = it.state.rigid_contacts[0];
  contact.stiffness = pressure / depth;
  for (double& width : contact.half_width) width = 0.125 / 4;
  it.run_until("fold_walls");
  const double scale = pressure * it.grid.layout.h;
  for (int i = 2; i <= 7; ++i) {
    CAPTURE(i);
    for (int a = 0; a < 2; ++a) CHECK(std::abs(it.grid.force[it.grid.layout.index({i, 4})][a]) < 0.01 * scale);
  }
}

TEST_CASE("What touches does not shift along the normal, what does not touch shifts as it would") {
  WaterAtPlane it(at(0.53));
  it.run_until("held_shift");
  Body<2>& water = it.state.bodies[0];
  RigidContact<2>& contact = it.state.rigid_contacts[0];
  for (std::size_t k = 0; k < it.grid.velocity.size(); ++k)  // fuller to the right and upwards
    it.grid.velocity[k][3] = 0.01 * static_cast<double>(k % it.grid.layout.stride[1] + k / it.grid.layout.stride[1]);
  for (std::size_t p = 0; p < water.size(); ++p) water.v[0][p] = water.v[1][p] = 0;
  std::size_t touching = 0;
  for (std::size_t p = 0; p < water.size(); ++p)
    if (water.x[0][p] < 0.55 && std::abs(water.x[1][p] - 0.5) < 0.05) touching = p;
  water.x[0][touching] -= 1e-3;
  contact.points = {water.id[touching]};
  contact.side = {0};
  contact.slip = {0};
  const auto before = water.x, before_v = water.v;
  for (std::size_t p = 0; p < water.size(); ++p) water.affine[2][p] = 3;  // dv_y/dx [1/s]
  constexpr double dt = 1e-3, v0 = 1;
  find_held_shifts(it.state, it.grid, dt);
  CHECK(water.x == before);
  hold_shifts(it.state, it.grid);
  int moved = 0;
  for (std::size_t p = 0; p < water.size(); ++p) {
    CHECK(water.x[1][p] == before[1][p]);
    if (water.x[0][p] == before[0][p]) continue;
    ++moved;
    CHECK(water.id[p] == contact.points[0]);
    // The shift would be -h dt v0 dphi/dx = -dt v0 0.01, and v would follow by the shear.
    CHECK(water.x[0][p] - before[0][p] == near(dt * v0 * 0.01, 1e-6));
    CHECK(water.v[1][p] - before_v[1][p] == near(3 * dt * v0 * 0.01, 1e-6));
    CHECK(water.v[0][p] == before_v[0][p]);
  }
  CHECK(moved == 1);
}
