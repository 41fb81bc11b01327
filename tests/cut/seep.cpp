// Pore water that flows through a sharp membrane: the bags of cases/verification/seepage_through_fabric.toml and of
// seepage_through_fabric_3d.toml, step by step.
#include "cut/seep.hpp"

#include <geodrop/base/find_named.hpp>
#include <geodrop/step/pipeline.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "cut/clipped_cells.hpp"
#include "cut/interface_cells.hpp"
#include "cut/interface_contacts.hpp"
#include "cut/outline_pieces.hpp"
#include "files/snapshot.hpp"
#include "grid/momentum.hpp"
#include "grid/neighbourhood.hpp"
#include "measure/water_force.hpp"
#include "pores/pores.hpp"
#include "support/near.hpp"
#include "support/scene_files.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

template <int Dim>
struct BagIn {
  static constexpr int dimension = Dim;
  Scene scene;
  State<Dim> state;
  Grids<Dim> grids;
  Pipeline<Dim> rows;
  StepContext step;

  explicit BagIn(const std::vector<std::string>& settings = {},
                 const char* file = Dim == 2 ? "cases/verification/seepage_through_fabric.toml"
                                             : "cases/verification/seepage_through_fabric_3d.toml")
      : scene(read_scene(source_path(file), settings)),
        state(build_state<Dim>(scene)),
        grids(make_grids<Dim>(scene)),
        rows(build_pipeline<Dim>(scene)) {}

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
    for (const Body<Dim>& body : state.bodies)
      for (std::size_t p = 0; p < body.size(); ++p)
        for (int a = 0; a < Dim; ++a) sum[a] += body.mass[p] * body.v[a][p];
    return sum;
  }
  const Membrane<Dim>& fabric() const { return state.membranes[0]; }
  const Grid<Dim>& pore_water() const { return grids[grids[fabric().field].pore_water]; }

  /// Rate of the volume of the pore water by the rates of its cells, and the sum of the sizes of its parts [m3/s].
  std::pair<double, double> rate_inside() const {
    double rate = 0, sizes = 0;
    const Body<Dim>& body = find_named(state.bodies, "pore_water");
    for (std::size_t p = 0; p < body.size(); ++p) {
      const double of_particle = body.volume(p) * pore_water().volume_rate[cell_at(pore_water().layout, body.x, p)];
      rate += of_particle;
      sizes += std::abs(of_particle);
    }
    return {rate, sizes};
  }
};
using Bag = BagIn<2>;

/// Flow of a field through the outline, that of the water around or of the grains, from the splines there [m3/s].
double flow_of(const Grid<2>& field, const BagIn<2>& bag) {
  double sum = 0;
  const CutCells& cells = bag.grids[bag.fabric().field].outline;
  for (const CutCells::Piece& piece : cells.pieces) {
    const PieceIntegral integral = integrate_piece(field.layout, bag.fabric(), cells, piece);
    for (int n = 0; n < 9; ++n) {
      const int node = node_around(field.layout, flat_of(field.layout, cells, piece.cell), n);
      const Vec4 v = carried_velocity<2>(field, node, stored_cell(field.layout, node));
      for (int a = 0; a < 2; ++a) sum += integral.mean[n] * integral.normal[a] * v[a];
    }
  }
  return sum;
}
double flow_of(const Grid<3>& field, const BagIn<3>& bag) {
  double sum = 0;
  const ClippedSurface& cells = bag.grids[bag.fabric().field].outline;
  for (const ClippedSurface::Flank& flank : cells.flanks)
    for (int n = 0; n < 27; ++n) {
      const int node = node_around(field.layout, flat_of(field.layout, cells, flank.cell), n);
      const Vec4 v = carried_velocity<3>(field, node, stored_cell(field.layout, node));
      for (std::size_t a = 0; a < 3; ++a) sum += std::pow(field.layout.h, 2) * flank.spline[n][a] * v[a];
    }
  return sum;
}

}  // namespace

