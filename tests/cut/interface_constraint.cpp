// What joins the two sides of a sharp interface, by hand: one normal velocity, the wall law, friction on a bed.
#include "cut/interface_constraint.hpp"

#include <doctest/doctest.h>
#include <geodrop/base/error.hpp>

#include <limits>
#include <string>

#include "support/join.hpp"
#include "support/near.hpp"
#include "support/sharp_box.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double dt = 1e-3, node_mass = 1000, speed = 0.4;

/// A tall bag, all cells full, nodes of 1000 kg. Its left side is where things happen: nodes from y = 5 to 7 do not
/// reach its lower and upper side.
SharpBox tall(Sense sense = Sense::anticlockwise) {
  SharpBox box({3.25, 8.25, 2.25, 9.75}, sense);
  box.fill_cells();
  for (Grid<2>& grid : box.grids) box.set_mass(grid, node_mass);
  return box;
}

/// The same velocity at the nodes beside the left side, from y = 5 to 7.
void move_left_side(Grid<2>& grid, double vx, double vy) {
  for (int j = 5; j <= 7; ++j)
    for (int i = 1; i <= 5; ++i) grid.velocity[grid.layout.index({i, j})] = Vec4{vx, vy, 0, 0};
}

/// Water slips upwards along the left side; the velocities have no normal gap anywhere.
SharpBox slipping(Shear shear, Sense sense = Sense::anticlockwise) {
  SharpBox box = tall(sense);
  box.skin().shear = shear;
  move_left_side(box.around(), 0, speed);
  return box;
}

/// The bag meets a bed that is all that is around it, at `approach` [m/s]; it slips upwards meanwhile.
SharpBox on_bed(double approach, double friction, double pore_pressure) {
  SharpBox box = tall();
  box.skin().bed = "pool";
  box.skin().bed_friction = friction;
  box.skin().bed_shear.assign(box.skin().segments(), 0.0);
  Body<2> lattice = lattice_body<2>(box.around().layout, LinearElastic{box_density, 2e6, 1e6}, 2);
  lattice.name = "pool";
  lattice.pore_pressure.assign(lattice.size(), pore_pressure);
  std::fill(lattice.mass.begin(), lattice.mass.end(), 0.25 * box_density);
  box.state.bodies[0] = lattice;
  move_left_side(box.inside(), -approach, speed);
  join(box.state, box.grids, dt);
  return box;
}

/// As on_bed, on a coupled bed: water in its pores around (field 0), n the share of it at the nodes, grains that have a
/// velocity of their own (field 2). Without gap n is 0.4.
SharpBox on_grains(double approach, double friction, double n = 0.4) {
  constexpr double grains_of_bed = 0.6, grain_density = 2.65;  // of that of water: pressure alone moves them less
  SharpBox box = tall();
  box.skin().bed = "bed";
  box.skin().bed_friction = friction;
  box.skin().bed_shear.assign(box.skin().segments(), 0.0);
  box.skin().bed_pressure.assign(box.skin().segments(), 0.0);
  Grid<2>& around = box.around();
  const std::size_t nodes = around.sum.size();
  Grid<2> grains = around;
  grains.field = 2;
  grains.pore_water = 0;
  grains.part_cells.clear();
  box.set_mass(around, n * node_mass);
  box.set_mass(grains, (1 - n) * grain_density * node_mass);
  around.pore_share.assign(nodes, n);
  around.node_drag.assign(nodes, 0.0);
  around.occupied.assign(nodes, grains_of_bed);
  for (Vec4& sum : around.sum) sum[2] = n;  // volume
  Body<2> bed = lattice_body<2>(around.layout, LinearElastic{box_density, 2e6, 1e6}, 2);
  bed.name = "bed";
  bed.field = 2;
  std::fill(bed.mass.begin(), bed.mass.end(), 0.25 * box_density);
  box.state.bodies.push_back(bed);
  box.grids.push_back(grains);
  move_left_side(box.inside(), -approach, speed);
  join(box.state, box.grids, dt);
  return box;
}

/// Traction on the membrane along y of the stretch at a height of the left side [Pa].
double shear_upwards(const SharpBox& box, double y, Sense sense = Sense::anticlockwise) {
  const double down = sense == Sense::anticlockwise ? -1 : 1;  // the way that nodes run on the left
  return down * box.state.membranes[0].water_shear[box.segment_at(3.25, y)];
}

