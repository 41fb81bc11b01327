// A sharp interface on the grid: what must hold whatever the numbers are.
#include <doctest/doctest.h>

#include <geodrop/step/pipeline.hpp>

#include <cmath>

#include "cut/interface_cells.hpp"
#include "cut/interface_constraint.hpp"
#include "geometry/polygon.hpp"
#include "grid/momentum.hpp"
#include "support/near.hpp"
#include "support/random_particles.hpp"
#include "support/scene_files.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

/// The ellipse of the case, coarse and in a small box, after some steps of its fall.
struct Fall {
  Scene scene;
  State<2> state;
  Grids<2> grids;
  Pipeline<2> pipeline;

  explicit Fall(std::vector<std::string> overrides, int steps = 3)
      : scene(read_scene(source_path("cases/ellipse_release.toml"), settings(std::move(overrides)))),
        state(build_state<2>(scene)),
        grids(make_grids<2>(scene)),
        pipeline(build_pipeline<2>(scene)) {
    for (int k = 0; k < steps; ++k) step();
  }
  static std::vector<std::string> settings(std::vector<std::string> overrides) {
    for (const char* key : {"bodies.water.shape.", "grid."})
      for (const char* corner : {"lower=[-4.0, 8.0]", "upper=[4.0, 20.0]"})
        overrides.push_back(std::string(key) + corner);
    overrides.push_back("grid.spacing=0.5");
    return overrides;
  }
  void step() { advance(pipeline, state, grids); }

  void scramble_velocities(unsigned seed) {
    Random random(seed);
    for (Grid<2>& grid : grids)
      for_each_node(grid.layout, 2, [&](int flat, const auto&) {
        for (int a = 0; a < 2; ++a) grid.velocity[flat][a] = grid.sum[flat][3] > 0 ? random.uniform(-1, 1) : 0.0;
      });
    for (Grid<2>& grid : grids) impose_wall_velocity(grid);
  }
  std::array<double, 2> momentum(std::size_t field) const {
    std::array<double, 2> sum{};
    for (std::size_t n = 0; n < grids[field].sum.size(); ++n)
      for (int a = 0; a < 2; ++a) sum[a] += grids[field].sum[n][3] * grids[field].velocity[n][a];
    return sum;
  }
  const Membrane<2>& membrane() const { return state.membranes[0]; }
};

/// Cells of one size, and such whose width changes along the outline.
const std::vector<std::string> uniform{},
    graded{
        "grid.refine=[{axis='x',from=-0.2,to=0.7,spacing=0.25,growth=1.3},{axis='y',from=11.0,to=13.5,spacing=0.2}]"};

/// sum_i v_i . g_ic over all parts of cells of a field, and the same as volume rates of its groups [m2/s].
std::pair<double, double> flow_and_rates(const Grid<2>& grid) {
  double flow = 0, rates = 0;
  for (const PartCell& part : grid.part_cells) {
    if (part.host < 0) continue;
    for (int n = 0; n < 9; ++n) {
      const int node = part.flat + n % 3 - 1 + (n / 3 - 1) * grid.layout.stride[1];
      const int width = grid.layout.stride[1];
      const Vec4 v = carried_velocity<2>(grid, node, {node % width, node / width});
      for (int a = 0; a < 2; ++a) flow += part.slope[n][a] * v[a];
    }
    rates += grid.cell_volume[part.flat] * grid.volume_rate[part.flat];
  }
  return {flow, rates};
}

}  // namespace

TEST_CASE("Joining conserves momentum to round-off, also where nodes are nearly empty") {
  const std::vector<std::string> sticks = {"membranes.geotextile.shear=no_slip"},
                                 rubs = {"membranes.geotextile.shear=wall_law",
                                         "membranes.geotextile.wall_friction=0.5"},
                                 rough = {"membranes.geotextile.shear=rough_wall",
                                          "membranes.geotextile.roughness=0.5"};
  for (const auto& settings : {uniform, graded, sticks, rubs, rough}) {
    Fall fall(settings);
    fall.scramble_velocities(1);
    const auto inside = fall.momentum(1), around = fall.momentum(0);
    join_interfaces(fall.state, fall.grids, 1e-3);
    const auto inside_after = fall.momentum(1), around_after = fall.momentum(0);
    for (int a = 0; a < 2; ++a) {
      const double given = inside_after[a] - inside[a], taken = around[a] - around_after[a];
      CHECK(std::abs(given) > 1);  // something was exchanged
      CHECK(given == near(taken, 1e-10));
    }
  }
}

TEST_CASE("Joined velocities need no further pressure") {
  for (const auto& axes : {uniform, graded}) {
    Fall fall(axes);
    fall.scramble_velocities(2);
    join_interfaces(fall.state, fall.grids, 1e-3);
    double before = 0, after = 0;
    for (const double p : fall.membrane().water_pressure) before = std::max(before, std::abs(p));
    join_interfaces(fall.state, fall.grids, 1e-3);
    for (const double p : fall.membrane().water_pressure) after = std::max(after, std::abs(p));
    CHECK(before > 1e4);
    CHECK(after < 1e-5 * before);
  }
}

