// An impulse on a node without mass, as of a skin that reaches beyond the particles, is handed to the nodes around it.
#include "grid/momentum.hpp"

#include "support/near.hpp"
#include "support/random_particles.hpp"

#include <doctest/doctest.h>

using namespace geodrop;
using namespace geodrop::test;

namespace {

/// Momentum along `axis` that a force of 6 N along it gives within 0.5 s to the neighbour, of 2 kg, of the node that it
/// acts on, which has no mass [N s].
template <int Dim>
double momentum_handed_on(int axis) {
  Grid<Dim> grid = make_grid<Dim>(box_scene<Dim>(12, 0.5, WallKind::slip, Transfer::blend));
  activate_all_blocks(grid);
  std::array<int, Dim> i{};
  i.fill(6);
  const int node = grid.layout.index(i), neighbour = node + 1;
  grid.sum[neighbour][3] = 2;
  grid.force[node][axis] = 6;
  update_momentum<Dim>(grid, {}, 0.5);
  return 2 * grid.velocity[neighbour][axis];
}

}  // namespace

TEST_CASE("The impulse of a node without mass goes to its neighbours, along each axis alone") {
  for (int axis = 0; axis < 2; ++axis) CHECK(momentum_handed_on<2>(axis) == near(3, 1e-12));
  for (int axis = 0; axis < 3; ++axis) CHECK(momentum_handed_on<3>(axis) == near(3, 1e-12));
}
