// A container that stands in a bed rubs on it: Coulomb friction with the effective pressure.
#include <doctest/doctest.h>

#include <geodrop/base/find_named.hpp>
#include <geodrop/step/pipeline.hpp>

#include <algorithm>
#include <cmath>

#include "cut/interface_constraint.hpp"
#include "grid/momentum.hpp"
#include "support/join.hpp"
#include "support/random_particles.hpp"
#include "support/scene_files.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

/// The container of the main case, coarse, with its lower tip 0.83 m deep in the bed, after some steps and with random
/// velocities; joined with a coefficient of friction.
struct Joined {
  State<2> state;
  Grids<2> grids;
  double energy_before = 0, energy = 0;

  explicit Joined(double friction, double pore_pressure = -1) {
    const Scene scene = read_scene(source_path("cases/dump_kekerdom_undrained.toml"),
                                   {"grid.spacing=0.5", "bodies.container.shape.centre=[0.0, 2.5]",
                                    "bodies.bed.minus=[\"container\"]", "membranes.geotextile.bed_friction=0.5"});
    state = build_state<2>(scene);
    grids = make_grids<2>(scene);
    Pipeline<2> pipeline = build_pipeline<2>(scene);
    for (int k = 0; k < 20; ++k) advance(pipeline, state, grids);
    state.membranes[0].bed_friction = friction;
    if (pore_pressure >= 0)
      for (double& u : find_named(state.bodies, "bed").pore_pressure) u = pore_pressure;
    Random random(7);
    for (Grid<2>& grid : grids) {
      for_each_node(grid.layout, 2, [&](int flat, const auto&) {
        for (int a = 0; a < 2; ++a)
          if (grid.sum[flat][3] > 0) grid.velocity[flat][a] += random.uniform(-0.2, 0.2);
      });
      impose_wall_velocity(grid);
    }
    energy_before = kinetic();
    join(state, grids, 1e-3);
    energy = kinetic();
  }
  double kinetic() const {
    double sum = 0;
    for (const Grid<2>& grid : grids)
      for (std::size_t n = 0; n < grid.sum.size(); ++n)
        for (int a = 0; a < 2; ++a) sum += 0.5 * grid.sum[n][3] * grid.velocity[n][a] * grid.velocity[n][a];
    return sum;
  }
};

double largest_difference(const Joined& a, const Joined& b) {
  double largest = 0;
  for (std::size_t f = 0; f < a.grids.size(); ++f)
    for (std::size_t n = 0; n < a.grids[f].velocity.size(); ++n)
      for (int c = 0; c < 2; ++c)
        largest = std::max(largest, std::abs(a.grids[f].velocity[n][c] - b.grids[f].velocity[n][c]));
  return largest;
}

}  // namespace

TEST_CASE("Friction on the bed takes energy, more of it the rougher the bed") {
  const Joined smooth(0, 0), rough(0.02, 0), rougher(0.2, 0);
  CHECK(smooth.energy < smooth.energy_before);
  CHECK(rough.energy < smooth.energy - 1e-3);
  CHECK(rougher.energy < rough.energy - 1e-3);
}

TEST_CASE("Where water in the pores bears everything there is no friction") {
  CHECK(largest_difference(Joined(0.5, 1e9), Joined(0, 1e9)) == 0);
  CHECK(largest_difference(Joined(0.5, 0), Joined(0, 0)) > 1e-3);
}