double momentum_y(const Grid<2>& grid) {
  double sum = 0;
  for (std::size_t n = 0; n < grid.sum.size(); ++n) sum += grid.sum[n][3] * grid.velocity[n][1];
  return sum;
}

}  // namespace

TEST_CASE("Velocities that agree are left alone, and free slip is no reason to change anything") {
  SharpBox box = slipping(Shear::none);
  const Array<Vec4> before = box.around().velocity;
  join(box.state, box.grids, dt);
  for_each_node(box.around().layout, 0, [&](int node, const auto&) {
    for (int a = 0; a < 2; ++a) CHECK(box.around().velocity[node][a] == within(before[node][a], 1e-12));
  });
  for (const double p : box.skin().water_pressure) CHECK(p == near_zero(1e-6));
}

TEST_CASE("The wall law drags the membrane by 1/2 rho C_f u^2 the way that the water goes") {
  constexpr double C_f = 0.003;
  for (const Sense sense : {Sense::anticlockwise, Sense::clockwise}) {
    SharpBox box = slipping(Shear::wall_law, sense);
    box.skin().wall_friction = C_f;
    box.skin().contents_friction = 0.3;  // sand inside that takes next to nothing: the cloth bears the rest
    box.skin().contents_pressure.assign(box.skin().nodes(), 0.1);
    const double before = momentum_y(box.around());
    join(box.state, box.grids, dt);
    // From 5.5 to 6.5 all nodes that matter move at the full speed; from 3.5 to 4.5 node 5 alone, int N = 1/6.
    CHECK(shear_upwards(box, 6, sense) == near(0.5 * box_density * C_f * speed * speed, 1e-9));
    CHECK(shear_upwards(box, 4, sense) == near(0.5 * box_density * C_f * speed * speed / 36, 1e-9));
    CHECK(shear_upwards(box, 5, sense) == near(0.5 * box_density * C_f * speed * speed * 25 / 36, 1e-9));
    const double all = 0.5 * box_density * C_f * speed * speed * (1 + 2 * 25.0 / 36 + 2 / 36.0);
    CHECK(before - momentum_y(box.around()) == near(dt * all, 1e-8));
    CHECK(momentum_y(box.inside()) == near(dt * all, 1e-8));
  }
}

TEST_CASE("The wall law never does more than stop the slip") {
  SharpBox law = slipping(Shear::wall_law), sticks = slipping(Shear::no_slip);
  law.skin().wall_friction = 1e9;
  join(law.state, law.grids, dt);
  join(sticks.state, sticks.grids, dt);
  // Friction comes after the normal velocities were joined, sticking together with them: 1.9 % apart.
  for (const double y : {5.0, 6.0, 7.0}) {
    CHECK(shear_upwards(sticks, y) > 1e4);
    CHECK(shear_upwards(law, y) == near(shear_upwards(sticks, y), 0.03));
  }
}

TEST_CASE("Water that sticks drags a membrane over soil by mu p' at most, p' of the soil inside") {
  constexpr double mu = 0.3, inside = 2e3;
  SharpBox box = slipping(Shear::no_slip), firm = slipping(Shear::no_slip), sticks = slipping(Shear::no_slip);
  for (auto [limited, pressure] : {std::pair{&box, inside}, std::pair{&firm, 1e9}}) {
    limited->skin().contents_friction = mu;
    limited->skin().contents_pressure.assign(limited->skin().nodes(), pressure);
  }
  for (SharpBox* each : {&box, &firm, &sticks}) join(each->state, each->grids, dt);
  for (const double y : {5.0, 6.0, 7.0}) {
    CHECK(shear_upwards(box, y) == near(mu * inside, 1e-9));
    CHECK(shear_upwards(firm, y) == near(shear_upwards(sticks, y), 0.03));  // as under the wall law
  }
}

TEST_CASE("On a bed friction is mu times the effective pressure where it slips, against the slip") {
  constexpr double mu = 0.1, pore = 3e3;
  const SharpBox box = on_bed(0.5, mu, pore);
  for (const double y : {5.0, 6.0, 7.0}) {
    const double p = box.state.membranes[0].water_pressure[box.segment_at(3.25, y)];
    CHECK(p > 2e4);
    CHECK(shear_upwards(box, y) == near(-mu * (p - pore), 1e-9));
    const std::size_t segment = box.segment_at(3.25, y);
    CHECK(box.state.membranes[0].bed_shear[segment] == box.state.membranes[0].water_shear[segment]);
  }
}

