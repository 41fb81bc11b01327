// Sorting: stable, complete, by slab and cell; particles that are nowhere are reported by name.
#include "grid/sort_particles.hpp"

#include <doctest/doctest.h>
#include <geodrop/base/error.hpp>

#include <limits>
#include <string>

#include "support/random_particles.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

/// 20 cells per axis of 0.5 m: several slabs and blocks.
template <int Dim>
struct Sorted {
  Grid<Dim> grid = make_grid<Dim>(box_scene<Dim>(20, 0.5, WallKind::slip));
  State<Dim> state, before;

  explicit Sorted(double low = 0, double high = 10) {
    Random random;
    state.bodies = {random_body<Dim>(3000, low, high, random)};
    for (std::size_t p = 0; p < 100; ++p)  // many in one cell, to see their order
      for (int a = 0; a < Dim; ++a) state.bodies[0].x[a][p * 7] = random.uniform(4.8, 5.2);
    state.drift = -1;
    before = state;
    sort_particles(state, grid);
  }
};

template <int Dim>
std::array<int, Dim> base_of(const Body<Dim>& body, const GridLayout<Dim>& layout, std::size_t p) {
  std::array<int, Dim> base;
  for (int a = 0; a < Dim; ++a) base[a] = layout.base(a, body.x[a][p]);
  return base;
}

template <int Dim>
int slab_of(const GridLayout<Dim>& layout, const std::array<int, Dim>& base) {
  int slab = base[1] / slab_width<Dim>;
  if constexpr (Dim == 3) slab += base[2] / slab_width<Dim> * layout.slabs[1];
  return slab;
}

/// Every particle is there once, all its values moved with it.
template <int Dim>
void check_complete(const Body<Dim>& after, const Body<Dim>& before) {
  std::vector<int> seen(before.size(), 0);
  std::size_t wrong = 0;
  for (std::size_t p = 0; p < after.size(); ++p) {
    const std::uint32_t id = after.id[p];
    REQUIRE(id < before.size());
    ++seen[id];
    for (int a = 0; a < Dim; ++a) wrong += after.x[a][p] != before.x[a][id] || after.v[a][p] != before.v[a][id];
    for (int c = 0; c < Dim * Dim; ++c) wrong += after.affine[c][p] != before.affine[c][id];
    for (int c = 0; c < stress_components<Dim>; ++c) wrong += after.stress[c][p] != before.stress[c][id];
    wrong += after.mass[p] != before.mass[id] || after.J[p] != before.J[id];
  }
  CHECK(wrong == 0);
  CHECK(std::count(seen.begin(), seen.end(), 1) == static_cast<std::ptrdiff_t>(before.size()));
}

/// Cell by cell without interruption, ids ascending within a cell, slabs where slab_begin says.
template <int Dim>
void check_order(const Body<Dim>& body, const GridLayout<Dim>& layout) {
  std::size_t wrong_slab = 0, unstable = 0, split_cells = 0;
  for (int s = 0; s < layout.slab_count(); ++s)
    for (std::size_t p = body.slab_begin[s]; p < body.slab_begin[s + 1]; ++p)
      wrong_slab += slab_of<Dim>(layout, base_of(body, layout, p)) != s;
  std::vector<int> finished(layout.nodes(), 0);
  for (std::size_t p = 1; p < body.size(); ++p) {
    const int last = layout.index(base_of(body, layout, p - 1)), cell = layout.index(base_of(body, layout, p));
    if (cell == last) {
      unstable += body.id[p] < body.id[p - 1];
    } else {
      finished[last] = 1;
      split_cells += finished[cell];
    }
  }
  CHECK(body.slab_begin.size() == static_cast<std::size_t>(layout.slab_count()) + 1);
  CHECK(body.slab_begin.back() == body.size());
  CHECK(wrong_slab == 0);
  CHECK(unstable == 0);
  CHECK(split_cells == 0);
}

