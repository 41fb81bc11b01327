// Pore water that flows through a sharp membrane: the bag of cases/verification/seepage_through_fabric.toml, step by
// step.
#include "cut/seep.hpp"

#include <geodrop/base/find_named.hpp>
#include <geodrop/step/pipeline.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "cut/interface_cells.hpp"
#include "cut/interface_contacts.hpp"
#include "cut/outline_pieces.hpp"
#include "grid/momentum.hpp"
#include "grid/neighbourhood.hpp"
#include "measure/water_force.hpp"
#include "pores/pores.hpp"
#include "support/near.hpp"
#include "support/scene_files.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

struct Bag {
  Scene scene;
  State<2> state;
  Grids<2> grids;
  Pipeline<2> rows;
  StepContext step;

  explicit Bag(const std::vector<std::string>& settings = {})
      : scene(read_scene(source_path("cases/verification/seepage_through_fabric.toml"), settings)),
        state(build_state<2>(scene)),
        grids(make_grids<2>(scene)),
        rows(build_pipeline<2>(scene)) {}

  void run(int steps) {
    for (int k = 0; k < steps; ++k) advance(rows, state, grids);
  }
  /// The rows of a step up to the one of that name, which does not run.
  void run_until(const std::string& name) {
    for (std::size_t r = 0; r < rows.size() && rows[r].name != name; ++r) rows[r].run(state, grids, step);
  }
  double mass(const std::string& name) const {
    const Array<double>& of = find_named(state.bodies, name).mass;
    return std::accumulate(of.begin(), of.end(), 0.0);
  }
  Vec4 momentum() const {
    Vec4 sum{};
    for (const Body<2>& body : state.bodies)
      for (std::size_t p = 0; p < body.size(); ++p)
        for (int a = 0; a < 2; ++a) sum[a] += body.mass[p] * body.v[a][p];
    return sum;
  }
  const Membrane<2>& fabric() const { return state.membranes[0]; }
};

}  // namespace

TEST_CASE("What seeps through a membrane leaves the water on one side and joins that on the other") {
  for (const double sign : {1.0, -1.0}) {
    CAPTURE(sign);
    Bag bag({"grid.spacing=0.2"});
    bag.run(50);
    bag.run_until("seep");
    // A jet on each side, so that momentum has something to lose, and a flow of known size.
    for (Body<2>& body : bag.state.bodies)
      for (std::size_t p = 0; p < body.size(); ++p) body.v[0][p] = body.name == "pore_water" ? 3.0 : -1.0;
    for (double& q : bag.state.membranes[0].seepage) q = sign * 1e-3;
    const double inside = bag.mass("pore_water"), around = bag.mass("water"), flow = seepage(bag.fabric());
    const Vec4 before = bag.momentum();
    constexpr double dt = 0.1;
    seep(bag.state, bag.grids, dt);
    const double given = inside - bag.mass("pore_water"), density = sign > 0 ? 1000 * 1.0102 : 1000 * 1.0038;
    CHECK(given == near(flow * dt * density, 3e-3));  // water is denser by its pressure over K
    CHECK(bag.mass("water") - around == near(given, 1e-9));
    for (int a = 0; a < 2; ++a) CHECK(bag.momentum()[a] - before[a] == near_zero(1e-10 * std::abs(before[0])));
    if (sign > 0) CHECK(given > 0);
  }
}

TEST_CASE("What flows in brings no gas, what flows out takes its share along; the pressure stays") {
  for (const double sign : {1.0, -1.0}) {
    CAPTURE(sign);
    Bag bag({"grid.spacing=0.2", "materials.sand.saturation=0.8", "materials.sand.gas_pressure=1e5",
             "materials.sand.atmospheric_pressure=1e5"});
    bag.run(50);
    bag.run_until("seep");
    Body<2>& water = find_named(bag.state.bodies, "pore_water");
    const auto gas = [&] {
      double sum = 0;
      for (std::size_t p = 0; p < water.size(); ++p) sum += water.mass[p] * water.gas[p];
      return sum;
    };
    const auto pressures = [&] {
      std::vector<double> all;
      for (std::size_t p = 0; p < water.size(); ++p) all.push_back(mean_pressure(water, p));
      return all;
    };
    for (double& q : bag.state.membranes[0].seepage) q = sign * 1e-3;
    const double mass = bag.mass("pore_water"), before = gas();
    const std::vector<double> pressed = pressures();
    seep(bag.state, bag.grids, 0.1);
    const double change = bag.mass("pore_water") - mass;
    REQUIRE(std::abs(change) > 0.1);
    const double lost = sign > 0 ? before * change / mass : 0;  // its mean share, about that of each particle
    CHECK(gas() - before == within(lost, 0.02 * std::abs(lost) + 1e-9 * before));
    const std::vector<double> after = pressures();
    for (std::size_t p = 0; p < after.size(); ++p) CHECK(after[p] == within(pressed[p], 1e-6 * 1e5));
  }
}

