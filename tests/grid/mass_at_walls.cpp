// The consistent mass matrix beside a wall, by hand: nodes there hold half a cell, and count as if they had it all.
#include <doctest/doctest.h>

#include "grid/mass_correction.hpp"
#include "support/near.hpp"
#include "support/random_particles.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

/// Mass at the wall node (0, 4) and its neighbour (1, 4) only; what the correction adds along the wall to both, where
/// their velocities changed by `at_wall` and `beside` along it.
std::array<double, 2> corrections(double wall_mass, double mass, double at_wall, double beside) {
  Scene scene = box_scene<2>(8, 1.0, WallKind::slip);
  scene.solver.mass_matrix = MassMatrix::consistent;
  Grid<2> grid = make_grid<2>(scene);
  activate_all_blocks(grid);
  const int wall = grid.layout.index({0, 4}), next = grid.layout.index({1, 4}), ghost = grid.layout.index({-1, 4});
  grid.sum[wall][3] = wall_mass;
  grid.sum[next][3] = mass;
  grid.velocity_change[wall][1] = at_wall;
  grid.velocity_change[next][1] = grid.velocity_change[ghost][1] = beside;
  correct_mass(grid);
  CHECK(grid.velocity[next][1] == grid.mass_correction[next][1]);
  return {grid.mass_correction[wall][1], grid.mass_correction[next][1]};
}

}  // namespace

TEST_CASE(
    "A wall node exchanges a quarter of what the lighter of two whole nodes allows, with both of its neighbours") {
  // As whole nodes 2 and 0.5 kg: the wall node sees its neighbour and its image.
  const std::array<double, 2> light_neighbour = corrections(1, 0.5, 3, 1);
  CHECK(light_neighbour[0] == near(0.25 * 2 * (0.5 / 2) * (3 - 1), 1e-14));
  CHECK(light_neighbour[1] == near(0.25 * (1 - 3), 1e-14));
  CHECK(1 * light_neighbour[0] + 0.5 * light_neighbour[1] == near_zero(1e-15));  // momentum
  // 2 and 8 kg: the wall node is the lighter one.
  const std::array<double, 2> heavy_neighbour = corrections(1, 8, 3, 1);
  CHECK(heavy_neighbour[0] == near(0.25 * 2 * (3 - 1), 1e-14));
  CHECK(heavy_neighbour[1] == near(0.25 * (2.0 / 8) * (1 - 3), 1e-14));
  CHECK(1 * heavy_neighbour[0] + 8 * heavy_neighbour[1] == near_zero(1e-14));
}
