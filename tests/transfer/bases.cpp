// What every basis must do: add up to one, reproduce linear fields, have slopes that are derivatives; and what makes
// each of them what it is.
#include <doctest/doctest.h>

#include "support/random_particles.hpp"
#include "transfer/kernels.hpp"
#include "transfer/ranges.hpp"
#include "transfer/transfer_stages.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double h = 0.5, dt = 0.01;

double hat(double s) { return std::max(0.0, 1 - std::abs(s)); }

struct Axis {
  std::vector<double> w, g, node;  ///< of the support, node coordinates seen from the base
};

template <class Basis>
Axis axis_at(double r, double half_size) {
  const auto n = Basis::at(r, half_size);
  if constexpr (Basis::support == 3)
    return {{n.w0, n.w1, n.w2}, {n.g0, n.g1, n.g2}, {-1, 0, 1}};
  else
    return {{n.w0, n.w1}, {n.g0, n.g1}, {0, 1}};
}

template <class Basis>
void check_axis(double half_size) {
  const double low = Basis::support == 3 ? -0.5 : 0.0;
  for (double r = low + 0.0137; r < low + 1; r += 0.031) {
    const Axis here = axis_at<Basis>(r, half_size);
    constexpr double step = 1e-6;
    const Axis before = axis_at<Basis>(r - step, half_size), after = axis_at<Basis>(r + step, half_size);
    double sum = 0, slope = 0, position = 0, stretch = 0;
    for (std::size_t i = 0; i < here.w.size(); ++i) {
      sum += here.w[i];
      slope += here.g[i];
      position += here.w[i] * here.node[i];
      stretch += here.g[i] * here.node[i];
      CHECK(std::abs((after.w[i] - before.w[i]) / (2 * step) - here.g[i]) < 1e-5);
    }
    CHECK(std::abs(sum - 1) < 1e-15);
    CHECK(std::abs(slope) < 1e-14);
    CHECK(std::abs(position - r) < 1e-15);
    CHECK(std::abs(stretch - 1) < 1e-14);
  }
}

template <int Dim, class Policy>
constexpr Basis name_of() {
  if constexpr (std::is_same_v<Policy, Simplex>)
    return Dim == 2 ? Basis::tri3 : Basis::tet4;
  else
    return Policy::name;
}

/// The 12 cells of one body that all tests below share.
template <int Dim, class Policy>
struct RandomBox {
  Random random;
  Body<Dim> body = random_body<Dim>(333, 1.51 * h, 10.49 * h, random);
  Grid<Dim> grid;
  explicit RandomBox(Transfer transfer) {
    constexpr auto make_scene = is_graded<Policy> ? graded_scene<Dim> : box_scene<Dim>;
    Scene scene = make_scene(12, h, WallKind::slip, transfer);
    scene.grid.basis = name_of<Dim, Policy>();
    grid = make_grid<Dim>(scene);
    body.half_size = 0.2;
  }
};

template <int Dim, class Policy>
void check_linear_field() {
  RandomBox<Dim, Policy> box(Transfer::musl);
  Eigen::Matrix<double, Dim, Dim> L;
  for (int a = 0; a < Dim; ++a)
    for (int b = 0; b < Dim; ++b) L(a, b) = box.random.uniform(-2, 2);
  for_each_node(box.grid.layout, 2, [&](int flat, const std::array<int, Dim>& i) {
    for (int a = 0; a < Dim; ++a)
      for (int b = 0; b < Dim; ++b) box.grid.velocity[flat][a] += L(a, b) * box.grid.layout.node(b, i[b]);
  });
  const Body<Dim> before = box.body;
  constexpr Transfer transfer = has_affine<Policy> ? Transfer::tpic : Transfer::musl;
  const GatherOptions options{transfer, dt, 0, 1};
  if (transfer == Transfer::musl) update_velocity<Dim>(box.body, box.grid, options, 0, before.size());
  gather<Dim>(box.body, box.grid, options, 0, before.size());
  double worst = 0;
  for (std::size_t p = 0; p < before.size(); ++p) {
    for (int a = 0; a < Dim; ++a) {
      double v = 0;
      for (int b = 0; b < Dim; ++b) {
        v += L(a, b) * before.x[b][p];
        if (has_affine<Policy>) worst = std::max(worst, std::abs(box.body.affine[a * Dim + b][p] - L(a, b)));
      }
      worst = std::max(worst, std::abs(box.body.v[a][p] - v));
    }
    worst = std::max(worst, std::abs(box.body.J[p] / before.J[p] - 1 - dt * L.trace() - growth_of_spin<Dim>(dt * L)));
  }
  CHECK(worst < (is_graded<Policy> ? 4e-12 : 1e-12));  // slopes of narrow cells are steeper
}