std::string error_of(State<2>& state, Grid<2>& grid) {
  try {
    sort_particles(state, grid);
  } catch (const RunError& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("Sorting keeps every particle with all that it carries") {
  const Sorted<2> flat;
  check_complete(flat.state.bodies[0], flat.before.bodies[0]);
  const Sorted<3> space;
  check_complete(space.state.bodies[0], space.before.bodies[0]);
}

TEST_CASE("Sorted particles lie cell by cell in their slabs, in the order of their ids") {
  const Sorted<2> flat;
  check_order(flat.state.bodies[0], flat.grid.layout);
  const Sorted<3> space;
  check_order(space.state.bodies[0], space.grid.layout);
}

TEST_CASE("Particles with empty slabs below, between and above them are sorted as well") {
  Grid<3> grid = make_grid<3>(box_scene<3>(40, 0.5, WallKind::slip));
  State<3> state;
  Random random;
  state.bodies = {random_body<3>(3000, 4.1, 9.9, random)};
  for (std::size_t p = 0; p < 1500; ++p) state.bodies[0].x[1][p] += 8;
  state.drift = -1;
  const State<3> before = state;
  sort_particles(state, grid);
  check_complete(state.bodies[0], before.bodies[0]);
  check_order(state.bodies[0], grid.layout);
}

TEST_CASE("Slabs of one colour share no node, not even after one cell of drift") {
  // Base cells of slab s: [W s, W s + W - 1]. Drift 1, support 1: nodes [W s - 2, W s + W + 1].
  CHECK(2 * slab_width<2> - 2 > slab_width<2> + 1);
  CHECK(2 * slab_width<3> - 2 > slab_width<3> + 1);
}

TEST_CASE("Nothing is sorted before the drift may have reached a cell") {
  Sorted<2> run;
  Body<2>& body = run.state.bodies[0];
  std::swap(body.x[0].front(), body.x[0].back());  // out of order now
  std::iota(body.id.begin(), body.id.end(), 0U);   // stable: order before this sort
  const Array<std::uint32_t> order = body.id;
  run.state.drift = 0.98 * 0.5;
  sort_particles(run.state, run.grid);
  CHECK(body.id == order);
  CHECK(run.state.drift == 0.98 * 0.5);
  run.state.drift = 0.5;
  sort_particles(run.state, run.grid);
  CHECK(body.id != order);
  CHECK(run.state.drift == 0);
  check_order(body, run.grid.layout);
}

TEST_CASE("Active blocks hold every node that a particle can reach with one cell of drift, and not the far ones") {
  const Sorted<2> run(0, 6);  // base 12 + pad 2 + reach 2: just into the block of nodes 16 and up
  const GridLayout<2>& layout = run.grid.layout;
  const auto block_of = [&](int x, int y) {
    const int bx = (x + GridLayout<2>::pad) / GridLayout<2>::block_width[0];
    const int by = (y + GridLayout<2>::pad) / GridLayout<2>::block_width[1];
    return static_cast<std::uint32_t>(bx + by * layout.blocks[0]);
  };
  const auto& active = run.grid.active_blocks;
  CHECK(std::is_sorted(active.begin(), active.end()));
  const Body<2>& body = run.state.bodies[0];
  std::size_t missing = 0;
  for (std::size_t p = 0; p < body.size(); ++p)
    for (const double dx : {-0.5, 0.0, 0.5})
      for (const double dy : {-0.5, 0.0, 0.5})
        for (int i = -1; i <= 1; ++i)
          for (int j = -1; j <= 1; ++j) {
            const double x = std::max(0.0, body.x[0][p] + dx), y = std::max(0.0, body.x[1][p] + dy);
            const std::uint32_t block = block_of(layout.base(0, x) + i, layout.base(1, y) + j);
            missing += !std::binary_search(active.begin(), active.end(), block);
          }
  CHECK(missing == 0);
  CHECK_FALSE(std::binary_search(active.begin(), active.end(), block_of(20, 22)));
  CHECK(active.size() < static_cast<std::size_t>(layout.block_count()));
}

TEST_CASE("Fields of a block that particles left are zero") {
  Sorted<2> run(0, 3);
  std::fill(run.grid.velocity.begin(), run.grid.velocity.end(), Vec4{1, 1, 1, 1});
  std::fill(run.grid.sum.begin(), run.grid.sum.end(), Vec4{1, 1, 1, 1});
  activate_all_blocks(run.grid);
  run.state.drift = -1;
  sort_particles(run.state, run.grid);
  const int far = run.grid.layout.index({20, 20});
  CHECK(largest_component(run.grid.velocity[far]) == 0);
  CHECK(largest_component(run.grid.sum[far]) == 0);
}

TEST_CASE("A particle outside or not a number is an error that names body and particle") {
  for (const double bad :
       {-0.01, 10.01, 1e300, std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity()})
    for (int axis = 0; axis < 2; ++axis) {
      CAPTURE(bad);
      Sorted<2> run;
      Body<2>& body = run.state.bodies[0];
      body.name = "bag";
      body.x[axis][1234] = bad;
      run.state.drift = -1;
      const std::string id = std::to_string(body.id[1234]), text = error_of(run.state, run.grid);
      CHECK(text.find("'bag'") != std::string::npos);
      CHECK(text.find("id " + id + " ") != std::string::npos);
    }
}

TEST_CASE("Particles on the walls themselves are inside") {
  Sorted<2> run;
  Body<2>& body = run.state.bodies[0];
  body.x[0][0] = 0;
  body.x[0][1] = 10;
  body.x[1][2] = 0;
  body.x[1][3] = 10;
  std::iota(body.id.begin(), body.id.end(), 0U);
  run.state.drift = -1;
  CHECK(error_of(run.state, run.grid).empty());
  check_order(body, run.grid.layout);
}

TEST_CASE("A particle without volume is an error that names body, particle and J") {
  for (const double bad : {0.0, -0.25, std::numeric_limits<double>::quiet_NaN()}) {
    CAPTURE(bad);
    Sorted<2> run;
    Body<2>& body = run.state.bodies[0];
    body.name = "bag";
    body.J[1234] = bad;
    run.state.drift = -1;
    const std::string id = std::to_string(body.id[1234]), text = error_of(run.state, run.grid);
    CHECK(text.find("'bag', particle id " + id + " has no volume left (J = ") != std::string::npos);
  }
}
