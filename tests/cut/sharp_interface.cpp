// A sharp interface on the grid: what must hold whatever the numbers are.
#include <doctest/doctest.h>

#include <geodrop/step/pipeline.hpp>

#include <cmath>
#include <type_traits>

#include "cut/cells_around.hpp"
#include "cut/interface_cells.hpp"
#include "cut/interface_constraint.hpp"
#include "geometry/polygon.hpp"
#include "grid/momentum.hpp"
#include "measure/water_force.hpp"
#include "membrane/triangles.hpp"
#include "support/join.hpp"
#include "support/near.hpp"
#include "support/random_particles.hpp"
#include "support/scene_files.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

using Plane = std::integral_constant<int, 2>;
using Space = std::integral_constant<int, 3>;

/// The ellipse of the case, coarse and in a small box, or the sphere of its case, after some steps of their fall.
template <int Dim>
struct Fall {
  Scene scene;
  State<Dim> state;
  Grids<Dim> grids;
  Pipeline<Dim> pipeline;

  explicit Fall(std::vector<std::string> overrides, int steps = 3)
      : scene(read_scene(
            source_path(Dim == 2 ? "cases/ellipse_release.toml" : "cases/verification/sphere_release_3d.toml"),
            settings(std::move(overrides)))),
        state(build_state<Dim>(scene)),
        grids(make_grids<Dim>(scene)),
        pipeline(build_pipeline<Dim>(scene)) {
    for (int k = 0; k < steps; ++k) step();
  }
  static std::vector<std::string> settings(std::vector<std::string> overrides) {
    if (Dim == 2)
      for (const char* key : {"bodies.water.shape.", "grid."})
        for (const char* corner : {"lower=[-4.0, 8.0]", "upper=[4.0, 20.0]"})
          overrides.push_back(std::string(key) + corner);
    overrides.push_back("grid.spacing=0.5");
    return overrides;
  }
  void step() { advance(pipeline, state, grids); }

  void scramble_velocities(unsigned seed) {
    Random random(seed);
    for (Grid<Dim>& grid : grids)
      for_each_node(grid.layout, 2, [&](int flat, const auto&) {
        for (int a = 0; a < Dim; ++a) grid.velocity[flat][a] = grid.sum[flat][3] > 0 ? random.uniform(-1, 1) : 0.0;
      });
    for (Grid<Dim>& grid : grids) impose_wall_velocity(grid);
  }
  std::array<double, Dim> momentum(std::size_t field) const {
    std::array<double, Dim> sum{};
    for (std::size_t n = 0; n < grids[field].sum.size(); ++n)
      for (int a = 0; a < Dim; ++a) sum[a] += grids[field].sum[n][3] * grids[field].velocity[n][a];
    return sum;
  }
  double kinetic() const {
    double sum = 0;
    for (const Grid<Dim>& grid : grids)
      for (std::size_t n = 0; n < grid.sum.size(); ++n)
        for (int a = 0; a < Dim; ++a) sum += 0.5 * grid.sum[n][3] * grid.velocity[n][a] * grid.velocity[n][a];
    return sum;
  }
  const Membrane<Dim>& membrane() const { return state.membranes[0]; }
};

/// Cells of one size, and such whose width changes along the outline.
const std::vector<std::string> uniform{},
    graded{
        "grid.refine=[{axis='x',from=-0.2,to=0.7,spacing=0.25,growth=1.3},{axis='y',from=11.0,to=13.5,spacing=0.2}]"};

/// Settings of the axes to test; the last of the plane is graded.
template <class Axes>
std::vector<std::vector<std::string>> axes_of() {
  if (Axes::value == 2) return {uniform, graded};
  return {uniform};
}

