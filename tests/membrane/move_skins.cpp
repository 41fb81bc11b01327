// A sharp skin moves with the body inside it, and where that has left it with what is around.
#include "membrane/move_skins.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "grid/momentum.hpp"
#include "membrane/membrane_force.hpp"
#include "support/near.hpp"
#include "support/sharp_box.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double dt = 0.01;
constexpr Vec4 of_body{-3, 4, 0, 0}, of_water{2, -1, 0, 0};

/// A skin from x = 2.75 to 5.8 m around a body that the nodes up to `last` m along x know of.
struct SkinnedBody : SharpBox {
  explicit SkinnedBody(int last) {
    skin().mass.assign(skin().nodes(), 0.0);
    std::fill(around().velocity.begin(), around().velocity.end(), of_water);
    std::fill(inside().velocity.begin(), inside().velocity.end(), of_body);
    for_each_node(inside().layout, 0, [&](int node, const std::array<int, 2>& at) {
      inside().sum[node][3] = at[0] <= last ? box_density : 0.0;
    });
  }

  Vec<2> node(std::size_t k) { return vector_at(skin().x, (k + skin().nodes()) % skin().nodes()); }

  /// Where a node that is empty by `empty` goes.
  Vec<2> expected(std::size_t k, double empty) {
    const Vec4 v = (1 - empty) * of_body + empty * of_water;
    return node(k) + dt * Vec<2>(v[0], v[1]) +
           0.1 * empty * ((node(k + skin().nodes() - 1) + node(k + 1)) / 2 - node(k));
  }
};

}  // namespace

TEST_CASE("The skin of a full body goes with it, at its corners, too; nobody else moves it") {
  SkinnedBody box(12);
  const Membrane<2> before = box.skin();
  SolverSpec solver;
  solver.transfer = Transfer::tpic;
  for (const Grid<2>& grid : box.grids) grid_to_membranes(solver, box.state, grid, dt);
  CHECK(box.skin().x == before.x);
  move_skins(box.state, box.grids, dt);
  for (std::size_t k = 0; k < before.nodes(); ++k) {
    CHECK(box.skin().x[0][k] == near(before.x[0][k] - 3 * dt, 1e-14));
    CHECK(box.skin().x[1][k] == near(before.x[1][k] + 4 * dt, 1e-14));
    CHECK(box.skin().v[1][k] == near(4, 1e-14));
  }
  CHECK(box.state.drift == near(4 * dt, 1e-14));
}

TEST_CASE("A tip that its body has left goes with what is around, and draws back; partly left, in between") {
  for (const auto& [last, empty] :
       {std::pair{4, 1.0}, std::pair{5, 2 * 0.755 - 1}}) {  // splines at 5.8 m: 0.245 to 5 m
    CAPTURE(last);
    SkinnedBody box(last), before(last);
    move_skins(box.state, box.grids, dt);
    int at_the_tip = 0;
    for (std::size_t k = 0; k < box.skin().nodes(); ++k) {
      const Vec<2> x = before.node(k);
      if (x[0] > 3.5 && x[0] < 5.79) continue;
      const Vec<2> to = before.expected(k, x[0] > 4 ? empty : 0.0);
      CHECK(box.skin().x[0][k] == near(to[0], 1e-12));
      CHECK(box.skin().x[1][k] == near(to[1], 1e-12));
      at_the_tip += x[0] > 4;
    }
    CHECK(at_the_tip > 3);
  }
}

TEST_CASE("Velocities of nodes that know next to nothing of the body move its skin by next to nothing") {
  SkinnedBody box(5), before(5);
  for_each_node(box.inside().layout, 0, [&](int node, const std::array<int, 2>& at) {
    if (at[0] != 6) return;
    box.inside().sum[node][3] = 1e-7;
    box.inside().velocity[node] = Vec4{1e4, 1e4, 0, 0};
  });
  move_skins(box.state, box.grids, dt);
  int at_the_tip = 0;
  for (std::size_t k = 0; k < box.skin().nodes(); ++k) {
    if (before.node(k)[0] < 5.79) continue;
    const Vec<2> to = before.expected(k, 2 * 0.755 - 1);
    CHECK((box.node(k) - to).norm() < 1e-5);
    ++at_the_tip;
  }
  CHECK(at_the_tip > 3);
}

TEST_CASE("An empty skin draws together step by step") {
  SkinnedBody box(-1);
  std::fill(box.around().velocity.begin(), box.around().velocity.end(), Vec4{});
  const auto length = [&] {
    double sum = 0;
    for (std::size_t k = 0; k < box.skin().nodes(); ++k) sum += (box.node(k + 1) - box.node(k)).norm();
    return sum;
  };
  const double at_first = length();
  for (int k = 0; k < 200; ++k) move_skins(box.state, box.grids, dt);
  CHECK(length() < 0.3 * at_first);
}

TEST_CASE("A membrane with mass or stiffness, or without a sharp interface, is no sharp skin") {
  SharpBox box;
  CHECK_FALSE(is_sharp_skin(box.skin()));
  box.skin().mass.assign(box.skin().nodes(), 0.0);
  CHECK(is_sharp_skin(box.skin()));
  box.skin().axial_stiffness = 1;
  CHECK_FALSE(is_sharp_skin(box.skin()));
  box.skin().axial_stiffness = 0;
  box.skin().sharp = false;
  CHECK_FALSE(is_sharp_skin(box.skin()));
}

TEST_CASE("A skin that waits to be placed does not move") {
  SkinnedBody box(12), before(12);
  box.skin().field = waiting;
  move_skins(box.state, box.grids, dt);
  CHECK(box.skin().x == before.skin().x);
}
