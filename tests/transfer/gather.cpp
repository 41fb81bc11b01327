// Grid to particles: a linear velocity comes back exactly, also beside walls; the limits of the blend; J and the
// adjoint.
#include <doctest/doctest.h>

#include <Eigen/LU>

#include "grid/momentum.hpp"
#include "support/near.hpp"
#include "support/random_particles.hpp"
#include "transfer/kernels.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double h = 0.5, dt = 0.01;

/// v = v0 + L x, random; with `walls` only what slip walls on all sides of the origin allow: v_a = L_aa x_a.
template <int Dim>
struct LinearField {
  Vec<Dim> v0 = Vec<Dim>::Zero();
  Eigen::Matrix<double, Dim, Dim> L = Eigen::Matrix<double, Dim, Dim>::Zero();

  LinearField(Random& random, bool walls) {
    for (int a = 0; a < Dim; ++a)
      for (int b = 0; b < Dim; ++b)
        if (a == b || !walls) L(a, b) = random.uniform(-2, 2);
    if (!walls)
      for (int a = 0; a < Dim; ++a) v0[a] = random.uniform(-2, 2);
  }
  /// Sets the velocity of all nodes, or, with ghosts = 0, of the real ones.
  void put(Grid<Dim>& grid, int ghosts) const {
    for_each_node(grid.layout, ghosts, [&](int flat, const std::array<int, Dim>& i) {
      Vec<Dim> x;
      for (int a = 0; a < Dim; ++a) x[a] = i[a] * h;
      const Vec<Dim> v = v0 + L * x;
      for (int a = 0; a < Dim; ++a) grid.velocity[flat][a] = v[a];
    });
  }
};

/// Largest error of velocity, affine rate, motion and volume change of particles in a linear field.
template <int Dim>
double linear_field_error(const LinearField<Dim>& field, Grid<Dim>& grid, Body<Dim> body) {
  const Body<Dim> before = body;
  gather<Dim>(body, grid, {Transfer::tpic, dt, 0, 1}, 0, body.size());
  const Eigen::Matrix<double, Dim, Dim> motion = Eigen::Matrix<double, Dim, Dim>::Identity() + dt * field.L;
  const bool fluid = std::holds_alternative<Newtonian>(body.material);
  const double growth = fluid ? motion.determinant() : 1 + dt * field.L.trace() + growth_of_spin<Dim>(dt * field.L);
  double worst = 0;
  for (std::size_t p = 0; p < body.size(); ++p) {
    Vec<Dim> x;
    for (int a = 0; a < Dim; ++a) x[a] = before.x[a][p];
    const Vec<Dim> v = field.v0 + field.L * x;
    for (int a = 0; a < Dim; ++a) {
      worst = std::max(worst, std::abs(body.v[a][p] - v[a]));
      worst = std::max(worst, std::abs(body.x[a][p] - x[a] - dt * v[a]));
      for (int b = 0; b < Dim; ++b) worst = std::max(worst, std::abs(body.affine[a * Dim + b][p] - field.L(a, b)));
    }
    worst = std::max(worst, std::abs(body.J[p] - before.J[p] * growth));
  }
  return worst;
}

Grid<2> grid_of_shifting_water() {
  Scene scene = box_scene<2>(8, h, WallKind::slip);
  scene.bodies[0].shift = true;
  scene.bodies[0].shift_speed = 0.5;
  return make_grid<2>(scene);
}

/// Two particles, in the left and in the right half of the box.
Body<2> shifting_water() {
  Body<2> body = blank_body<2>(Newtonian{1000, 2e6, 0}, 2);
  body.shift = true;
  body.shift_speed = 0.5;
  body.x = {Array<double>{0.6, 3.0}, Array<double>{2, 2}};
  return body;
}

}  // namespace

TEST_CASE_TEMPLATE(
    "A linear velocity comes back exactly: value, affine rate, motion, volume by trace and spin or by determinant",
    Size, std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
  constexpr int Dim = Size::value;
  Random random;
  const LinearField<Dim> field(random, false);
  Grid<Dim> grid = make_grid<Dim>(box_scene<Dim>(8, h, WallKind::slip));
  field.put(grid, 2);
  Body<Dim> body = random_body<Dim>(333, 0, 8 * h, random);
  CHECK(linear_field_error<Dim>(field, grid, body) < 1e-12);
  body.material = Newtonian{1000, 2e6, 0};
  CHECK(linear_field_error<Dim>(field, grid, body) < 1e-12);
}