template <int Dim, class Policy>
void check_conservation() {
  RandomBox<Dim, Policy> box(Transfer::blend);
  scatter<Dim>(box.body, box.grid, dt, 0, box.body.size());
  Vec4 grid_sum{}, force{}, body_sum{};
  for_each_node(box.grid.layout, 2, [&](int flat, const auto&) {
    grid_sum += box.grid.sum[flat];
    force += box.grid.force[flat];
  });
  for (std::size_t p = 0; p < box.body.size(); ++p) {
    for (int a = 0; a < Dim; ++a) body_sum[a] += box.body.mass[p] * box.body.v[a][p];
    body_sum[3] += box.body.mass[p];
  }
  if (Dim == 2) grid_sum[2] = 0;  // the volume
  force[3] = 0;
  CHECK(largest_component(grid_sum - body_sum) < 1e-11);
  CHECK(largest_component(force) < 1e-7);
}

/// sum_i f_i . u_i = -sum_p V_p sigma_p : grad u, for random stresses and nodal velocities.
template <int Dim, class Policy>
void check_adjoint() {
  RandomBox<Dim, Policy> box(Transfer::blend);
  scatter<Dim>(box.body, box.grid, dt, 0, box.body.size());
  const Power power = power_of_random_velocity(box.grid, 2, box.random);
  double stored = 0;
  for (std::size_t p = 0; p < box.body.size(); p += chunk_size) {
    const int count = static_cast<int>(std::min<std::size_t>(chunk_size, box.body.size() - p));
    ChunkWeights<Dim, Policy> weights;
    compute_weights<Dim, Policy>(box.grid.layout, pointers(box.body.x, p), box.body.half_size, count, weights);
    for (int k = 0; k < count; ++k) {
      const GatherSums<Dim> sums = sums_of<Dim, Policy, Transfer::tpic>(box.grid, weights, k);
      for (int a = 0; a < Dim; ++a)
        for (int b = 0; b < Dim; ++b)
          stored -= box.body.volume(p + k) * box.body.stress[stress_index<Dim>(a, b)][p + k] * sums.gradient[b][a];
    }
  }
  CHECK(std::abs(power.sum - stored) < 1e-13 * power.size);
}

}  // namespace

TEST_CASE("Along an axis weights add up to one, reproduce positions, and slopes are derivatives") {
  check_axis<Bspline2>(0);
  check_axis<Linear>(0);
  for (const double half_size : {0.05, 0.125, 0.25, 0.5}) check_axis<Gimp>(half_size);
}

TEST_CASE("GIMP is the average of the hat function over the particle's domain") {
  constexpr int slices = 20000;
  for (const double l : {0.1, 0.25, 0.4})
    for (double r = -0.49; r < 0.5; r += 0.07) {
      const Axis axis = axis_at<Gimp>(r, l);
      for (int i = 0; i < 3; ++i) {
        double mean = 0;
        for (int s = 0; s < slices; ++s) mean += hat(r - l + (s + 0.5) / slices * 2 * l - axis.node[i]) / slices;
        CHECK(std::abs(axis.w[i] - mean) < 1e-8);
      }
    }
}