/// What hinders slip along the membrane of the case.
template <int Dim>
std::vector<std::string> hinders(const std::vector<std::string>& settings) {
  std::vector<std::string> out;
  for (const std::string& setting : settings)
    out.push_back((Dim == 2 ? "membranes.geotextile." : "membranes.skin.") + setting);
  return out;
}
template <int Dim>
std::vector<std::string> sticks() {
  return hinders<Dim>({"shear=no_slip"});
}
template <int Dim>
std::vector<std::string> rubs() {
  return hinders<Dim>({"shear=wall_law", "wall_friction=0.5"});
}
template <int Dim>
std::vector<std::string> rough() {
  return hinders<Dim>({"shear=rough_wall", "roughness=0.5"});
}

/// Largest traction along a membrane.
double largest_shear(const Membrane<2>& membrane) {
  double largest = 0;
  for (const double tau : membrane.water_shear) largest = std::max(largest, std::abs(tau));
  return largest;
}
double largest_shear(const Membrane<3>& membrane) {
  double largest = 0;
  for (std::size_t t = 0; t < membrane.triangles.size(); ++t)
    largest = std::max(largest, vector_at(membrane.triangles.water_shear, t).norm());
  return largest;
}

/// sum_i v_i . g_ic over all parts of cells of a field, and the same as volume rates of its groups [m2/s, m3/s].
template <int Dim>
std::pair<double, double> flow_and_rates(const Grid<Dim>& grid) {
  double flow = 0, rates = 0;
  for (const PartCell<Dim>& part : grid.part_cells) {
    if (part.host < 0) continue;
    for (int n = 0; n < nodes_around<Dim>; ++n) {
      const int node = node_around(grid.layout, part.flat, n);
      const Vec4 v = carried_velocity<Dim>(grid, node, stored_cell(grid.layout, node));
      for (int a = 0; a < Dim; ++a) flow += part.slope[n][a] * v[a];
    }
    rates += grid.cell_volume[part.flat] * grid.volume_rate[part.flat];
  }
  return {flow, rates};
}

}  // namespace

TEST_CASE_TEMPLATE("Joining conserves momentum to round-off, also where nodes are nearly empty", Axes, Plane, Space) {
  std::vector<std::vector<std::string>> all{uniform, sticks<Axes::value>(), rubs<Axes::value>(), rough<Axes::value>()};
  if (Axes::value == 2) all.push_back(graded);
  for (const auto& settings : all) {
    Fall<Axes::value> fall(settings);
    fall.scramble_velocities(1);
    const auto inside = fall.momentum(1), around = fall.momentum(0);
    join(fall.state, fall.grids, 1e-3);
    const auto inside_after = fall.momentum(1), around_after = fall.momentum(0);
    for (int a = 0; a < Axes::value; ++a) {
      const double given = inside_after[a] - inside[a], taken = around[a] - around_after[a];
      CHECK(std::abs(given) > 1);  // something was exchanged
      CHECK(given == near(taken, 1e-10));
    }
  }
}

TEST_CASE_TEMPLATE("Joined velocities need no further pressure", Axes, Plane, Space) {
  for (const auto& axes : axes_of<Axes>()) {
    Fall<Axes::value> fall(axes);
    fall.scramble_velocities(2);
    join(fall.state, fall.grids, 1e-3);
    double before = 0, after = 0;
    for (const double p : fall.membrane().water_pressure) before = std::max(before, std::abs(p));
    join(fall.state, fall.grids, 1e-3);
    for (const double p : fall.membrane().water_pressure) after = std::max(after, std::abs(p));
    CHECK(before > 1e4);
    CHECK(after < 1e-5 * before);
  }
}

TEST_CASE_TEMPLATE("Water that sticks no longer slips, and a second look finds no traction", Axes, Plane, Space) {
  std::vector<std::string> settings = sticks<Axes::value>();
  if (Axes::value == 2) settings.emplace_back("membranes.geotextile.contents_friction=inf");
  Fall<Axes::value> fall(settings);
  fall.scramble_velocities(3);
  join(fall.state, fall.grids, 1e-3);
  const double before = largest_shear(fall.membrane());
  join(fall.state, fall.grids, 1e-3);
  CHECK(before > 1e4);
  CHECK(largest_shear(fall.membrane()) < 1e-5 * before);
}

