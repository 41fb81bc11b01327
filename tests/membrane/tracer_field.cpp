// Tracers and membranes move with the velocity field of their body, and with no other.
#include <doctest/doctest.h>

#include "membrane/membrane_force.hpp"
#include "support/near.hpp"
#include "support/sharp_box.hpp"

using namespace geodrop;
using namespace geodrop::test;

TEST_CASE("A tracer moves with its own field; one that waits with its body does not move") {
  SharpBox box;
  std::fill(box.around().velocity.begin(), box.around().velocity.end(), Vec4{2, -1, 0, 0});
  std::fill(box.inside().velocity.begin(), box.inside().velocity.end(), Vec4{-3, 4, 0, 0});
  const std::array<double, 2> at{5, 6};
  box.state.tracers = {{"in water", at, {}, at, 0}, {"in bag", at, {}, at, 1}, {"waits", at, {}, at, waiting}};
  for (const Grid<2>& grid : box.grids) grid_to_tracers(box.state, grid, 0.1);
  const auto check_at = [&](int tracer, double x, double y) {
    CHECK(box.state.tracers[tracer].x[0] == near(x, 1e-14));
    CHECK(box.state.tracers[tracer].x[1] == near(y, 1e-14));
  };
  check_at(0, 5.2, 5.9);
  check_at(1, 4.7, 6.4);
  check_at(2, 5, 6);
}

TEST_CASE("A membrane moves with its own field, with the velocity of its nodes") {
  SharpBox box;
  std::fill(box.around().velocity.begin(), box.around().velocity.end(), Vec4{2, -1, 0, 0});
  std::fill(box.inside().velocity.begin(), box.inside().velocity.end(), Vec4{-3, 4, 0, 0});
  const Membrane<2> before = box.skin();
  SolverSpec solver;
  solver.transfer = Transfer::tpic;
  for (const Grid<2>& grid : box.grids) grid_to_membranes(solver, box.state, grid, 0.1);
  for (std::size_t k = 0; k < before.nodes(); ++k) {
    CHECK(box.skin().x[0][k] == near(before.x[0][k] - 0.3, 1e-13));
    CHECK(box.skin().x[1][k] == near(before.x[1][k] + 0.4, 1e-13));
    CHECK(box.skin().v[1][k] == near(4, 1e-13));
  }
}
