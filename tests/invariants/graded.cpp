// A zone as coarse as the grid changes nothing but round-off; grids that are graded in earnest keep what uniform ones
// keep.
#include <doctest/doctest.h>
#include <geodrop/step/pipeline.hpp>

#include <cmath>

#include "support/scene_files.hpp"

using namespace geodrop;

namespace {

template <int Dim>
struct Run {
  Scene scene;
  State<Dim> state;
  Grids<Dim> grid;

  Run(const Scene& scene_in, int steps)
      : scene(scene_in), state(build_state<Dim>(scene)), grid(make_grids<Dim>(scene)) {
    Pipeline<Dim> pipeline = build_pipeline<Dim>(scene);
    for (int k = 0; k < steps; ++k) advance(pipeline, state, grid);
  }
};

/// Largest difference of positions over h, of velocities over the largest one, and of volume ratios.
template <int Dim>
double difference(const Run<Dim>& a, const Run<Dim>& b) {
  double worst = std::abs(a.state.t - b.state.t) / a.state.t;
  for (std::size_t n = 0; n < a.state.bodies.size(); ++n) {
    const Body<Dim>&one = a.state.bodies[n], &two = b.state.bodies[n];
    REQUIRE(one.size() == two.size());
    std::vector<std::size_t> place(two.size());
    for (std::size_t p = 0; p < two.size(); ++p) place[two.id[p]] = p;
    for (std::size_t p = 0; p < one.size(); ++p) {
      const std::size_t q = place[one.id[p]];
      for (int d = 0; d < Dim; ++d) {
        worst = std::max(worst, std::abs(one.x[d][p] - two.x[d][q]) / a.grid.front().layout.h);
        worst = std::max(worst, std::abs(one.v[d][p] - two.v[d][q]) / a.state.v_max);
      }
      worst = std::max(worst, std::abs(one.J[p] - two.J[q]));
    }
  }
  for (std::size_t m = 0; m < a.state.membranes.size(); ++m)
    for (std::size_t k = 0; k < a.state.membranes[m].nodes(); ++k)
      for (int d = 0; d < Dim; ++d)
        worst = std::max(
            worst, std::abs(a.state.membranes[m].x[d][k] - b.state.membranes[m].x[d][k]) / a.grid.front().layout.h);
  return worst;
}

/// Zones of the grid's own spacing along every axis: graded kernels on equal cells.
Scene with_idle_zones(Scene scene) {
  for (int a = 0; a < scene.dimension; ++a) {
    const double length = scene.grid.upper[a] - scene.grid.lower[a];
    scene.grid.refine.push_back(
        {a, scene.grid.lower[a] + 0.3 * length, scene.grid.lower[a] + 0.6 * length, scene.grid.spacing, 1.1, {}});
  }
  return scene;
}

template <int Dim>
void check_idle_zones(const std::string& path, const std::vector<std::string>& overrides, int steps,
                      double allowed = 1e-9) {
  const Scene scene = read_scene(source_path(path), overrides);
  const Run<Dim> uniform(scene, steps), graded(with_idle_zones(scene), steps);
  REQUIRE(graded.grid.front().layout.graded());
  CHECK(graded.grid.front().layout.cells == uniform.grid.front().layout.cells);
  const double worst = difference(uniform, graded);
  MESSAGE(path, ": ", worst);
  CHECK(worst < allowed);
}

}  // namespace

TEST_CASE("Graded kernels on equal cells give what uniform ones give: water, shifting, affine") {
  check_idle_zones<2>("cases/hydrostatic_column.toml", {}, 50);
}

TEST_CASE("Graded kernels on equal cells give what uniform ones give: soil, water, membrane, blend") {
  check_idle_zones<2>("cases/dump_kekerdom_mixture.toml", {"grid.spacing=0.5"}, 30);
}

TEST_CASE("Graded kernels on equal cells give what uniform ones give: a sharp interface") {
  // Pressures on the membrane are iterated to 1e-8 of what they hold back.
  check_idle_zones<2>("cases/verification/fall_free_slip.toml", {"grid.spacing=0.5"}, 30, 1e-5);
}

TEST_CASE("Graded kernels on equal cells give what uniform ones give: MUSL") {
  check_idle_zones<2>("cases/dump_kekerdom_mixture.toml", {"grid.spacing=0.5", "solver.transfer=musl"}, 30);
}

TEST_CASE("Graded kernels on equal cells give what uniform ones give: space") {
  check_idle_zones<3>("cases/hydrostatic_column_3d.toml", {}, 20);
  check_idle_zones<3>("tests/scenes/run_up_3d.toml", {}, 20);
}

TEST_CASE("A box that drifts across fine and coarse cells keeps its momentum, and a uniform motion stays uniform") {
  Scene scene =
      read_scene(source_path("cases/elastic_bar.toml"),
                 {"grid.upper=[30.0, 10.0]", "bodies.bar.shape.lower=[4.0, 4.0]", "bodies.bar.shape.upper=[10.0, 6.0]",
                  "bodies.bar.initial_velocity={type='uniform',value=[1,-0.1]}", "probes.middle.position=[5.0, 5.0]",
                  "grid.refine=[{axis='x',from=11.0,to=12.0,spacing=0.2,growth=1.4}, "
                  "{axis='y',from=4.5,to=5.0,spacing=0.3,growth=1.2}]"});
  const Run<2> run(scene, 400);
  const Body<2>& bar = run.state.bodies[0];
  CHECK(run.state.t > 2);
  double worst = 0;
  for (std::size_t p = 0; p < bar.size(); ++p) {
    worst = std::max({worst, std::abs(bar.v[0][p] - 1), std::abs(bar.v[1][p] + 0.1), std::abs(bar.J[p] - 1)});
    CHECK(std::abs(bar.x[0][p] - bar.initial_x[0][bar.id[p]] - run.state.t) < 1e-9);
  }
  CHECK(worst < 1e-10);
}