TEST_CASE("GIMP ends at the quadratic spline for domains of a whole cell, at the hat function for points") {
  for (double r = -0.49; r < 0.5; r += 0.07) {
    const Axis wide = axis_at<Gimp>(r, 0.5), spline = axis_at<Bspline2>(r, 0), point = axis_at<Gimp>(r, 1e-9);
    for (int i = 0; i < 3; ++i) {
      CHECK(std::abs(wide.w[i] - spline.w[i]) < 1e-15);
      CHECK(std::abs(wide.g[i] - spline.g[i]) < 1e-15);
      CHECK(std::abs(point.w[i] - hat(r - point.node[i])) < 1e-8);
    }
  }
}

TEST_CASE_TEMPLATE("A linear velocity comes back exactly", Policy, Bspline2, GradedBspline2, Gimp, Linear, Simplex) {
  check_linear_field<2, Policy>();
  check_linear_field<3, Policy>();
}

TEST_CASE_TEMPLATE("Mass and momentum arrive whole, stresses have no resultant", Policy, Bspline2, GradedBspline2, Gimp,
                   Linear, Simplex) {
  check_conservation<2, Policy>();
  check_conservation<3, Policy>();
}

TEST_CASE_TEMPLATE("The gradient is the adjoint of the force", Policy, Bspline2, GradedBspline2, Gimp, Linear,
                   Simplex) {
  check_adjoint<2, Policy>();
  check_adjoint<3, Policy>();
}

namespace {

/// Power of the forces of averaged pressures, and the rate of energy that the averaged volume rates give.
template <int Dim>
void check_nodal_adjoint() {
  Random random;
  Scene scene = box_scene<Dim>(6, h, WallKind::slip, Transfer::blend);
  scene.grid.basis = name_of<Dim, Simplex>();
  scene.bodies[0].pressure = PressureSupport::nodal;
  Grid<Dim> grid = make_grid<Dim>(scene);
  State<Dim> state;
  activate_all_blocks(grid);
  state.bodies = {random_body<Dim>(400, 0.01 * h, 5.99 * h, random)};
  Body<Dim>& body = state.bodies[0];
  body.pressure = PressureSupport::nodal;
  for (int c = 3; c < stress_components<Dim>; ++c) body.stress[c].assign(body.size(), 0.0);
  for (int a = 1; a < 3; ++a) body.stress[a] = body.stress[0];  // isotropic: nothing but pressure
  body.slab_begin.assign(grid.layout.slab_count() + 1, 0);
  std::fill(body.slab_begin.begin() + 1, body.slab_begin.end(), static_cast<std::uint32_t>(body.size()));
  average_nodal_pressure(state, grid);
  particles_to_grid(state, grid, dt);
  const Power power = power_of_random_velocity(grid, 0, random);
  const Body<Dim> before = body;
  const auto volume_ratios_after = [&] {
    body = before;
    std::fill(grid.node_rate.begin(), grid.node_rate.end(), 0.0);
    average_nodal_rate(state, grid);
    gather<Dim>(body, grid, {Transfer::musl, dt, 0, 1}, 0, body.size());
    return body.J;
  };
  const Array<double> forwards = volume_ratios_after();
  for (Vec4& velocity : grid.velocity) velocity = -velocity;
  const Array<double> backwards = volume_ratios_after();
  double stored = 0;  // by what is odd in the velocity: growth by spin is even
  for (std::size_t p = 0; p < body.size(); ++p)
    stored += before.volume(p) * -before.stress[0][p] * (forwards[p] - backwards[p]) / (2 * before.J[p] * dt);
  CHECK(std::abs(power.sum - stored) < 1e-12 * power.size);
  CHECK(std::abs(power.sum) > 1e-6 * power.size);
}

}  // namespace

TEST_CASE("Simplices: averaged pressure and averaged volume rate are an adjoint pair") {
  check_nodal_adjoint<2>();
  check_nodal_adjoint<3>();
}
