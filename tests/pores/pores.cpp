// Water in the pores of a soil, one step at a time: what the pair of velocity fields keeps.
#include "pores/pores.hpp"

#include <geodrop/base/find_named.hpp>
#include <geodrop/step/pipeline.hpp>

#include <doctest/doctest.h>

#include <numeric>
#include <random>

#include "grid/blocks.hpp"
#include "grid/cell_pressure.hpp"
#include "support/near.hpp"
#include "support/scene_files.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

const std::string column = source_path("cases/verification/terzaghi.toml");

/// Terzaghi's column with free water above, as it is before a step, each particle at a speed of its own.
struct Column {
  Scene scene;
  State<2> state;
  Grids<2> grids;
  Pipeline<2> rows;
  std::vector<PoreSoil> soils;
  StepContext step;
  std::size_t next = 0;  ///< row

  explicit Column(const std::vector<std::string>& settings = {}, double speed = 0.1)
      : scene(read_scene(column, settings)),
        state(build_state<2>(scene)),
        grids(make_grids<2>(scene)),
        rows(build_pipeline<2>(scene)),
        soils(pore_soils(scene)) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-speed, speed);
    for (Body<2>& body : state.bodies)
      for (Array<double>& component : body.v)
        for (double& v : component) v = any(random);
  }

  Grid<2>& soil() { return grids[soils[0].field]; }
  Grid<2>& water() { return grids[soils[0].water]; }
  const Body<2>& body(const std::string& name) const { return find_named(state.bodies, name); }

  /// Goes on with the rows of a step up to the one of that name, which does not run.
  void run_until(const std::string& name) {
    for (; next < rows.size() && rows[next].name != name; ++next) rows[next].run(state, grids, step);
  }

  template <class F>
  void for_nodes(F f) {
    for_each_active_real_row(water(), [&](int begin, int count, const std::array<int, 2>&) {
      for (int flat = begin; flat < begin + count; ++flat) f(flat);
    });
  }
  Vec4 momentum() {
    Vec4 sum{};
    for_nodes([&](int i) { sum += soil().sum[i][3] * soil().velocity[i] + water().sum[i][3] * water().velocity[i]; });
    return sum;
  }
  double kinetic_energy() {
    double sum = 0;
    for (const Grid<2>* grid : {&soil(), &water()})
      for_nodes([&](int i) {
        for (int a = 0; a < 2; ++a) sum += 0.5 * grid->sum[i][3] * std::pow(grid->velocity[i][a], 2);
      });
    return sum;
  }
};

double total(const Array<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

}  // namespace

TEST_CASE("Drag is an impulse and its opposite: it keeps momentum and takes energy") {
  for (const std::string k : {"1e-1", "1e-3", "1e-7"}) {
    CAPTURE(k);
    Column run({"materials.soil.hydraulic_conductivity=" + k});
    run.run_until("pore_drag");
    const Vec4 before = run.momentum();
    const double energy = run.kinetic_energy();
    drag_pore_water(run.soils, run.step.dt, run.grids);
    const Vec4 after = run.momentum();
    const double size = std::hypot(before[0], before[1]);
    REQUIRE(size > 0);
    for (int a = 0; a < 2; ++a) CHECK(after[a] == within(before[a], 1e-12 * size));
    CHECK(run.kinetic_energy() < energy);
  }
}

TEST_CASE("Drag without end joins both velocities, drag of Darcy slows them by hand") {
  Column run({"materials.soil.hydraulic_conductivity=1e-3"});
  run.run_until("pore_drag");
  const int inside = run.water().layout.index({2, 10});
  const double of_water = run.water().sum[inside][3], of_soil = run.soil().sum[inside][3];
  // h^2 = 0.0025 m2 with n = 0.4: 0.4 1000 and 1590 kg/m3; n^2 gamma_w / k = 0.16 9810 / 1e-3 N s/m4
  CHECK(of_water == near(0.4 * 0.0025 * 1000, 1e-4));
  CHECK(of_soil == near(1590 * 0.0025, 1e-4));
  CHECK(run.water().node_drag[inside] == near(0.16 * 9810 / 1e-3 * 0.0025, 1e-4));
  const double before = run.water().velocity[inside][0] - run.soil().velocity[inside][0];
  drag_pore_water(run.soils, run.step.dt, run.grids);
  const double rate = 0.16 * 9810 / 1e-3 * (1 / 400.0 + 1 / 1590.0);
  const double after = run.water().velocity[inside][0] - run.soil().velocity[inside][0];
  CHECK(after == near(before / (1 + run.step.dt * rate), 1e-4));
  for (Vec4& v : run.water().velocity) v[0] += 1;
  for (double& drag : run.water().node_drag) drag *= 1e20;
  drag_pore_water(run.soils, run.step.dt, run.grids);
  CHECK(run.water().velocity[inside][0] == near(run.soil().velocity[inside][0], 1e-12));
}