TEST_CASE_TEMPLATE("The body gets the forces that the history tells of", Axes, Plane, Space) {
  constexpr double dt = 1e-3;
  constexpr double tolerance = Axes::value == 2 ? 1e-12 : 2e-6;  // of the pieces that the triangles are cut into
  for (const auto& settings : {sticks<Axes::value>(), rubs<Axes::value>(), rough<Axes::value>()}) {
    Fall<Axes::value> fall(settings);
    fall.scramble_velocities(5);
    const auto before = fall.momentum(1);
    join(fall.state, fall.grids, dt);
    const auto after = fall.momentum(1);
    const auto force = water_force(fall.membrane());
    double friction = 0;
    for (int a = 0; a < Axes::value; ++a) {
      CHECK(after[a] - before[a] == near(dt * (force.pressure[a] + force.friction[a]), tolerance));
      friction = std::max(friction, std::abs(force.friction[a]));
    }
    CHECK(friction > 1);
  }
}

TEST_CASE("In space the wall law pulls at each triangle the way that the water slips past it") {
  for (int axis = 0; axis < 3; ++axis) {
    Fall<3> fall(rubs<3>());
    const Vec<3> stream = Vec<3>::Unit(axis) + 0.5 * Vec<3>::Unit((axis + 1) % 3);
    for (Grid<3>& grid : fall.grids)
      for_each_node(grid.layout, 2, [&](int flat, const auto&) {
        const bool flows = grid.field == 0 && grid.sum[flat][3] > 0;
        for (int a = 0; a < 3; ++a) grid.velocity[flat][a] = flows ? stream[a] : 0.0;
      });
    join(fall.state, fall.grids, 1e-3);
    const Membrane<3>& membrane = fall.membrane();
    double along = 0, all = 0;
    for (std::size_t t = 0; t < membrane.triangles.size(); ++t) {
      const Vec<3> normal = normal_of(membrane, t).normalized(), slip = stream - stream.dot(normal) * normal;
      const Vec<3> shear = vector_at(membrane.triangles.water_shear, t);
      along += shear.dot(slip.normalized());
      all += shear.norm();
    }
    CAPTURE(along / all);
    CHECK(along > 0.95 * all);
  }
}

TEST_CASE("In space a bed only pushes, and rubs by mu p at most in any direction, with what slips against it") {
  constexpr double mu = 0.3, pore_pressure = 1e3;
  Fall<3> fall({"membranes.skin.bed=water", "membranes.skin.bed_friction=0.3"});
  Body<3>& bed = fall.state.bodies[0];
  bed.pore_pressure.assign(bed.size(), pore_pressure);
  fall.scramble_velocities(7);
  const double before = fall.kinetic();
  join(fall.state, fall.grids, 1e-3);
  const Membrane<3>& membrane = fall.membrane();
  std::size_t open = 0, slipping = 0;
  for (std::size_t t = 0; t < membrane.triangles.size(); ++t) {
    const double p = membrane.water_pressure[t], most = mu * std::max(0.0, p - pore_pressure);
    const double shear = vector_at(membrane.triangles.water_shear, t).norm();
    CHECK(p >= 0);
    CHECK(shear <= mu * p * (1 + 1e-9));
    open += p == 0;
    slipping += p > 5e3 && shear > 0.99 * most && shear < 1.01 * most;
  }
  CHECK(open > membrane.triangles.size() / 20);
  CHECK(slipping > membrane.triangles.size() / 20);
  const double with_friction = fall.kinetic();
  Fall<3> smooth({"membranes.skin.bed=water"});
  smooth.scramble_velocities(7);
  join(smooth.state, smooth.grids, 1e-3);
  CHECK(with_friction < smooth.kinetic());
  CHECK(smooth.kinetic() < before);
}

