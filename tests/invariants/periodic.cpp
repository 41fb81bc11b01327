// A periodic wall is no place: what crosses it moves as it would in the middle of the domain.
#include <doctest/doctest.h>
#include <geodrop/step/pipeline.hpp>

#include "grid/momentum.hpp"
#include "support/near.hpp"
#include "support/random_particles.hpp"
#include "support/scene_files.hpp"
#include "transfer/kernels.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

/// A jittered, shaken block of soil in shifting water, both drifting; periodic along x and y. `offset` [m] moves
/// everything, across the seams, and keeps the order of the particles in memory as it is by id.
struct Drift {
  Scene scene;
  State<2> state;
  Grids<2> grid;
  Pipeline<2> pipeline;

  Drift(const std::vector<std::string>& overrides, const std::array<double, 2>& offset) {
    scene = read_scene(source_path("tests/scenes/periodic.toml"), overrides);
    state = build_state<2>(scene);
    grid = make_grids<2>(scene);
    pipeline = build_pipeline<2>(scene);
    for (Body<2>& body : state.bodies)
      for (std::size_t p = 0; p < body.size(); ++p) {
        // Velocities that make the bodies swing, not only drift.
        const double x = body.x[0][p], y = body.x[1][p];
        body.v[0][p] += 0.3 * std::sin(2 * x) * std::cos(3 * y);
        body.v[1][p] += 0.2 * std::cos(x + y);
        for (int a = 0; a < 2; ++a) body.x[a][p] = grid.front().layout.wrapped(a, body.x[a][p] + offset[a]);
      }
  }
  void run(int steps) {
    for (int k = 0; k < steps; ++k) advance(pipeline, state, grid);
  }
  std::array<double, 4> momentum_and_mass() const {
    std::array<double, 4> sums{};
    for (const Body<2>& body : state.bodies)
      for (std::size_t p = 0; p < body.size(); ++p) {
        for (int a = 0; a < 2; ++a) sums[a] += body.mass[p] * body.v[a][p];
        sums[2] += body.mass[p];
      }
    return sums;
  }
};

std::vector<std::size_t> by_id(const Body<2>& body) {
  std::vector<std::size_t> index(body.size());
  for (std::size_t p = 0; p < body.size(); ++p) index[body.id[p]] = p;
  return index;
}

/// Largest difference of positions (but for the offset and whole periods) and of velocities.
std::array<double, 2> differences(const Drift& a, const Drift& b, const std::array<double, 2>& offset) {
  std::array<double, 2> worst{};
  for (std::size_t body = 0; body < a.state.bodies.size(); ++body) {
    const Body<2>&one = a.state.bodies[body], &two = b.state.bodies[body];
    const auto in_one = by_id(one), in_two = by_id(two);
    for (std::size_t id = 0; id < one.size(); ++id)
      for (int c = 0; c < 2; ++c) {
        const double period = a.grid.front().layout.upper[c] - a.grid.front().layout.lower[c];
        const double apart = two.x[c][in_two[id]] - one.x[c][in_one[id]] - offset[c];
        worst[0] = std::max(worst[0], std::abs(apart - period * std::round(apart / period)));
        worst[1] = std::max(worst[1], std::abs(two.v[c][in_two[id]] - one.v[c][in_one[id]]));
      }
  }
  return worst;
}

/// Whole cells, so that the particles lie in their cells as before; the block then sits on both seams, on a corner.
constexpr std::array<double, 2> offset{2.5, 2.25};

void check_across(const std::vector<std::string>& overrides) {
  Drift middle(overrides, {0, 0}), seam(overrides, offset);
  middle.run(150);
  seam.run(150);
  const auto apart = differences(middle, seam, offset);
  CHECK(apart[0] < 1e-9);  // of 5 m
  CHECK(apart[1] < 1e-8);  // of 4 m/s; round-off grows with the pressures of 1e6 Pa behind it
}

