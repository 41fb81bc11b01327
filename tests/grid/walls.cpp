// A wall is a mirror: what the grid gets at a wall is what it would get from the particles and their mirror images.
#include <doctest/doctest.h>

#include "grid/momentum.hpp"
#include "grid/sort_particles.hpp"
#include "support/near.hpp"
#include "support/random_particles.hpp"
#include "transfer/kernels.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

/// Particles with their images on the other side of x = 0. For slip the image has the normal velocity and the shear
/// stress reversed. For no-slip all velocity is reversed; of the stresses only xx then has an image.
Body<2> with_images(const Body<2>& body, WallKind wall) {
  const std::size_t n = body.size();
  Body<2> both = blank_body<2>(body.material, 2 * n);
  const double tangential = wall == WallKind::slip ? 1 : -1;
  for (std::size_t p = 0; p < n; ++p)
    for (const std::size_t q : {p, p + n}) {
      const bool image = q != p;
      const double sx = image ? -1 : 1, sy = image ? tangential : 1;
      both.x[0][q] = sx * body.x[0][p];
      both.x[1][q] = body.x[1][p];
      both.v[0][q] = sx * body.v[0][p];
      both.v[1][q] = sy * body.v[1][p];
      both.affine[0][q] = body.affine[0][p];  // dvx/dx: both change sign
      both.affine[1][q] = sx * body.affine[1][p];
      both.affine[2][q] = sx * sy * body.affine[2][p];
      both.affine[3][q] = sy * body.affine[3][p];
      both.mass[q] = body.mass[p];
      both.J[q] = body.J[p];
      for (int c = 0; c < 3; ++c) both.stress[c][q] = body.stress[c][p];
      both.stress[3][q] = sx * body.stress[3][p];
    }
  return both;
}

void check_wall(WallKind wall) {
  Scene half = box_scene<2>(8, 0.5, wall, Transfer::blend);
  Scene whole = half;
  whole.grid.lower[0] = -4;
  Grid<2> folded = make_grid<2>(half), mirrored = make_grid<2>(whole);
  Random random;
  Body<2> body = random_body<2>(200, 0, 2, random);
  for (double& y : body.x[1]) y += 1;  // away from the other walls
  if (wall == WallKind::no_slip)
    for (const int c : {1, 3}) std::fill(body.stress[c].begin(), body.stress[c].end(), 0.0);
  const Body<2> both = with_images(body, wall);
  scatter<2>(body, folded, 0.1, 0, body.size());
  State<2> state;
  activate_all_blocks(folded);
  fold_walls(folded);
  scatter<2>(both, mirrored, 0.1, 0, both.size());
  double worst_sum = 0, worst_force = 0;
  for (int i = 1; i <= 8; ++i)
    for (int j = 0; j <= 8; ++j) {
      const int a = folded.layout.index({i, j}), b = mirrored.layout.index({i + 8, j});
      Vec4 sum = folded.sum[a] - mirrored.sum[b], force = folded.force[a] - mirrored.force[b];
      // Mass and volume fold with sign +1 whatever the wall.
      worst_sum = std::max(worst_sum, largest_component(sum));
      worst_force = std::max(worst_force, largest_component(force));
    }
  CHECK(worst_sum < 1e-12);
  CHECK(worst_force < 1e-7);  // of 1e5 N
}

}  // namespace

TEST_CASE("Folding at a slip wall is the same as particles with mirror images") { check_wall(WallKind::slip); }

TEST_CASE("Folding at a no-slip wall is the same as particles with reversed images") { check_wall(WallKind::no_slip); }

TEST_CASE("Folding at all walls and corners keeps the mass, and leaves nothing beyond the walls") {
  Grid<3> grid = make_grid<3>(box_scene<3>(5, 0.5, WallKind::no_slip, Transfer::blend));
  Random random;
  const Body<3> body = random_body<3>(2000, 0, 2.5, random);
  scatter<3>(body, grid, 0.1, 0, body.size());
  State<3> state;
  activate_all_blocks(grid);
  fold_walls(grid);
  double mass = 0, expected = 0, beyond = 0;
  for (const double m : body.mass) expected += m;
  for_each_node(grid.layout, 0, [&](int flat, const auto&) { mass += grid.sum[flat][3]; });
  for_each_node(grid.layout, 2, [&](int flat, const std::array<int, 3>& i) {
    for (int a = 0; a < 3; ++a)
      if (i[a] < 0 || i[a] > 5) {
        beyond = std::max({beyond, largest_component(grid.sum[flat]), largest_component(grid.force[flat])});
        return;
      }
  });
  CHECK(mass == near(expected, 1e-12));
  CHECK(beyond == 0);
}

TEST_CASE("Visiting the active blocks only gives the same bits as visiting all of the grid") {
  const Scene scene = box_scene<3>(40, 0.5, WallKind::slip, Transfer::blend);
  Random random;
  State<3> state;
  state.drift = -1;
  // One heap in the corner of all lower walls, one at the upper end of x.
  state.bodies = {random_body<3>(500, 0, 2, random), random_body<3>(500, 0, 2, random)};
  for (double& x : state.bodies[1].x[0]) x = 20 - x;
  Grid<3> some = make_grid<3>(scene);
  sort_particles(state, some);
  REQUIRE(some.active_blocks.size() < static_cast<std::size_t>(some.layout.block_count()) / 4);
  for (const Body<3>& body : state.bodies) scatter<3>(body, some, 0.1, 0, body.size());
  Grid<3> all = some;
  State<3> everywhere;
  activate_all_blocks(all);
  fold_walls(some);
  fold_walls(all);
  update_momentum<3>(some, {}, 0.1);
  update_momentum<3>(all, {}, 0.1);
  double worst = 0, ghosts = 0;
  for_each_node(all.layout, 2, [&](int flat, const std::array<int, 3>& i) {
    for (const auto field : {&Grid<3>::sum, &Grid<3>::force, &Grid<3>::velocity, &Grid<3>::velocity_change})
      worst = std::max(worst, largest_component((some.*field)[flat] - (all.*field)[flat]));
    if (i[0] == -1 || i[0] == 41) ghosts = std::max(ghosts, largest_component(some.velocity[flat]));
  });
  CHECK(worst == 0);
  CHECK(ghosts > 0);
}