TEST_CASE_TEMPLATE("Beside slip walls a velocity that they allow comes back exactly", Size,
                   std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
  constexpr int Dim = Size::value;
  Random random;
  const LinearField<Dim> field(random, true);
  Grid<Dim> grid = make_grid<Dim>(box_scene<Dim>(8, h, WallKind::slip));
  State<Dim> state;
  activate_all_blocks(grid);
  field.put(grid, 0);
  // update_momentum makes the ghosts; a momentum of m v gives back v.
  for_each_node(grid.layout, 0, [&](int flat, const auto&) {
    grid.sum[flat] = 1e3 * grid.velocity[flat];
    grid.sum[flat][3] = 1e3;
  });
  update_momentum<Dim>(grid, {}, dt);
  CHECK(linear_field_error<Dim>(field, grid, random_body<Dim>(333, 0, 2 * h, random)) < 1e-12);
}

TEST_CASE_TEMPLATE("The gradient that strains the material is the adjoint of the force of its stress", Size,
                   std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
  constexpr int Dim = Size::value;
  // sum_i f_i . u_i = -sum_p V_p sigma_p : grad u, for random stresses and nodal velocities.
  Random random;
  Grid<Dim> grid = make_grid<Dim>(box_scene<Dim>(8, h, WallKind::slip, Transfer::blend));
  const Body<Dim> body = random_body<Dim>(60, h, 7 * h, random);
  scatter<Dim>(body, grid, dt, 0, body.size());
  const Power power = power_of_random_velocity(grid, 2, random);
  ChunkWeights<Dim, Bspline2> weights;
  compute_weights<Dim, Bspline2>(grid.layout, pointers(body.x), body.half_size, 60, weights);
  double stored = 0;
  for (int p = 0; p < 60; ++p) {
    const auto sums = gather_sums<Dim, Bspline2, false>(grid, weights, p);
    for (int a = 0; a < Dim; ++a)
      for (int b = 0; b < Dim; ++b)
        stored -= body.volume(p) * body.stress[stress_index<Dim>(a, b)][p] * sums.gradient[b][a];
  }
  CHECK(std::abs(power.sum - stored) < 1e-13 * power.size);
}

TEST_CASE("With nothing of the grid taken over, a particle keeps its velocity but moves with the grid") {
  Random random;
  Grid<2> grid = make_grid<2>(box_scene<2>(8, h, WallKind::slip, Transfer::blend));
  const LinearField<2> field(random, false);
  field.put(grid, 2);  // velocity_change stays zero
  Body<2> body = random_body<2>(100, 0, 8 * h, random);
  const Body<2> before = body;
  gather<2>(body, grid, {Transfer::blend, dt, 1, 1}, 0, body.size());
  double moved = 0;
  for (std::size_t p = 0; p < body.size(); ++p)
    for (int a = 0; a < 2; ++a) {
      CHECK(body.v[a][p] == before.v[a][p]);
      moved = std::max(moved, std::abs(body.x[a][p] - before.x[a][p]));
    }
  CHECK(moved > 0.5 * dt);
}

TEST_CASE("Between the limits the blend is a (v + dv) + (1 - a) v', and damping multiplies it") {
  Grid<2> grid = make_grid<2>(box_scene<2>(8, h, WallKind::slip, Transfer::blend));
  for_each_node(grid.layout, 2, [&](int flat, const auto&) {
    grid.velocity[flat] = Vec4{2, -1, 0, 0};
    grid.velocity_change[flat] = Vec4{0.5, 0.25, 0, 0};
  });
  Body<2> body = blank_body<2>(LinearElastic{1000, 1e6, 1e6}, 9);
  for (int a = 0; a < 2; ++a) body.x[a].assign(9, 1.7 + a);
  body.v[0].assign(9, 4.0);
  body.v[1].assign(9, 8.0);
  const Maxima maxima = gather<2>(body, grid, {Transfer::blend, dt, 0.75, 0.5}, 0, 9);
  for (int p = 0; p < 9; ++p) {
    CHECK(body.v[0][p] == near(0.5 * (0.75 * 4.5 + 0.25 * 2), 1e-14));
    CHECK(body.v[1][p] == near(0.5 * (0.75 * 8.25 - 0.25 * 1), 1e-14));
    CHECK(body.x[0][p] == near(1.7 + dt * 2, 1e-14));
  }
  CHECK(maxima.speed2 == near(std::pow(body.v[0][0], 2) + std::pow(body.v[1][0], 2), 1e-14));
  CHECK(maxima.displacement == near(dt * 2, 1e-12));
}

