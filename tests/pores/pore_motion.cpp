// Pore water whose change of pressure is that of the end of the step, one step at a time: in a column, and in a bag
// that the water flows through.
#include "pores/pore_motion.hpp"

#include <geodrop/base/find_named.hpp>
#include <geodrop/step/pipeline.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <set>

#include "cut/interface_cells.hpp"
#include "grid/cell_pressure.hpp"
#include "grid/momentum.hpp"
#include "pores/pores.hpp"
#include "support/near.hpp"
#include "support/program.hpp"
#include "support/scene_files.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

/// A coupled soil in motion, up to the implicit pressure of its water.
template <int Dim>
struct SoilIn {
  Scene scene;
  State<Dim> state;
  Grids<Dim> grids;
  std::vector<PoreSoil> soils;
  StepContext step;

  explicit SoilIn(const std::string& case_name, std::vector<std::string> settings = {}) {
    settings.push_back("bodies.pore_water.implicit_pore_pressure=true");
    scene = read_scene(source_path("cases/verification/" + case_name + ".toml"), settings);
    state = build_state<Dim>(scene);
    grids = make_grids<Dim>(scene);
    soils = pore_soils(scene);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-0.1, 0.1);
    for (Body<Dim>& body : state.bodies)
      for (Array<double>& component : body.v)
        for (double& v : component) v = any(random);
    for (Row<Dim>& row : build_pipeline<Dim>(scene)) {
      if (row.name == std::string("implicit_pressure")) return;
      row.run(state, grids, step);
    }
    FAIL("no row implicit_pressure");
  }

  Grid<Dim>& grains() { return grids[soils[0].field]; }
  Grid<Dim>& water() { return grids[soils[0].water]; }

  /// D of the cells of the water, from the nodal velocities as they are.
  Array<double> rates() const {
    Grids<Dim> copy = grids;
    update_pore_rate(soils, copy);
    if (has_sharp_interface(scene)) update_interface_rates(copy);
    return copy[soils[0].water].volume_rate;
  }

  template <class F>
  void for_moving_nodes(F f) {
    for (int i = 0; i < static_cast<int>(water().sum.size()); ++i)
      if (water().sum[i][3] > 0 || grains().sum[i][3] > 0) f(i);
  }

  /// sum V p D(w) over the pressures p = -dt K D(v) of what shares one, V K its sum over the particles.
  double work_of_pressures(const Array<double>& of_v, const Array<double>& of_w) {
    const Grid<Dim>& grid = water();
    std::set<int> parts;
    double work = 0;
    for (const PartCell<Dim>& part : grid.part_cells) {
      parts.insert(part.flat);
      if (part.host != part.flat) continue;
      double modulus = 0;
      for (const PartCell<Dim>& other : grid.part_cells)
        if (other.host == part.host) modulus += grid.pore_modulus[other.flat];
      work -= step.dt * modulus * of_v[part.flat] * of_w[part.flat];
    }
    for (std::size_t c = 0; c < of_v.size(); ++c)
      if (!parts.contains(static_cast<int>(c)) && carries_pressure(grid, static_cast<int>(c)))
        work -= step.dt * grid.pore_modulus[c] * of_v[c] * of_w[c];
    return work;
  }

  Vec4 momentum() {
    Vec4 sum{};
    for_moving_nodes(
        [&](int i) { sum += grains().sum[i][3] * grains().velocity[i] + water().sum[i][3] * water().velocity[i]; });
    return sum;
  }
};

using Soil = SoilIn<2>;