TEST_CASE("Forchheimer's drag solves its quadratic equation, keeps momentum and grows with the speed") {
  Column run({"materials.soil.hydraulic_conductivity=1e-1", "materials.soil.forchheimer_coefficient=300"});
  run.run_until("pore_drag");
  const int inside = run.water().layout.index({2, 10});
  // n^3 gamma_w b of a full cell of 0.05 m
  CHECK(run.water().node_inertial_drag[inside] == near(0.064 * 9810 * 300 * 0.0025, 1e-4));
  const double c = run.water().node_drag[inside], b = run.water().node_inertial_drag[inside];
  const double lightness = 1 / run.water().sum[inside][3] + 1 / run.soil().sum[inside][3];
  const auto speed = [&] {
    const Vec4 w = run.water().velocity[inside] - run.soil().velocity[inside];
    return std::hypot(w[0], w[1]);
  };
  for (const double faster : {1.0, 1e3}) {
    for (Vec4& v : run.water().velocity) v *= faster;
    const double before = speed();
    const Vec4 momentum = run.momentum();
    drag_pore_water(run.soils, run.step.dt, run.grids);
    const Vec4 after = run.momentum();
    for (int a = 0; a < 2; ++a) CHECK(after[a] == within(momentum[a], 1e-12 * std::hypot(momentum[0], momentum[1])));
    // (1 + dt L (c + b w)) w = w before
    CHECK((1 + run.step.dt * lightness * (c + b * speed())) * speed() == near(before, 1e-12));
  }
}

TEST_CASE("An even pressure moves nothing where the porosity jumps") {
  Column run({"grid.upper=[0.2, 1.2]", "bodies.soil.initial_stress.pressure=0",
              "bodies.free_water.initial_stress={type='uniform',pressure=100.0}"},
             0);
  run.run_until("grid_to_particles");
  double fastest = 0, jump = 0;
  run.for_nodes([&](int i) {
    for (const Grid<2>* grid : {&run.soil(), &run.water()})
      for (int a = 0; a < 2; ++a) fastest = std::max(fastest, std::abs(grid->velocity[i][a]));
    jump = std::max(jump, run.water().pore_share[i]);
  });
  CHECK(jump == near(1, 1e-12));
  // dt p / (rho h) is what the pressure gives to a node that has it on one side only.
  CHECK(fastest <= 1e-12 * run.step.dt * 100 / (1000 * 0.05));
}

TEST_CASE("The power of the pressure on water and grains is that of the volumes of the water") {
  Column run({"bodies.soil.jitter=0.3", "bodies.pore_water.jitter=0.3"});
  run.run_until("pore_pressure");
  const Array<Vec4> before = run.soil().force;
  run.run_until("momentum");
  const Array<Vec4> after = run.soil().force;
  run.run_until("pore_rate");
  double forces = 0;
  for_each_active_real_row(run.water(), [&](int begin, int count, const std::array<int, 2>& node) {
    const RowForce<2> force = cell_pressure_force<2>(run.water(), begin, count, node);
    for (int k = 0; k < count; ++k)
      for (int a = 0; a < 2; ++a) {
        const double n = run.water().pore_share[begin + k];
        forces += force[a][k] * n * run.water().velocity[begin + k][a];
        forces += (after[begin + k][a] - before[begin + k][a]) * run.soil().velocity[begin + k][a];
      }
  });
  update_pore_rate(run.soils, run.grids);
  double volumes = 0;
  run.for_nodes([&](int c) {
    volumes += run.water().cell_pressure[c] * run.water().volume_rate[c] * run.water().cell_volume[c];
  });
  REQUIRE(std::abs(volumes) > 1e-3);
  CHECK(forces == near(volumes, 1e-11));
}

