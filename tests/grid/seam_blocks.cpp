// Blocks on both sides of a periodic seam are awake together: what one holds, the other holds too.
#include <doctest/doctest.h>

#include "support/random_particles.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

/// Whether the blocks of stored nodes are active, by flat node index.
std::vector<bool> awake_nodes(const Grid<2>& grid) {
  const GridLayout<2>& layout = grid.layout;
  std::vector<bool> awake(layout.nodes(), false);
  for (int j = 0; j < layout.stored[1]; ++j)
    for (int i = 0; i < layout.stored[0]; ++i) {
      const int block = i / GridLayout<2>::block_width[0] + j / GridLayout<2>::block_width[1] * layout.blocks[0];
      awake[i + j * layout.stride[1]] = std::find(grid.active_blocks.begin(), grid.active_blocks.end(),
                                                  static_cast<std::uint32_t>(block)) != grid.active_blocks.end();
    }
  return awake;
}

/// A particle at a place in a box with a seam along one axis.
Grid<2> grid_around(int cells, int axis, std::array<double, 2> x) {
  Scene scene = box_scene<2>(cells, 1.0, WallKind::slip);
  scene.walls.lower[axis] = scene.walls.upper[axis] = WallKind::periodic;
  Grid<2> grid = make_grid<2>(scene);
  State<2> state;
  state.bodies = {blank_body<2>(LinearElastic{1000, 2e6, 1e6}, 1)};
  for (int a = 0; a < 2; ++a) state.bodies[0].x[a][0] = x[a];
  state.drift = -1;
  sort_particles(state, grid);
  return grid;
}

}  // namespace

TEST_CASE("A node beside a seam and its image are awake together, wherever blocks begin") {
  for (int cells = 8; cells <= 24; ++cells)
    for (int axis = 0; axis < 2; ++axis)
      for (const double across : {0.1, cells - 0.1}) {
        CAPTURE(cells);
        CAPTURE(axis);
        CAPTURE(across);
        std::array<double, 2> x{0.5 * cells, 0.5 * cells};
        x[axis] = across;
        const Grid<2> grid = grid_around(cells, axis, x);
        const std::vector<bool> awake = awake_nodes(grid);
        const GridLayout<2>& layout = grid.layout;
        bool any = false;
        for (int along = 0; along < layout.stored[1 - axis]; ++along)
          for (int node = 0; node <= 2 * GridLayout<2>::pad; ++node) {
            const int flat = node * layout.stride[axis] + along * layout.stride[1 - axis];
            CHECK(awake[flat] == awake[flat + cells * layout.stride[axis]]);
            any = any || awake[flat];
          }
        CHECK(any);
      }
}
