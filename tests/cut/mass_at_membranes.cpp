// The consistent mass matrix beside sharp membranes: against sums over particles by hand, momentum kept, nothing far
// away.
#include "cut/mass_at_membranes.hpp"

#include <doctest/doctest.h>
#include <geodrop/step/pipeline.hpp>

#include <cmath>
#include <string>
#include <vector>

#include "grid/blocks.hpp"
#include "grid/momentum.hpp"
#include "grid/neighbourhood.hpp"
#include "grid/point_support.hpp"
#include "support/near.hpp"
#include "support/program.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

/// A scene at its first step, before what meets at its membranes is joined.
template <int Dim>
struct BeforeJoin {
  Scene scene;
  State<Dim> state;
  Grids<Dim> grids;

  BeforeJoin(const std::string& path, const std::string& spacing)
      : scene(read_scene(source_path(path), {"grid.spacing=" + spacing, "solver.mass_matrix=consistent_at_membranes"})),
        state(build_state<Dim>(scene)),
        grids(make_grids<Dim>(scene)) {
    Pipeline<Dim> pipeline = build_pipeline<Dim>(scene);
    StepContext step{0, state.t, state.step};
    for (Row<Dim>& row : pipeline) {
      if (row.name == std::string("join_interfaces")) return;
      row.run(state, grids, step);
    }
    FAIL("no row join_interfaces");
  }

  /// The same change of velocity f(place) at all nodes of all fields, but for what walls hold.
  template <class F>
  void set_change(F&& f) {
    for (Grid<Dim>& grid : grids) {
      for (int flat = 0; flat < grid.layout.nodes(); ++flat) grid.velocity_change[flat] = f(place(grid.layout, flat));
      impose_wall_velocity(grid);
    }
  }

  static std::array<double, Dim> place(const GridLayout<Dim>& layout, int flat) {
    const std::array<int, Dim> node = stored_cell(layout, flat);
    std::array<double, Dim> x;
    for (int a = 0; a < Dim; ++a) x[a] = layout.node(a, node[a] - GridLayout<Dim>::pad);
    return x;
  }
};

/// Mass and first moment of what the spline of a node holds of the particles of a field.
template <int Dim>
struct Held {
  double mass = 0;
  std::array<double, Dim> moment{};
};
template <int Dim>
std::vector<Held<Dim>> held_by_nodes(const State<Dim>& state, const Grid<Dim>& grid) {
  std::vector<Held<Dim>> out(static_cast<std::size_t>(grid.layout.nodes()));
  for (const Body<Dim>& body : state.bodies)
    for (std::size_t p = 0; body.field == grid.field && p < body.size(); ++p) {
      const std::array<double, Dim> x = place_at(body.x, p);
      PointSupport<Dim>(grid.layout, x, 0).for_each_node(grid.layout, [&](int node, double weight) {
        out[node].mass += weight * body.mass[p];
        for (int a = 0; a < Dim; ++a) out[node].moment[a] += weight * body.mass[p] * x[a];
      });
    }
  return out;
}

/// A change of velocity that is linear in space is known at the nodes afterwards, where lumping gave that of the centre
/// of mass: a node is corrected by the gradient times its distance from there, if all its particles are beside the
/// membrane.
template <int Dim>
void check_linear(const std::string& path, const std::string& spacing, double reach) {
  BeforeJoin<Dim> run(path, spacing);
  constexpr double slope = 3;
  run.set_change([](const std::array<double, Dim>& x) { return Vec4{slope * x[1], -slope * x[0], 0, 0}; });
  const Grids<Dim> before = run.grids;
  correct_mass_at_membranes(run.state, run.grids);
  const double h = run.grids.front().layout.h;
  int corrected = 0, far = 0;
  for (std::size_t f = 0; f < run.grids.size(); ++f) {
    const Grid<Dim>& grid = run.grids[f];
    const std::vector<Held<Dim>> held = held_by_nodes(run.state, grid);
    for_each_active_real_row(grid, [&](int begin, int count, std::array<int, Dim> node) {
      for (int flat = begin; flat < begin + count; ++flat, ++node[0]) {
        if (held[flat].mass <= 0 || !far_from_walls<Dim>(grid.layout, 1, node)) continue;
        const std::array<double, Dim> x = run.place(grid.layout, flat);
        double nearest = INFINITY;
        const Membrane<Dim>& skin = run.state.membranes.front();
        for (std::size_t n = 0; n < skin.x[0].size(); ++n) {
          double square = 0;
          for (int a = 0; a < Dim; ++a) square += std::pow(skin.x[a][n] - x[a], 2);
          nearest = std::min(nearest, std::sqrt(square));
        }
        const Vec4 found = grid.velocity_change[flat] - before[f].velocity_change[flat];
        if (nearest < 0.3 * h) {  // all particles within 1.5 h along each axis are in cells beside the membrane
          const double by_hand =
              slope * (x[1] * held[flat].mass - held[flat].moment[1]) / grid.sum[flat][3];  // with cloth
          CHECK(found[0] == within(by_hand, 1e-12));
          CHECK(grid.velocity[flat][0] - before[f].velocity[flat][0] == within(by_hand, 1e-12));
          corrected += std::abs(by_hand) > 0.1 * slope * h;
        } else if (nearest > reach * h) {
          CHECK(found[0] == 0);
          CHECK(found[1] == 0);
          ++far;
        }
      }
    });
  }
  CHECK(corrected > 10);
  CHECK(far > 10);
}

}  // namespace