TEST_CASE_TEMPLATE("Both sides have all of a cut cell's splines between them", Axes, Plane, Space) {
  for (const auto& axes : axes_of<Axes>()) {
    const Fall<Axes::value> fall(axes);
    for (const auto& grid : fall.grids)
      for (const auto& part : grid.part_cells) {
        double elsewhere = 0;
        for (const double value : part.elsewhere) elsewhere += value;
        CHECK(elsewhere == within(grid.taken[part.flat] * cell_size(grid.layout, part.flat), 1e-15));
      }
  }
}

TEST_CASE_TEMPLATE("A field that moves as a whole flows through no part of a cell", Axes, Plane, Space) {
  for (const auto& axes : axes_of<Axes>()) {
    const Fall<Axes::value> fall(axes);
    for (const auto& grid : fall.grids)
      for (const auto& part : grid.part_cells)
        for (int a = 0; a < Axes::value; ++a) {
          double sum = 0;
          for (const auto& slope : part.slope) sum += slope[a];
          CHECK(std::abs(sum) < 1e-12);
        }
  }
}

TEST_CASE_TEMPLATE("A field that expands evenly flows out of both parts of a cell by their sizes", Axes, Plane, Space) {
  const Fall<Axes::value> fall(axes_of<Axes>().back());
  const auto& layout = fall.grids[0].layout;
  REQUIRE(layout.graded() == (Axes::value == 2));
  int cut = 0;
  for (const auto& grid : fall.grids)
    for (const auto& part : grid.part_cells) {
      double flow = 0;  // of v = (x, 2 y, 3 z)
      for (int n = 0; n < nodes_around<Axes::value>; ++n) {
        const auto node = stored_cell(layout, node_around(layout, part.flat, n));
        for (int a = 0; a < Axes::value; ++a) flow += part.slope[n][a] * (a + 1) * layout.node(a, node[a] - layout.pad);
      }
      const double share = 1 - grid.taken[part.flat];
      if (share > 1e-9 && share < 1 - 1e-9) ++cut;
      const double rate = Axes::value == 2 ? 3 : 6;
      if (grid.field == 1) CHECK(flow == near(rate * share * cell_size(layout, part.flat), 1e-10));
    }
  CHECK(cut > 20);
}

TEST_CASE_TEMPLATE("Volume rates of parts are the flow out of them", Axes, Plane, Space) {
  for (const auto& axes : axes_of<Axes>()) {
    Fall<Axes::value> fall(axes);
    fall.scramble_velocities(4);
    update_interface_rates(fall.grids);
    for (const auto& grid : fall.grids) {
      REQUIRE(!grid.part_cells.empty());
      const auto [flow, rates] = flow_and_rates(grid);
      CHECK(std::abs(flow) > 1e-3);
      CHECK(rates == near(flow, 1e-10));
    }
  }
}

TEST_CASE_TEMPLATE("An even pressure inside and around leaves everything at rest", Axes, Plane, Space) {
  constexpr int dim = Axes::value;
  for (std::vector<std::string> overrides : axes_of<Axes>()) {
    overrides.emplace_back(dim == 2 ? "gravity=[0.0, 0.0]" : "gravity=[0.0, 0.0, 0.0]");
    overrides.emplace_back("materials.water.sound_speed=60.0");
    Fall<dim> fall(overrides, 0);
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
  Fall<2> fall({});
  const Grid<2>&around = fall.grids[0], &inside = fall.grids[1];
  double area = 0;
  for (std::size_t c = 0; c < inside.taken.size(); ++c) area += around.taken[c];
  const double exact = std::abs(signed_area(fall.membrane().x[0], fall.membrane().x[1]));
  CHECK(area * 0.25 == near(exact, 3e-8));  // of the step before
  for (const PartCell<2>& part : inside.part_cells)
    CHECK(inside.taken[part.flat] + around.taken[part.flat] == near(1, 1e-12));
}