TEST_CASE("A speed that is not a number is not lost among the maxima, whichever particle has it") {
  Grid<2> grid = make_grid<2>(box_scene<2>(8, h, WallKind::slip, Transfer::blend));
  for (const std::size_t broken : {0, 63, 64, 129}) {
    Body<2> body = blank_body<2>(LinearElastic{1000, 1e6, 1e6}, 130);
    for (int a = 0; a < 2; ++a) body.x[a].assign(130, 2.0);
    body.v[1][broken] = std::nan("");
    CHECK(std::isnan(gather<2>(body, grid, {Transfer::blend, dt, 1, 1}, 0, 130).speed2));
  }
}

TEST_CASE("In filled cells a body with cell pressure changes volume with its cell, others with their own divergence") {
  Grid<2> grid = make_grid<2>(box_scene<2>(8, h, WallKind::slip));
  Random random;
  const LinearField<2> field(random, false);
  field.put(grid, 2);
  const double outwards = growth_of_spin<2>(dt * field.L);
  const double own = 1 + dt * field.L.trace() + outwards;
  for_each_node(grid.layout, 0, [&](int flat, const std::array<int, 2>& i) {
    grid.cell_flags[flat] = i[0] < 4 ? cell_filled : 0;
    grid.volume_rate[flat] = 3;
  });
  for (const PressureSupport support : {PressureSupport::cell, PressureSupport::particle}) {
    Body<2> body = blank_body<2>(LinearElastic{1000, 2e6, 1e6}, 2);
    body.pressure = support;
    body.x = {Array<double>{1.1, 3.1}, Array<double>{2, 2}};
    gather<2>(body, grid, {Transfer::tpic, dt, 0, 1}, 0, 2);
    CHECK(body.J[0] == near(support == PressureSupport::cell ? 1.03 + outwards : own, 1e-13));
    CHECK(body.J[1] == near(own, 1e-13));
  }
}

TEST_CASE("Water shifts down the gradient of the fill ratio by h dt (|v| + v0), and takes its velocity along") {
  Grid<2> grid = grid_of_shifting_water();
  const double slope = 0.2;  // of the fill ratio along x [1/m]
  for_each_node(grid.layout, 2, [&](int flat, const std::array<int, 2>& i) {
    grid.velocity[flat] = Vec4{3, 4 + 2.0 * h * i[0], 0, 1 + slope * h * i[0]};  // dvy/dx = 2
    grid.cell_flags[flat] = i[0] < 4 ? cell_shiftable : 0;
  });
  Body<2> body = shifting_water();
  gather<2>(body, grid, {Transfer::tpic, dt, 0, 1}, 0, 2);
  const double step = -h * dt * (std::hypot(3, 4 + 2 * 0.6) + 0.5) * slope;
  CHECK(body.x[0][0] == near(0.6 + 3 * dt + step, 1e-13));
  CHECK(body.v[1][0] == near(4 + 2 * 0.6 + 2 * step, 1e-13));
  CHECK(body.x[0][1] == near(3.0 + 3 * dt, 1e-13));
}

TEST_CASE("Water that shifts shrinks where it is crowded, by 10 v0^2 / (h c), and grows where it is thin") {
  Grid<2> grid = grid_of_shifting_water();
  for_each_node(grid.layout, 2, [&](int flat, const std::array<int, 2>& i) {
    grid.velocity[flat] = Vec4{0, 0, 0, 1};
    grid.cell_flags[flat] = cell_filled | cell_shiftable;
    grid.volume_rate[flat] = 0.1;
    grid.crowding[flat] = i[0] < 4 ? 0.04 : -0.02;
  });
  Body<2> body = shifting_water();
  const double rate = 10 * 0.5 * 0.5 / (h * std::sqrt(2e6 / 1000));
  SUBCASE("pressure of cells") {
    body.pressure = PressureSupport::cell;
    gather<2>(body, grid, {Transfer::tpic, dt, 0, 1}, 0, 2);
    CHECK(body.J[0] == near(1 + dt * (0.1 - 0.04 * rate), 1e-13));
    CHECK(body.J[1] == near(1 + dt * (0.1 + 0.02 * rate), 1e-13));
  }
  SUBCASE("pressure of particles") {
    body.pressure = PressureSupport::particle;
    gather<2>(body, grid, {Transfer::tpic, dt, 0, 1}, 0, 2);
    CHECK(body.J[0] == near(1 - dt * 0.04 * rate, 1e-13));
  }
}