/// Without shifting, which moves particles without a force, momentum is kept.
const std::vector<std::string> tpic{"bodies.water.shift=false"};
const std::vector<std::string> blend{"bodies.water.shift=false", "solver.transfer=blend", "solver.blend_rate=5"};

void check_momentum(const std::vector<std::string>& overrides) {
  Drift drift(overrides, {0, 0});
  const auto before = drift.momentum_and_mass();
  while (drift.state.t < 4.0) drift.run(1);  // 4 m/s along x: three lengths of 5 m
  const auto after = drift.momentum_and_mass();
  CHECK(after[2] == near(before[2], 1e-14));
  for (int a = 0; a < 2; ++a) CHECK(std::abs(after[a] - before[a]) <= 1e-12 * 4 * before[2]);
  const GridLayout<2>& layout = drift.grid.front().layout;
  for (const Body<2>& body : drift.state.bodies)
    for (int a = 0; a < 2; ++a)
      for (const double x : body.x[a]) {
        CHECK(x >= layout.particle_lower[a] - layout.h);
        CHECK(x <= layout.particle_upper[a] + layout.h);
      }
}

}  // namespace

TEST_CASE("A block on periodic seams moves as it does in the middle (TPIC, cell pressure, shift)") { check_across({}); }

TEST_CASE("A block on periodic seams moves as it does in the middle (blend)") { check_across(blend); }

TEST_CASE("After three domain lengths momentum and mass are those of the start, and all particles are inside") {
  check_momentum(tpic);
  check_momentum(blend);
}

TEST_CASE("Nodes, ghosts and cells on both sides of a periodic seam hold the same bits") {
  Drift drift({}, offset);
  drift.run(20);
  const GridLayout<2>& layout = drift.grid.front().layout;
  int compared = 0;
  test::for_each_node(layout, 2, [&](int flat, const std::array<int, 2>& i) {
    std::array<int, 2> image = i;
    for (int a = 0; a < 2; ++a) image[a] = (i[a] + layout.cells[a]) % layout.cells[a];
    if (image == i) return;
    const int twin = layout.index(image);
    for (int c = 0; c < 4; ++c) CHECK(drift.grid.front().velocity[flat][c] == drift.grid.front().velocity[twin][c]);
    CHECK(drift.grid.front().cell_flags[flat] == drift.grid.front().cell_flags[twin]);
    CHECK(drift.grid.front().cell_pressure[flat] == drift.grid.front().cell_pressure[twin]);
    CHECK(drift.grid.front().volume_rate[flat] == drift.grid.front().volume_rate[twin]);
    ++compared;
  });
  CHECK(compared > 100);
}

TEST_CASE("In three dimensions particles up to a cell beyond periodic walls give what they give inside") {
  Grid<3> beyond = make_grid<3>(test::box_scene<3>(6, 0.5, WallKind::periodic, Transfer::blend)), inside = beyond;
  test::Random random;
  Body<3> body = test::random_body<3>(2000, -0.45, 3.45, random);
  scatter<3>(body, beyond, 0.1, 0, body.size());
  for (int a = 0; a < 3; ++a)
    for (double& x : body.x[a]) x = inside.layout.wrapped(a, x);
  scatter<3>(body, inside, 0.1, 0, body.size());
  State<3> state;
  test::activate_all_blocks(beyond);
  fold_walls(beyond);
  fold_walls(inside);
  double mass = 0, expected = 0, apart = 0;
  for (const double m : body.mass) expected += m;
  test::for_each_node(beyond.layout, 0, [&](int flat, const std::array<int, 3>& i) {
    apart = std::max(apart, test::largest_component(beyond.sum[flat] - inside.sum[flat]));
    apart = std::max(apart, 1e-6 * test::largest_component(beyond.force[flat] - inside.force[flat]));  // of 1e5 N
    if (i[0] < 6 && i[1] < 6 && i[2] < 6) mass += beyond.sum[flat][3];
  });
  CHECK(mass == near(expected, 1e-12));
  CHECK(apart < 1e-11);
}