TEST_CASE("Water that sticks no longer slips, and a second look finds no traction") {
  Fall fall({"membranes.geotextile.shear=no_slip", "membranes.geotextile.contents_friction=inf"});
  fall.scramble_velocities(3);
  const auto largest = [&] {
    double traction = 0;
    for (const double tau : fall.membrane().water_shear) traction = std::max(traction, std::abs(tau));
    return traction;
  };
  join_interfaces(fall.state, fall.grids, 1e-3);
  const double before = largest();
  join_interfaces(fall.state, fall.grids, 1e-3);
  CHECK(before > 1e4);
  CHECK(largest() < 1e-5 * before);
}

TEST_CASE("Both sides have all of a cut cell's splines between them") {
  for (const auto& axes : {uniform, graded}) {
    const Fall fall(axes);
    const GridLayout<2>& layout = fall.grids[0].layout;
    for (const Grid<2>& grid : fall.grids)
      for (const PartCell& part : grid.part_cells) {
        double elsewhere = 0;
        for (const double value : part.elsewhere) elsewhere += value;
        const int column = part.flat % layout.stride[1] - layout.pad, row = part.flat / layout.stride[1] - layout.pad;
        const double area = layout.span_width(0, column) * layout.span_width(1, row) * layout.h * layout.h;
        CHECK(elsewhere == within(grid.taken[part.flat] * area, 1e-15));
      }
  }
}

TEST_CASE("A field that moves as a whole flows through no part of a cell") {
  for (const auto& axes : {uniform, graded}) {
    const Fall fall(axes);
    for (const Grid<2>& grid : fall.grids)
      for (const PartCell& part : grid.part_cells)
        for (int a = 0; a < 2; ++a) {
          double sum = 0;
          for (const auto& slope : part.slope) sum += slope[a];
          CHECK(std::abs(sum) < 1e-12);
        }
  }
}

TEST_CASE("A field that expands evenly flows out of both parts of a cell by their areas") {
  const Fall fall(graded);
  const GridLayout<2>& layout = fall.grids[0].layout;
  REQUIRE(layout.graded());
  int cut = 0;
  for (const Grid<2>& grid : fall.grids)
    for (const PartCell& part : grid.part_cells) {
      const int column = part.flat % layout.stride[1], row = part.flat / layout.stride[1];
      double flow = 0;  // of v = (x, 2 y)
      for (int n = 0; n < 9; ++n) {
        flow += part.slope[n][0] * layout.node(0, column + n % 3 - 1 - layout.pad);
        flow += part.slope[n][1] * 2 * layout.node(1, row + n / 3 - 1 - layout.pad);
      }
      const double whole = layout.knots[0][column].width * layout.knots[1][row].width;
      const double share = 1 - grid.taken[part.flat];
      if (share > 1e-9 && share < 1 - 1e-9) ++cut;
      if (grid.field == 1) CHECK(flow == near(3 * share * whole, 1e-10));
    }
  CHECK(cut > 20);
}

TEST_CASE("Volume rates of parts are the flow out of them") {
  for (const auto& axes : {uniform, graded}) {
    Fall fall(axes);
    fall.scramble_velocities(4);
    update_interface_rates(fall.grids);
    for (const Grid<2>& grid : fall.grids) {
      REQUIRE(!grid.part_cells.empty());
      const auto [flow, rates] = flow_and_rates(grid);
      CHECK(std::abs(flow) > 1e-3);
      CHECK(rates == near(flow, 1e-10));
    }
  }
}

TEST_CASE("An even pressure inside and around leaves everything at rest") {
  for (std::vector<std::string> overrides : {uniform, graded}) {
    for (const char* key : {"gravity=[0.0, 0.0]", "materials.water.sound_speed=60.0"}) overrides.emplace_back(key);
    Fall fall(overrides, 0);
    constexpr double pressure = 20e3;
    const double bulk_modulus = std::get<Newtonian>(fall.state.bodies[0].material).bulk_modulus;
    for (double& J : fall.state.bodies[0].J) J = 1 / (1 + pressure / bulk_modulus);
    for (int c = 0; c < 3; ++c)
      for (double& stress : fall.state.bodies[1].stress[c]) stress = -pressure;
    for (int k = 0; k < 5; ++k) fall.step();
    // One step with a node out of balance by P h would give dt P / (rho h), about 0.1 m/s.
    CHECK(fall.state.v_max < 1e-6);
    for (const double p : fall.membrane().water_pressure) CHECK(p == near(pressure, 2e-7));
  }
}

TEST_CASE("Both fields have all of a cut cell between them") {
  Fall fall({});
  const Grid<2>&around = fall.grids[0], &inside = fall.grids[1];
  double area = 0;
  for (std::size_t c = 0; c < inside.taken.size(); ++c) area += around.taken[c];
  const double exact = std::abs(signed_area(fall.membrane().x[0], fall.membrane().x[1]));
  CHECK(area * 0.25 == near(exact, 3e-8));  // of the step before
  for (const PartCell& part : inside.part_cells)
    CHECK(inside.taken[part.flat] + around.taken[part.flat] == near(1, 1e-12));
}