TEST_CASE("What flows into a cell of the bag that has lost its water goes to a neighbour") {
  Bag bag({"grid.spacing=0.2"});
  bag.run(2);
  bag.run_until("interface_pressure");
  Grid<2>& water = bag.grids[bag.grids[bag.fabric().field].pore_water];
  const Body<2>& body = find_named(bag.state.bodies, "pore_water");
  std::size_t middle = 0;
  const auto off = [&](std::size_t p) { return std::hypot(body.x[0][p] - 1.5, body.x[1][p] - 1.4); };
  for (std::size_t p = 0; p < body.size(); ++p)
    if (off(p) < off(middle)) middle = p;
  const int empty = cell_at(water.layout, body.x, middle);
  water.cell_volume[empty] = 0;
  water.cell_flags[empty] = 0;
  share_interface_pressure(bag.state, bag.grids);
  const auto part =
      std::find_if(water.part_cells.begin(), water.part_cells.end(), [&](const auto& p) { return p.flat == empty; });
  REQUIRE(part != water.part_cells.end());
  const int host = part->host;
  REQUIRE(host != empty);
  CHECK(water.cell_pressure[empty] == water.cell_pressure[host]);
  // Nodes move away from the origin: div v = 2.
  for (int i = 0; i < static_cast<int>(water.mixture_velocity.size()); ++i) {
    const std::array<int, 2> node = stored_cell(water.layout, i);
    for (int a = 0; a < 2; ++a) water.mixture_velocity[i][a] = 0.2 * (node[a] - GridLayout<2>::pad);
  }
  update_interface_rates(bag.grids);
  CHECK(water.volume_rate[host] * water.cell_volume[host] == near(2 * 2 * 0.2 * 0.2, 1e-9));
}

TEST_CASE("The permeance of a segment follows its strain, linear between those of the table, constant beyond") {
  Bag bag({"membranes.fabric.permittivity_strains=[0.01, 0.03, 0.1]",
           "membranes.fabric.permittivity_factors=[1.0, 2.0, 1.5]", "membranes.fabric.clogging=0.25"});
  Membrane<2>& fabric = bag.state.membranes[0];
  CHECK(fabric.permeance == near(0.75 * 4e-3 / 9810, 1e-12));
  for (const auto& [strain, factor] :
       {std::pair{-0.2, 1.0}, {0.01, 1.0}, {0.015, 1.25}, {0.03, 2.0}, {0.065, 1.75}, {0.1, 1.5}, {0.5, 1.5}}) {
    fabric.strain[7] = strain;
    CHECK(permeance_of(fabric, 7) == near(factor * fabric.permeance, 1e-12));
  }
}

TEST_CASE("Cloth that lets twice as much through stretched, or half clogged, is one of that permittivity") {
  const auto flow = [](std::vector<std::string> settings) {
    settings.insert(settings.end(),
                    {"grid.spacing=0.2", "membranes.fabric.slack=-0.1", "membranes.fabric.axial_stiffness=10.0",
                     "membranes.fabric.mass_per_area=0.1", "membranes.fabric.strength=1e3"});
    Bag bag(settings);
    bag.run(20);
    CHECK(bag.fabric().strain[3] == near(1 / 0.9 - 1, 0.02));
    return seepage(bag.fabric());
  };
  const double plain = flow({"membranes.fabric.permittivity=4e-3"});
  REQUIRE(plain < -1e-4);
  CHECK(flow({"membranes.fabric.permittivity=2e-3", "membranes.fabric.permittivity_strains=[0.0, 0.05]",
              "membranes.fabric.permittivity_factors=[1.0, 2.0]"}) == near(plain, 1e-12));
  CHECK(flow({"membranes.fabric.permittivity=8e-3", "membranes.fabric.clogging=0.5"}) == near(plain, 1e-12));
  CHECK(flow({"membranes.fabric.permittivity=8e-3"}) < 1.1 * plain);
}

TEST_CASE("No more than half of what is left leaves in a step") {
  Bag bag({"grid.spacing=0.2"});
  bag.run(2);
  bag.run_until("seep");
  for (double& q : bag.state.membranes[0].seepage) q = 1e3;
  seep(bag.state, bag.grids, 1.0);
  for (const Body<2>& body : bag.state.bodies)
    for (const double mass : body.mass) CHECK(mass > 0);
}