TEST_CASE("A linear change of velocity is known at nodes beside the membrane, and far away nothing changes") {
  check_linear<2>("cases/ellipse_release.toml", "0.25", 5);
  check_linear<3>("cases/verification/sphere_release_3d.toml", "0.25", 5.5);
}

namespace {

/// sum m |a|^2 before and sum m a . a' with the a' after the correction.
template <int Dim, class F>
std::array<double, 2> energies(const std::string& path, const std::string& spacing, F&& change) {
  BeforeJoin<Dim> run(path, spacing);
  run.set_change(change);
  const Grids<Dim> before = run.grids;
  correct_mass_at_membranes(run.state, run.grids);
  std::array<double, 2> out{};
  for (std::size_t f = 0; f < run.grids.size(); ++f)
    for (int node = 0; node < run.grids[f].layout.nodes(); ++node)
      for (int a = 0; a < Dim && run.grids[f].sum[node][3] > 0; ++a) {
        const double mass = run.grids[f].sum[node][3], was = before[f].velocity_change[node][a];
        out[0] += mass * was * was;
        out[1] += mass * was * run.grids[f].velocity_change[node][a];
      }
  return out;
}

}  // namespace

TEST_CASE("Forces do between once and twice the work that they do on lumped masses: the bound of the time step") {
  // Short waves along one axis: nodes of opposite sign, the least that a mass of splines has, 1/15 to 2/5 of the
  // lumped.
  const auto short_wave = [](const auto& x) { return Vec4{std::cos(x[0] * 4 * std::acos(-1.0)), 0, 0, 0}; };
  const auto rough = [](const auto& x) {
    return Vec4{std::sin(91 * x[0] + 57 * x[1]), std::cos(83 * x[0] * x[1]), 0, 0};
  };
  for (const auto& [lumped, corrected] :
       {energies<2>("cases/ellipse_release.toml", "0.25", short_wave),
        energies<2>("cases/ellipse_release.toml", "0.25", rough),
        energies<3>("cases/verification/sphere_release_3d.toml", "0.25", short_wave)}) {
    CHECK(corrected > 1.01 * lumped);
    CHECK(corrected < 2 * lumped);
  }
}

TEST_CASE("Momentum is kept to round-off, walls included; a uniform change stays as it is") {
  BeforeJoin<2> run("cases/ellipse_release.toml", "0.5");
  const double height = run.scene.grid.upper[1] - run.scene.grid.lower[1];
  run.set_change([&](const std::array<double, 2>& x) { return Vec4{0.7, std::sin(9 * x[0] / height), 0, 0}; });
  const Grids<2> before = run.grids;
  correct_mass_at_membranes(run.state, run.grids);
  for (std::size_t f = 0; f < run.grids.size(); ++f) {
    const Grid<2>& grid = run.grids[f];
    double momentum = 0, size = 0;
    for (int flat = 0; flat < grid.layout.nodes(); ++flat) {
      if (grid.sum[flat][3] <= 0) continue;
      const Vec4 change = grid.velocity_change[flat] - before[f].velocity_change[flat];
      momentum += grid.sum[flat][3] * change[1];
      size += grid.sum[flat][3] * std::abs(change[1]);
      if (grid.velocity_change[flat][0] != 0) CHECK(grid.velocity_change[flat][0] == near(0.7, 1e-14));
    }
    CHECK(size > 1);
    CHECK(momentum == near_zero(1e-12 * size));
  }
}
