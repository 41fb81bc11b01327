// The second term of the consistent mass matrix: against the particles' own, momentum kept, walls mirrored.
#include "grid/mass_correction.hpp"

#include <doctest/doctest.h>

#include <numbers>

#include "grid/momentum.hpp"
#include "support/near.hpp"
#include "support/random_particles.hpp"
#include "transfer/kernels.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double h = 0.5;

template <int Dim>
Grid<Dim> consistent_grid(int cells, Basis basis, WallKind wall) {
  Scene scene = box_scene<Dim>(cells, h, wall);
  scene.grid.basis = basis;
  scene.solver.mass_matrix = MassMatrix::consistent;
  return make_grid<Dim>(scene);
}

/// One wave from wall to wall, as slip walls allow it: cos along all axes but a's own, where it is sin.
template <int Dim>
Vec4 standing_wave(const std::array<int, Dim>& node, int cells) {
  Vec4 v{};
  for (int a = 0; a < Dim; ++a) {
    v[a] = 1;
    for (int b = 0; b < Dim; ++b) {
      const double phase = std::numbers::pi * node[b] / cells;
      v[a] *= a == b ? std::sin(phase) : std::cos(phase);
    }
  }
  return v;
}

/// rms over nodes of the difference between the correction and (I - D^-1 M) v as a full lattice of particles has it,
/// over the rms of that.
template <int Dim>
double difference_from_particles(Basis basis, int cells) {
  Grid<Dim> grid = consistent_grid<Dim>(cells, basis, WallKind::slip);
  State<Dim> state;
  activate_all_blocks(grid);
  Body<Dim> body = lattice_body<Dim>(grid.layout, LinearElastic{1000, 2e6, 1e6}, 4);
  const auto sum_of = [&](const auto& u) {
    std::fill(grid.sum.begin(), grid.sum.end(), Vec4{});
    sum_by_mass<Dim>(body, {pointers(u), 1.0}, grid.layout, grid.sum.data(), 0, body.size());
    fold_walls(grid);
  };
  for_each_node(grid.layout, 0, [&](int flat, const auto& i) {
    grid.velocity[flat] = grid.velocity_change[flat] = standing_wave<Dim>(i, cells);
  });
  impose_wall_velocity(grid);
  const Array<Vec4> wave = grid.velocity;
  update_velocity<Dim>(body, grid, {Transfer::musl, 0.0, 0.0, 1.0}, 0, body.size());
  sum_of(body.v);
  correct_mass(grid);
  double difference = 0, size = 0;
  for_each_node(grid.layout, 0, [&](int flat, const auto&) {
    for (int a = 0; a < Dim; ++a) {
      if (std::abs(wave[flat][a]) < 1e-14) continue;  // held by a wall, or at rest
      const double lumped = wave[flat][a] - grid.sum[flat][a] / grid.sum[flat][3];
      difference += std::pow(grid.velocity[flat][a] - wave[flat][a] - lumped, 2);
      size += lumped * lumped;
      CHECK(grid.velocity_change[flat][a] == near(grid.velocity[flat][a], 1e-12));
    }
  });
  return std::sqrt(difference / size);
}

}  // namespace

TEST_CASE("The correction is (I - D^-1 M) v of a full lattice, to second order, walls included") {
  for (const Basis basis : {Basis::bspline2, Basis::linear}) {
    CAPTURE(static_cast<int>(basis));
    const double coarse = difference_from_particles<2>(basis, 8), fine = difference_from_particles<2>(basis, 16);
    CHECK(coarse < 0.05);  // at 16 cells a wave
    if (basis == Basis::bspline2) CHECK(fine < 0.3 * coarse);
    CHECK(fine < 0.03);  // hats: the quadrature by four particles a cell and axis
    CHECK(difference_from_particles<3>(basis, 8) < 0.15);
  }
}

TEST_CASE("Uneven masses: momentum is kept to round-off, a uniform change stays as it is") {
  for (const WallKind wall : {WallKind::slip, WallKind::periodic}) {
    Grid<2> grid = consistent_grid<2>(12, Basis::bspline2, wall);
    State<2> state;
    activate_all_blocks(grid);
    Random random;
    const int margin = 3;
    for_each_node(grid.layout, 0, [&](int flat, const std::array<int, 2>& i) {
      if (std::min(i[0], i[1]) < margin || std::max(i[0], i[1]) > 12 - margin) return;
      grid.sum[flat][3] = random.uniform(0, 1) < 0.3 ? 0.0 : random.uniform(0.01, 5);
      grid.velocity_change[flat] = Vec4{random.uniform(-1, 1), 0.7, 0, 0};
    });
    const Array<Vec4> before = grid.velocity_change;
    correct_mass(grid);
    double momentum = 0, size = 0;
    for_each_node(grid.layout, 0, [&](int flat, const auto&) {
      if (grid.sum[flat][3] <= 0) return;
      momentum += grid.sum[flat][3] * (grid.velocity_change[flat][0] - before[flat][0]);
      size += grid.sum[flat][3] * std::abs(grid.velocity_change[flat][0] - before[flat][0]);
      CHECK(grid.velocity_change[flat][1] == 0.7);
    });
    CHECK(size > 1);
    CHECK(std::abs(momentum) < 1e-14 * size);
  }
}