TEST_CASE("What flows through a membrane is what the pressures say, and what the pores lose") {
  Bag bag({"grid.spacing=0.2"});
  bag.run(200);
  const Membrane<2>& fabric = bag.fabric();
  double largest = 0;
  for (std::size_t s = 0; s < fabric.segments(); ++s) {
    const double q = fabric.permeance * (fabric.pore_pressure[s] - fabric.water_pressure[s]);
    CHECK(fabric.seepage[s] == near(q, 1e-9));
    largest = std::max(largest, std::abs(q));
  }
  CHECK(fabric.permeance == near(4e-3 / 9810, 1e-12));
  const double unhindered = 4e-3 / 9810 * 5000;  // by the soil
  CHECK(largest > 0.5 * unhindered);
  CHECK(largest < unhindered);
  // Flow relative to the grains through the outline, from the velocities of the nodes, and the rate of the volume
  // inside.
  double rate = 0;
  const Grid<2>& water = bag.grids[bag.grids[fabric.field].pore_water];
  for (const Body<2>& body : bag.state.bodies)
    for (std::size_t p = 0; p < body.size() && body.name == "pore_water"; ++p) {
      const int cell = water.layout.index({water.layout.base(0, body.x[0][p]), water.layout.base(1, body.x[1][p])});
      rate += body.volume(p) * water.volume_rate[cell];
    }
  CHECK(rate == near(seepage(fabric), 0.05));  // the skeleton is stiff
}

TEST_CASE("An even pressure in pores, around and on the membrane moves neither grains nor water") {
  Bag bag({"gravity=[0.0, 0.0]"});
  constexpr double pressure = 20e3;
  for (Body<2>& body : bag.state.bodies) {
    const auto* water = std::get_if<Newtonian>(&body.material);
    for (double& J : body.J) J = water ? 1 / (1 + pressure / water->bulk_modulus) : 1.0;
    for (Array<double>& stress : body.stress) std::fill(stress.begin(), stress.end(), 0.0);
  }
  bag.run(3);
  for (const Body<2>& body : bag.state.bodies)
    for (std::size_t p = 0; p < body.size(); ++p) {
      const bool near_surface = body.name == "water" && body.x[1][p] > 2.2;  // falls apart: nothing is on top of it
      if (!near_surface) CHECK(std::hypot(body.v[0][p], body.v[1][p]) == near_zero(1e-7));
    }
  for (const double p : bag.fabric().pore_pressure) CHECK(p == near(pressure, 1e-5));
}

TEST_CASE("What a tight bag of grains and water makes room for is what the water around gives") {
  for (const std::string k : {"1e-1", "1e-3", "1e-6"}) {
    CAPTURE(k);
    Bag bag({"membranes.fabric.permittivity=0.0", "materials.sand.hydraulic_conductivity=" + k});
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(-0.1, 0.1);
    for (Body<2>& body : bag.state.bodies)
      for (Array<double>& component : body.v)
        for (double& v : component) v = any(random);
    bag.run_until("interface_rate");
    update_interface_rates(bag.grids);
    double inside = 0, sizes = 0;
    const int field = bag.grids[bag.fabric().field].pore_water;
    // The flow of the mixture through the outline, twice: from the cells inside, and from the splines on the outline.
    for (const Body<2>& body : bag.state.bodies)
      for (std::size_t p = 0; p < body.size() && body.field == field; ++p) {
        const Grid<2>& water = bag.grids[field];
        const int cell = water.layout.index({water.layout.base(0, body.x[0][p]), water.layout.base(1, body.x[1][p])});
        inside += body.volume(p) * water.volume_rate[cell];
        sizes += std::abs(body.volume(p) * water.volume_rate[cell]);
      }
    double around = 0;
    const Grid<2>& water = bag.grids.front();
    const CutCells& cells = bag.grids[bag.fabric().field].outline;
    for (const CutCells::Piece& piece : cells.pieces) {
      const PieceIntegral integral = integrate_piece(water.layout, bag.fabric(), cells, piece);
      const int flat = flat_of(water.layout, cells, piece.cell);
      for (int n = 0; n < 9; ++n) {
        const int node = node_around(water.layout, flat, n), width = water.layout.stride[1];
        const Vec4 v = carried_velocity<2>(water, node, {node % width, node / width});
        for (int a = 0; a < 2; ++a) around += integral.mean[n] * integral.normal[a] * v[a];
      }
    }
    CHECK(std::abs(around) > 1e-3 * sizes);
    CHECK(inside == near(around, 1e-4));
  }
}

TEST_CASE("A tight membrane lets nothing through, and needs no row for it") {
  Bag bag({"grid.spacing=0.2", "membranes.fabric.permittivity=0.0"});
  const double before = bag.mass("pore_water");
  bag.run(50);
  CHECK(bag.mass("pore_water") == before);
  CHECK(seepage(bag.fabric()) == 0);
  for (const Row<2>& row : bag.rows) CHECK(row.name != "seep");
}