TEST_CASE("In the place of the soil only its pores have water, and none is lost") {
  Column run;
  // 0.4 of 0.2 m x 1 m at 100 Pa (K = 1.6e8 Pa)
  const double filled = 0.4 * 0.2 * 1000 * (1 + 100 / 1.6e8);
  CHECK(total(run.body("pore_water").mass) == near(filled, 1e-12));
  const double mass = total(run.body("pore_water").mass), grains = total(run.body("soil").mass);
  CHECK(grains == near(1590 * 0.2, 1e-12));
  for (int k = 0; k < 100; ++k) advance(run.rows, run.state, run.grids);
  CHECK(total(run.body("pore_water").mass) == mass);
  CHECK(total(run.body("soil").mass) == grains);
}

TEST_CASE("Conductivity follows the porosity as n^3 / (1 - n)^2, or stays; porosity follows the skeleton") {
  PoreSoil soil{0, 1, 0, 2650, 0.4, 1e-3, CoupledSpec::Permeability::kozeny_carman, 9810};
  CHECK(soil.porosity_at(1) == near(0.4, 1e-15));
  CHECK(soil.porosity_at(1.2) == near(0.5, 1e-15));  // 1 - 0.6 / 1.2
  CHECK(soil.resistance(0.4) == near(9.81e6, 1e-14));
  // k/k0 = (0.125 / 0.25) / (0.064 / 0.36) = 2.8125
  CHECK(soil.resistance(0.5) == near(9.81e6 / 2.8125, 1e-14));
  soil.forchheimer = 300;
  // b/b0 = (0.5 / 0.125) / (0.6 / 0.064)
  CHECK(soil.inertial_resistance(0.5) == near(9810 * 300 * 4 / 9.375, 1e-14));
  soil.law = CoupledSpec::Permeability::constant;
  CHECK(soil.resistance(0.5) == near(9.81e6, 1e-14));
  CHECK(soil.inertial_resistance(0.5) == near(9810 * 300, 1e-14));
}

TEST_CASE("Consolidation by hand: c_v, the path of drainage and the time factor") {
  const auto of = [](const std::vector<std::string>& settings) {
    const Scene scene = read_scene(column, settings);
    return consolidation(scene, pore_soils(scene)[0]);
  };
  // k E / gamma_w = 2.5e-3 1e6 / 9810 m2/s; the bottom is a wall, so are the sides: 1 m; 1.962 s
  const Consolidation drains = of({});
  CHECK(drains.coefficient == near(2.5e3 / 9810, 1e-12));
  CHECK(drains.path == near(1, 1e-12));
  CHECK(drains.time_factor == near(0.5, 1e-12));
  CHECK(of({"bodies.soil.shape.lower.1=0.5"}).path == near(0.25, 1e-12));
  CHECK(of({"grid.upper.0=0.4"}).path == near(0.2, 1e-12));
  Scene closed = read_scene(column);
  std::get<BoxShape>(closed.bodies[0].shape).upper[1] = closed.grid.upper[1];
  CHECK(std::isinf(consolidation(closed, pore_soils(closed)[0]).path));
}

TEST_CASE("A cell of pore water swings with the water and the grains that its pressure moves") {
  Column run({"materials.water.sound_speed=200", "bodies.free_water.shape.upper.1=1.4"}, 0);
  run.run_until("momentum");
  const auto swing = [&](int row) {
    constexpr int pad = GridLayout<2>::pad;
    return cell_swing<2>(run.water(), run.water().layout.index({2, row}), 1, {2 + pad, row + pad}, run.step.dt)[0];
  };
  // A full cell of free water has S = (c dt / h)^2 / 2, of pore water K/n (n/rho_w + (1 - n)/rho_s) in the place of
  // c^2.
  const double courant = std::pow(run.step.dt / 0.05, 2) / 2;
  CHECK(swing(24) == near(4e4 * courant, 1e-4));
  CHECK(swing(10) == near(4e7 / 0.4 * (0.4 / 1000 + 0.6 / 2650) * courant, 1e-4));
}