TEST_CASE_TEMPLATE("What seeps through a membrane leaves the water on one side and joins that on the other", In,
                   BagIn<2>, BagIn<3>) {
  for (const double sign : {1.0, -1.0}) {
    CAPTURE(sign);
    In bag({"grid.spacing=0.2"});
    bag.run(50);
    bag.run_until("seep");
    // A jet on each side, so that momentum has something to lose, and a flow of known size.
    for (auto& body : bag.state.bodies)
      for (std::size_t p = 0; p < body.size(); ++p) body.v[0][p] = body.name == "pore_water" ? 3.0 : -1.0;
    for (double& q : bag.state.membranes[0].seepage) q = sign * 1e-3;
    const double inside = bag.mass("pore_water"), around = bag.mass("water"), flow = seepage(bag.fabric());
    const Vec4 before = bag.momentum();
    constexpr double dt = 0.1;
    seep(bag.state, bag.grids, dt);
    // Water is denser by its pressure over K.
    const double pore_pressure = In::dimension == 2 ? 9.2e3 : 6e3, pressure = pore_pressure + 5e3;
    const double density =
        1000 * (1 + (sign > 0 ? pore_pressure / (In::dimension == 2 ? 9e5 : 4e5) : pressure / 3.6e6));
    const double given = inside - bag.mass("pore_water");
    CHECK(given == near(flow * dt * density, 3e-3));
    CHECK(bag.mass("water") - around == near(given, 1e-9));
    for (int a = 0; a < In::dimension; ++a)
      CHECK(bag.momentum()[a] - before[a] == near_zero(1e-10 * std::abs(before[0])));
    if (sign > 0) CHECK(given > 0);
  }
}

TEST_CASE_TEMPLATE("What flows out into air leaves the scene, and nothing comes from there", In, BagIn<2>, BagIn<3>) {
  constexpr bool plane = In::dimension == 2;
  for (const double sign : {1.0, -1.0}) {
    CAPTURE(sign);
    In bag({"grid.spacing=0.2"},
           plane ? "cases/verification/seepage_into_air.toml" : "cases/verification/seepage_into_air_3d.toml");
    bag.run(20);
    bag.run_until("seep");
    for (double& q : bag.state.membranes[0].seepage) q = sign * 1e-3;
    const double inside = bag.mass("pore_water"), flow = seepage(bag.fabric());
    constexpr double dt = 0.1;
    seep(bag.state, bag.grids, dt);
    const double density = 1000 * (1 + (plane ? 5e3 / 9e5 : 2e3 / 4e5));
    CHECK(inside - bag.mass("pore_water") ==
          within(std::max(0.0, flow) * dt * density, 3e-3 * std::abs(flow) * dt * density));
    CHECK(water_inside(find_named(bag.state.bodies, "pore_water")) == near(bag.mass("pore_water") / 1000, 1e-12));
  }
}

TEST_CASE("Through what lies on a floor nothing flows") {
  Bag bag({"grid.spacing=0.2"}, "cases/verification/bag_drains.toml");
  bag.run(100);
  const Membrane<2>& cloth = bag.fabric();
  double below = 0, beside = 0;
  for (std::size_t s = 0; s < cloth.segments(); ++s) {
    const std::size_t end = end_of_edge(s, cloth.nodes());
    if (std::abs(cloth.x[0][s]) < 0.3 && cloth.x[1][s] < 0.1) below = std::max(below, std::abs(cloth.seepage[s]));
    if (cloth.x[1][s] > 0.3 && cloth.x[1][end] < 0.5) beside = std::max(beside, cloth.seepage[s]);
  }
  CHECK(below == 0);
  CHECK(beside > 5e-3);
}

