// The table of benchmarks: every entry runs and is counted. Nothing here is timed.
#include "bench/benchmarks.hpp"

#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "bench/work_counts.hpp"
#include "support/near.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

struct Moved {
  double before, after, by_speed;
};

/// Share of the particles whose principal stresses lie on the shear planes of a yield surface.
template <int Dim>
double yielding_share(const Body<Dim>& body) {
  const auto& soil = std::get<MohrCoulomb>(body.material);
  int yielding = 0;
  for (std::size_t p = 0; p < body.size(); ++p) {
    const auto s = [&](int c) { return body.stress[c][p]; };
    Eigen::Matrix3d stress;
    if constexpr (Dim == 2)
      stress << s(0), s(3), 0, s(3), s(1), 0, 0, 0, s(2);
    else
      stress << s(0), s(3), s(5), s(3), s(1), s(4), s(5), s(4), s(2);
    const Eigen::Vector3d values = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(stress).eigenvalues();
    const double f = (1 + soil.sin_phi) * values[2] - (1 - soil.sin_phi) * values[0] - 2 * soil.cohesion * soil.cos_phi;
    yielding += f > -1e-9 * stress.norm();
  }
  return yielding / static_cast<double>(body.size());
}

/// Runs a block for so many steps.
template <int Dim>
State<Dim> run_block(const Benchmark& bench, const BlockSize& size, int steps) {
  const Scene scene = block_scene(bench, size);
  State<Dim> state = build_state<Dim>(scene);
  Grids<Dim> grids = make_grids<Dim>(scene);
  Pipeline<Dim> pipeline = build_pipeline<Dim>(scene);
  set_in_motion<Dim>(bench, scene, 1, state);
  for (int step = 0; step < steps; ++step) advance(pipeline, state, grids);
  return state;
}

/// Some steps of a small block.
template <int Dim>
Moved move_block(const Benchmark& bench) {
  const Scene scene = block_scene(bench, {1e3, 1});
  State<Dim> state = build_state<Dim>(scene);
  Grids<Dim> grid = make_grids<Dim>(scene);
  Pipeline<Dim> pipeline = build_pipeline<Dim>(scene);
  set_in_motion<Dim>(bench, scene, 1, state);
  const auto mean = [&] {
    const auto& x = state.bodies[0].x[0];
    return std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
  };
  Moved moved{mean(), 0, 0};
  for (int step = 0; step < 10; ++step) advance(pipeline, state, grid);
  moved.after = mean();
  moved.by_speed = 0.15 * wave_speed(state.bodies[0].material) * state.t;
  return moved;
}

WorkCount work(int dimension, Basis basis, BenchMaterial material = BenchMaterial::water,
               PressureSupport pressure = PressureSupport::particle) {
  return work_of({dimension, basis, material, is_simplex(basis) ? Transfer::musl : Transfer::tpic, pressure});
}

}  // namespace

TEST_CASE("Every benchmark has a name of its own, work, and a block that moves as it should") {
  std::set<std::string> names;
  for (const Benchmark& bench : all_benchmarks()) {
    CAPTURE(bench.name);
    CHECK(names.insert(bench.name).second);
    CHECK(work_of(bench).flops > 100);
    const Moved moved = bench.dimension == 2 ? move_block<2>(bench) : move_block<3>(bench);
    // 0.15 c, over steps of at least h / 2 / (c + |v|), |v| = 0.23 to 0.28 c at the corner: 0.6 cells in ten steps
    CHECK(moved.after - moved.before == near(moved.by_speed, 0.01));
    CHECK(moved.by_speed > 0.55);
  }
}

TEST_CASE("Soil in flow yields nearly everywhere, soil at rest nowhere") {
  const auto share = [](int dimension, bool at_rest) {
    Benchmark bench{{dimension, Basis::bspline2, BenchMaterial::soil, Transfer::tpic, PressureSupport::particle}, ""};
    bench.at_rest = at_rest;
    return dimension == 2 ? yielding_share(run_block<2>(bench, {1e4, 1}, 16).bodies[0])
                          : yielding_share(run_block<3>(bench, {2e4, 1}, 16).bodies[0]);
  };
  for (const int dimension : {2, 3}) {
    // Not at free faces that part; they are the more the smaller the block.
    CHECK(share(dimension, false) > 0.85);
    CHECK(share(dimension, true) == 0);
  }
}

TEST_CASE("The block stays clear of the walls of every domain") {
  for (const int dimension : {2, 3})
    for (const double factor : {1.0, 3.0, 8.0}) {
      const Scene scene = block_scene({{dimension}, ""}, {1e4, factor});
      const auto& box = std::get<BoxShape>(scene.bodies[0].shape);
      CHECK(box.lower[0] >= 8);
      CHECK(box.upper[0] <= scene.grid.upper[0] - 8);
    }
}

TEST_CASE("Operations of water on hat functions in 2D, counted by hand") {
  // Weights, scatter and gather of one axis: 10 each. Law 7 + 2.
  // Scatter: record 2 + 2 (12 + 2), times dt 3, two rows of 8 + 4 + 12 and two nodes of 28.
  // Gather: two rows of 24 and two nodes of 16, plane 24, per axis 8 + 1 + 3 + 4.
  const double expected = 40 + 9 + (30 + 3 + 2 * (24 + 56)) + (2 * (24 + 32) + 24 + 32);
  CHECK(work(2, Basis::linear).flops == expected);
}

TEST_CASE("Operations of water on triangles, counted by hand") {
  // Weights 10 + 3, twice. Law 7 + 2. Scatter: record 30, times dt 3, three nodes of 24. Gather: three nodes of 16,
  // per axis 16. Back to the grid: weights twice, three nodes of 16 gathered and of 16 given.
  CHECK(work(2, Basis::tri3).flops == 26 + 9 + (30 + 3 + 72) + (48 + 32) + (26 + 48 + 48));
}

TEST_CASE("Cell pressure, a wider support and a third dimension are more work") {
  CHECK(work(2, Basis::linear, BenchMaterial::water, PressureSupport::cell).bytes > work(2, Basis::linear).bytes);
  CHECK(work(2, Basis::bspline2).flops > work(2, Basis::linear).flops);
  CHECK(work(3, Basis::gimp).flops > 2 * work(2, Basis::gimp).flops);
}