TEST_CASE("A bed pushes but does not pull; a fluid pulls as much as it pushes") {
  const SharpBox lifted = on_bed(-0.5, 0.1, 0);
  for (const double p : lifted.state.membranes[0].water_pressure) CHECK(p >= 0);
  CHECK(lifted.state.membranes[0].water_pressure[lifted.segment_at(3.25, 6)] == 0);
  CHECK(lifted.grids[0].velocity[lifted.flat(2, 6)][0] == near_zero(0.05));
  SharpBox in_water = tall(), towards = tall();
  move_left_side(in_water.inside(), 0.5, 0);
  move_left_side(towards.inside(), -0.5, 0);
  join(in_water.state, in_water.grids, dt);
  join(towards.state, towards.grids, dt);
  const std::size_t middle = in_water.segment_at(3.25, 6);
  CHECK(in_water.skin().water_pressure[middle] < -2e4);
  CHECK(in_water.skin().water_pressure[middle] == near(-towards.skin().water_pressure[middle], 1e-6));
}

TEST_CASE("Grains of a coupled bed bear a bag beside the water in their pores, and rub") {
  constexpr double mu = 0.1, share = 0.4;
  const SharpBox box = on_grains(0.5, mu);
  const Membrane<2>& skin = box.state.membranes[0];
  for (const double y : {5.0, 6.0, 7.0}) {
    const std::size_t segment = box.segment_at(3.25, y);
    CHECK(skin.bed_pressure[segment] > 1e4);
    CHECK(skin.water_pressure[segment] > skin.bed_pressure[segment]);
    CHECK(shear_upwards(box, y) == near(-mu * skin.bed_pressure[segment], 1e-9));
    CHECK(skin.bed_shear[segment] == skin.water_shear[segment]);
  }
  const auto at_skin = [&](int field) {  // along x, at (3.25 m, 6 m)
    const auto at = [&](int i) { return box.grids[field].velocity[box.flat(i, 6)][0]; };
    return 0.03125 * at(2) + 0.6875 * at(3) + 0.28125 * at(4);
  };
  CHECK(at_skin(2) < -0.05);
  CHECK(share * at_skin(0) + (1 - share) * at_skin(2) == near(at_skin(2), 0.02));  // both go with the bag
  double momentum = 0;
  for (const Grid<2>& grid : box.grids)
    for (std::size_t n = 0; n < grid.sum.size(); ++n) momentum += grid.sum[n][3] * grid.velocity[n][0];
  CHECK(momentum == near(-15 * node_mass * 0.5, 1e-9));
}

TEST_CASE(
    "Grains push but do not pull, the water between them does both; grains that a gap parts from a bag are let be") {
  const SharpBox lifted = on_grains(-0.5, 0.1);
  for (const double p : lifted.state.membranes[0].bed_pressure) CHECK(p == near_zero(0.1));
  CHECK(lifted.state.membranes[0].water_pressure[lifted.segment_at(3.25, 6)] < -1e4);
  const SharpBox apart = on_grains(0.5, 0.1, 0.6);  // two thirds of a bed's grains: 0.3 m away
  for (const double p : apart.state.membranes[0].bed_pressure) CHECK(p == near_zero(0.1));
  CHECK(apart.state.membranes[0].water_pressure[apart.segment_at(3.25, 6)] > 1e4);
  CHECK(apart.grids[2].velocity[apart.flat(3, 6)][0] < -0.01);  // the pressure of the water moves both
}

TEST_CASE("Steps in which the pressures are not found are counted, and a hundred in a row end the run") {
  ConstraintWatch watch;
  for (int k = 0; k < 99; ++k) count_solution(false, 0, watch);
  CHECK(watch.unsolved == 99);
  count_solution(true, 0, watch);
  CHECK(watch.unsolved == 99);
  CHECK(watch.in_a_row == 0);
  for (int k = 0; k < 99; ++k) count_solution(false, 0, watch);
  CHECK_THROWS_AS(count_solution(false, 0, watch), RunError);
}

TEST_CASE("A traction that is not finite ends the run, with the membrane and the place") {
  SharpBox box = slipping(Shear::none);
  box.inside().velocity[box.inside().layout.index({4, 6})][0] = std::numeric_limits<double>::quiet_NaN();
  try {
    join(box.state, box.grids, dt);
    FAIL("no error");
  } catch (const RunError& error) {
    CAPTURE(error.what());
    CHECK(std::string(error.what()).find("'" + box.skin().name + "' is not finite at x = ") != std::string::npos);
  }
}