/// The change of momentum, with the drag that it meets, works on any other velocities as the pressures do that follow
/// from the velocities after it.
template <int Dim>
void check_work(SoilIn<Dim> soil) {
  const Grid<Dim> grains = soil.grains(), water = soil.water();
  press_implicitly(soil.soils, soil.step.dt, soil.state, soil.grids);
  SoilIn<Dim> other = soil;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(-1, 1);
  for (Grid<Dim>* grid : {&other.grains(), &other.water()}) {
    for (Vec4& v : grid->velocity)
      for (int a = 0; a < Dim; ++a) v[a] = any(random);
    impose_wall_velocity(*grid);
  }
  double inertia = 0, size = 0;
  soil.for_moving_nodes([&](int i) {
    const double drag = water.sum[i][3] > 0 && grains.sum[i][3] > 0 ? soil.step.dt * water.node_drag[i] : 0;
    for (int a = 0; a < Dim; ++a) {
      const double of_grains = soil.grains().velocity[i][a] - grains.velocity[i][a];
      const double of_water = soil.water().velocity[i][a] - water.velocity[i][a];
      const double w_s = other.grains().velocity[i][a], w_w = other.water().velocity[i][a];
      const double work = grains.sum[i][3] * of_grains * w_s + water.sum[i][3] * of_water * w_w +
                          drag * (of_water - of_grains) * (w_w - w_s);
      inertia += work;
      size += std::abs(work);
    }
  });
  REQUIRE(size > 0);
  const double work = soil.step.dt * soil.work_of_pressures(soil.rates(), other.rates());
  CHECK(inertia == within(work, 1e-4 * size));
  CHECK(std::abs(work) > 1e-3 * size);
}

}  // namespace

TEST_CASE("What the implicit pressure of pore water moves answers to the pressures of the end of the step") {
  for (const char* speed : {"30.0", "1460.0"}) {
    CAPTURE(speed);
    check_work(Soil("undrained_limit", {std::string("materials.water.sound_speed=") + speed}));
    check_work(Soil("seepage_through_fabric", {std::string("materials.pore_water.sound_speed=") + speed}));
    check_work(SoilIn<3>("seepage_through_fabric_3d",
                         {"grid.spacing=0.2", std::string("materials.pore_water.sound_speed=") + speed}));
  }
}

TEST_CASE("The implicit pressure of pore water in a bag keeps the momentum of both") {
  Soil soil("seepage_through_fabric");
  const Vec4 before = soil.momentum();
  const Grid<2> water = soil.water();
  press_implicitly(soil.soils, soil.step.dt, soil.state, soil.grids);
  double moved = 0;
  soil.for_moving_nodes(
      [&](int i) { moved += water.sum[i][3] * std::abs(soil.water().velocity[i][0] - water.velocity[i][0]); });
  REQUIRE(moved > 1e-3);
  const Vec4 after = soil.momentum();
  for (int a = 0; a < 2; ++a) CHECK(after[a] == within(before[a], 1e-8 * moved));
}

TEST_CASE("Nearly rigid pore water lets no cell change its volume") {
  Soil soil("undrained_limit", {"materials.water.sound_speed=9000.0"});
  const auto largest = [](const Array<double>& rates) {
    double most = 0;
    for (const double rate : rates) most = std::max(most, std::abs(rate));
    return most;
  };
  const double before = largest(soil.rates());
  press_implicitly(soil.soils, soil.step.dt, soil.state, soil.grids);
  CHECK(largest(soil.rates()) < 1e-3 * before);
}

TEST_CASE("With an implicit pressure the stiffness of the pore water does not limit the time step") {
  const auto dt = [](const char* speed) {
    return Soil("undrained_limit", {std::string("materials.water.sound_speed=") + speed}).step.dt;
  };
  CHECK(dt("9000.0") == dt("30.0"));
}

TEST_CASE("Real water in the pores of a column bears the weight but for the skeleton's share") {
  const SceneRun run("cases/verification/undrained_limit.toml",
                     {"materials.water.sound_speed=1459.45", "bodies.pore_water.implicit_pore_pressure=true"});
  const double share = 5.325e9 / (5.325e9 + 1e7);  // K_w / n beside the skeleton
  const double weight = 8873.59 / (1e8 / (1e8 + 1e7));
  CHECK(run.result("pore_pressure_Pa") == near(share * weight, 3e-3));
}

TEST_CASE("Through a geotextile flows as much as with an explicit pressure") {
  const auto flow = [](std::vector<std::string> settings) {
    settings.insert(settings.end(), {"grid.spacing=0.2", "time.end=0.3"});
    return SceneRun("cases/verification/seepage_through_fabric.toml", settings).result("inflow_m2_s");
  };
  CHECK(flow({"bodies.pore_water.implicit_pore_pressure=true"}) == near(flow({}), 0.01));
}