TEST_CASE("Water flows out into air where it presses, and there alone") {
  Bag bag({"grid.spacing=0.2"}, "cases/verification/seepage_into_air.toml");
  const auto flow_after = [&](double volume_ratio) {
    for (double& J : find_named(bag.state.bodies, "pore_water").J) J = volume_ratio;
    bag.run(1);
    return std::pair(seepage(bag.fabric()), *std::ranges::max_element(bag.fabric().pore_pressure));
  };
  CHECK(flow_after(0.995).first > 1e-4);
  const auto [flow, pressure] = flow_after(1.005);
  CHECK(flow == 0);
  CHECK(pressure == 0);
  // It presses a little, and is on its way inwards: it would have to be sucked.
  Body<2>& water = find_named(bag.state.bodies, "pore_water");
  for (std::size_t p = 0; p < water.size(); ++p)
    for (int a = 0; a < 2; ++a) water.v[a][p] = (a == 0 ? 1.5 : 1.4) - water.x[a][p];
  CHECK(flow_after(0.99999).first == 0);
  CHECK(*std::ranges::min_element(bag.fabric().pore_pressure) < -100);
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

TEST_CASE_TEMPLATE("What flows through a membrane is what the pressures say, and what the pores lose", In, BagIn<2>,
                   BagIn<3>) {
  In bag({"grid.spacing=0.2"});
  bag.run(200);
  const auto& fabric = bag.fabric();
  double largest = 0;
  for (std::size_t s = 0; s < fabric.seepage.size(); ++s) {
    const double q = fabric.permeance * (fabric.pore_pressure[s] - fabric.water_pressure[s]);
    CHECK(fabric.seepage[s] == near(q, 1e-9));
    largest = std::max(largest, std::abs(q));
  }
  const bool plane = In::dimension == 2;
  const double permeance = (plane ? 4e-3 : 8e-3) / 9810;
  CHECK(fabric.permeance == near(permeance, 1e-12));
  const double unhindered = permeance * (plane ? 5000 : 2000);  // by the soil
  CHECK(largest > 0.5 * unhindered);
  CHECK(largest < unhindered);
  CHECK(bag.rate_inside().first == near(seepage(fabric), 0.05));  // the skeleton is stiff
}

TEST_CASE_TEMPLATE("An even pressure in pores, around and on the membrane moves neither grains nor water", In, BagIn<2>,
                   BagIn<3>) {
  // In space under more water: what falls apart at the surface is not to reach the bag.
  In bag(In::dimension == 2 ? std::vector<std::string>{"gravity=[0.0, 0.0]"}
                            : std::vector<std::string>{"gravity=[0.0, 0.0, 0.0]", "grid.upper=[1.6, 1.6, 2.6]",
                                                       "bodies.water.shape.upper=[1.6, 1.6, 2.4]"});
  constexpr double pressure = 20e3;
  for (auto& body : bag.state.bodies) {
    const auto* water = std::get_if<Newtonian>(&body.material);
    for (double& J : body.J) J = water ? 1 / (1 + pressure / water->bulk_modulus) : 1.0;
    for (Array<double>& stress : body.stress) std::fill(stress.begin(), stress.end(), 0.0);
  }
  bag.run(3);
  const double below = In::dimension == 2 ? 2.2 : 1.8;  // above it water falls apart: nothing is on top of it
  for (const auto& body : bag.state.bodies)
    for (std::size_t p = 0; p < body.size(); ++p) {
      if (body.name == "water" && body.x.back()[p] > below) continue;
      for (const Array<double>& component : body.v) CHECK(component[p] == near_zero(1e-7));
    }
  for (const double p : bag.fabric().pore_pressure) CHECK(p == near(pressure, 1e-5));
}

TEST_CASE_TEMPLATE("What a tight bag of grains and water makes room for is what the water around gives", In, BagIn<2>,
                   BagIn<3>) {
  for (const std::string k : {"1e-1", "1e-3", "1e-6"}) {
    CAPTURE(k);
    In bag({"membranes.fabric.permittivity=0.0", "materials.sand.hydraulic_conductivity=" + k});
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(-0.1, 0.1);
    for (auto& body : bag.state.bodies)
      for (Array<double>& component : body.v)
        for (double& v : component) v = any(random);
    bag.run_until("interface_rate");
    update_interface_rates(bag.grids);
    // The flow of the mixture through the outline, twice: from the cells inside, and from the splines on the outline.
    const auto [inside, sizes] = bag.rate_inside();
    const double around = flow_of(bag.grids.front(), bag);
    CHECK(std::abs(around) > 1e-3 * sizes);
    CHECK(inside == near(around, 1e-4));
  }
}

TEST_CASE_TEMPLATE("Where a bag is dry its tight cloth holds the water in its pores", In, BagIn<2>, BagIn<3>) {
  constexpr bool plane = In::dimension == 2;
  // Water up to a fifth of the bag.
  In bag(plane
             ? std::vector<std::string>{"membranes.fabric.permittivity=0.0", "bodies.water.shape.upper=[3.0, 1.1]",
                                        "bodies.water.initial_stress.surface=1.1"}
             : std::vector<std::string>{"membranes.fabric.permittivity=0.0", "bodies.water.shape.upper=[1.6, 1.6, 0.5]",
                                        "bodies.water.initial_stress.surface=0.5"});
  bag.run_until("interface_rate");
  const auto& fabric = bag.fabric();
  int dry = 0;
  for (std::size_t s = 0; s < fabric.seepage.size(); ++s) {
    dry += fabric.water_pressure[s] == 0 && fabric.pore_pressure[s] != 0;
    CHECK(fabric.seepage[s] == 0);
  }
  CHECK(dry > 0.5 * fabric.seepage.size());
  // The pores lose nothing; else the mixture goes with the grains.
  update_interface_rates(bag.grids);
  const auto [rate, sizes] = bag.rate_inside();
  CHECK(rate == within(flow_of(bag.grids[fabric.field], bag), 1e-3 * sizes));
}

TEST_CASE_TEMPLATE("The pores of a bag that is dry above lose what flows through its cloth by the pressures on it", In,
                   BagIn<2>, BagIn<3>) {
  constexpr bool plane = In::dimension == 2;
  // Water up to a fifth of the bag.
  In bag(
      plane ? std::vector<std::string>{"bodies.water.shape.upper=[3.0, 1.1]", "bodies.water.initial_stress.surface=1.1"}
            : std::vector<std::string>{"bodies.water.shape.upper=[1.6, 1.6, 0.5]",
                                       "bodies.water.initial_stress.surface=0.5"});
  bag.run_until("interface_rate");
  const auto& fabric = bag.fabric();
  int wet = 0, dry = 0;
  for (std::size_t s = 0; s < fabric.seepage.size(); ++s) {
    if (fabric.water_pressure[s] != 0) {
      wet += fabric.seepage[s] != 0;
      continue;
    }
    dry += fabric.pore_pressure[s] != 0;
    CHECK(fabric.seepage[s] >= 0);  // no water comes out of air
  }
  CHECK(wet > 0.1 * fabric.seepage.size());
  CHECK(dry > 0.5 * fabric.seepage.size());
  double flow = 0;
  const auto& cells = bag.grids[fabric.field].outline;
  for (const Contact<In::dimension>& contact : find_contacts(bag.state, bag.grids)) {
    const double inside = last_traction(contact, cells, Says::through);
    flow += contact.permeance * (inside - last_traction(contact, cells, Says::normal)) * contact.stretch.size;
  }
  update_interface_rates(bag.grids);
  const double lost = bag.rate_inside().first - flow_of(bag.grids[fabric.field], bag);
  CHECK(std::abs(flow) > 1e-7);
  CHECK(lost == near(flow, 0.02));
}

TEST_CASE_TEMPLATE("The porosity at the nodes of a bag is that of its soil, beside the geotextile, too", In, BagIn<2>,
                   BagIn<3>) {
  In bag({"grid.spacing=0.2"});
  bag.run_until("momentum");
  const auto& water = bag.pore_water();
  int nodes = 0;
  for (std::size_t i = 0; i < water.sum.size(); ++i) {
    if (!(water.sum[i][3] > 0)) continue;
    CHECK(water.pore_share[i] == within(0.4, 0.01));
    ++nodes;
  }
  CHECK(nodes > (In::dimension == 2 ? 40 : 250));
}

TEST_CASE_TEMPLATE("Frames have the flow through each segment or triangle and the pressure of the pores on it", In,
                   BagIn<2>, BagIn<3>) {
  In bag({"grid.spacing=0.2"});
  bag.run(20);
  const MembraneSnapshot shown = take_snapshot(bag.state, {"water", "sand", "pore_water"}).membranes;
  for (const auto& [name, values] :
       {std::pair{"seepage", &bag.fabric().seepage}, std::pair{"pore_pressure", &bag.fabric().pore_pressure}}) {
    const auto field = std::ranges::find(shown.fields, name, &Field::name);
    REQUIRE(field != shown.fields.end());
    REQUIRE(field->values.size() == values->size());
    for (std::size_t s = 0; s < values->size(); ++s) CHECK(field->values[s] == static_cast<float>((*values)[s]));
  }
}

TEST_CASE_TEMPLATE("A tight membrane lets nothing through, and needs no row for it", In, BagIn<2>, BagIn<3>) {
  In bag({"grid.spacing=0.2", "membranes.fabric.permittivity=0.0"});
  const double before = bag.mass("pore_water");
  bag.run(50);
  CHECK(bag.mass("pore_water") == near(before, 1e-14));
  CHECK(seepage(bag.fabric()) == 0);
  for (const auto& row : bag.rows) CHECK(row.name != "seep");
}
