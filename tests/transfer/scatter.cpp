// Particles to grid: mass, momentum, angular momentum and volume arrive whole; stress pushes as its gradient says.
#include <doctest/doctest.h>

#include "support/near.hpp"
#include "support/random_particles.hpp"
#include "transfer/kernels.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

constexpr double h = 0.5, dt = 0.01;

/// Random particles of a 10 x 10 (x 10) box, far enough from its walls that no ghost is touched.
template <int Dim>
struct Scattered {
  Random random;
  Body<Dim> body = random_body<Dim>(500, 1.01 * h, 8.99 * h, random);
  Grid<Dim> grid;
  explicit Scattered(Transfer transfer) : grid(make_grid<Dim>(box_scene<Dim>(10, h, WallKind::slip, transfer))) {
    // Two ranges that do not divide into whole chunks or packets.
    scatter<Dim>(body, grid, dt, 0, 333);
    scatter<Dim>(body, grid, dt, 333, 500);
  }
};

template <int Dim>
Eigen::Matrix<double, Dim, Dim> affine(const Body<Dim>& body, std::size_t p) {
  Eigen::Matrix<double, Dim, Dim> C;
  for (int a = 0; a < Dim; ++a)
    for (int b = 0; b < Dim; ++b) C(a, b) = body.affine[a * Dim + b][p];
  return C;
}

/// Moment tensor sum x (m v)^T: its antisymmetric part is the angular momentum. A particle of affine rate C brings
/// m (x v^T + h^2/4 C^T), h^2/4 being the inertia of the spline.
template <int Dim>
Eigen::Matrix<double, Dim, Dim> particle_moment(const Body<Dim>& body) {
  Eigen::Matrix<double, Dim, Dim> sum = Eigen::Matrix<double, Dim, Dim>::Zero();
  for (std::size_t p = 0; p < body.size(); ++p) {
    Vec<Dim> x, v;
    for (int a = 0; a < Dim; ++a) {
      x[a] = body.x[a][p];
      v[a] = body.v[a][p];
    }
    sum += body.mass[p] * (x * v.transpose() + h * h / 4 * affine(body, p).transpose());
  }
  return sum;
}

template <int Dim>
void check_conservation(Transfer transfer) {
  const Scattered<Dim> s(transfer);
  double mass = 0, volume = 0, grid_mass = 0, grid_volume = 0;
  Vec<Dim> momentum = Vec<Dim>::Zero(), grid_momentum = Vec<Dim>::Zero();
  for (std::size_t p = 0; p < s.body.size(); ++p) {
    mass += s.body.mass[p];
    volume += s.body.volume(p);
    for (int a = 0; a < Dim; ++a) momentum[a] += s.body.mass[p] * s.body.v[a][p];
  }
  for_each_node(s.grid.layout, 2, [&](int flat, const auto&) {
    grid_mass += s.grid.sum[flat][3];
    if constexpr (Dim == 2)
      grid_volume += s.grid.sum[flat][2];
    else if (!s.grid.force.empty())
      grid_volume += s.grid.force[flat][3];
    for (int a = 0; a < Dim; ++a) grid_momentum[a] += s.grid.sum[flat][a];
  });
  CHECK(grid_mass == near(mass, 1e-13));
  if (Dim == 2 || !s.grid.force.empty()) CHECK(grid_volume == near(volume, 1e-13));
  // The stresses of a particle have no resultant, so this holds with dt f among the momentum, too.
  CHECK((grid_momentum - momentum).norm() < 1e-12 * momentum.norm());
}

}  // namespace

TEST_CASE("Mass, volume and momentum arrive whole") {
  check_conservation<2>(Transfer::tpic);
  check_conservation<2>(Transfer::blend);
  check_conservation<3>(Transfer::tpic);
  check_conservation<3>(Transfer::blend);
}

TEST_CASE_TEMPLATE("Angular momentum arrives whole, the spin of the particles included", Size,
                   std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
  constexpr int Dim = Size::value;
  const Scattered<Dim> s(Transfer::blend);
  Eigen::Matrix<double, Dim, Dim> moment = Eigen::Matrix<double, Dim, Dim>::Zero(), torque = moment;
  for_each_node(s.grid.layout, 2, [&](int flat, const std::array<int, Dim>& i) {
    for (int a = 0; a < Dim; ++a)
      for (int b = 0; b < Dim; ++b) {
        moment(a, b) += h * i[a] * s.grid.sum[flat][b];
        torque(a, b) += h * i[a] * s.grid.force[flat][b];
      }
  });
  const auto expected = particle_moment(s.body);
  CHECK((moment - expected).norm() < 1e-12 * expected.norm());
  // sum x_i f_i^T = -sum V sigma: a symmetric stress has no torque.
  Eigen::Matrix<double, Dim, Dim> virial = Eigen::Matrix<double, Dim, Dim>::Zero();
  for (std::size_t p = 0; p < s.body.size(); ++p)
    for (int a = 0; a < Dim; ++a)
      for (int b = 0; b < Dim; ++b) virial(a, b) -= s.body.volume(p) * s.body.stress[stress_index<Dim>(a, b)][p];
  CHECK((torque - virial).norm() < 1e-12 * virial.norm());
}

TEST_CASE_TEMPLATE("Without a record of its own, dt times the force joins the momentum", Size,
                   std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
  constexpr int Dim = Size::value;
  const Scattered<Dim> apart(Transfer::blend), joined(Transfer::tpic);
  REQUIRE(joined.grid.force.empty());
  double worst = 0;
  for_each_node(apart.grid.layout, 2, [&](int flat, const auto&) {
    for (int a = 0; a < Dim; ++a)
      worst = std::max(worst,
                       std::abs(apart.grid.sum[flat][a] + dt * apart.grid.force[flat][a] - joined.grid.sum[flat][a]));
  });
  CHECK(worst < 1e-10);
}

TEST_CASE_TEMPLATE("A uniform stress on a full lattice pushes no interior node", Size, std::integral_constant<int, 2>,
                   std::integral_constant<int, 3>) {
  constexpr int Dim = Size::value;
  Grid<Dim> grid = make_grid<Dim>(box_scene<Dim>(6, h, WallKind::slip, Transfer::blend));
  Body<Dim> body = lattice_body<Dim>(grid.layout, LinearElastic{1000, 1e6, 1e6}, 2);
  const double sigma[6] = {-1e4, 3e4, 7e3, 5e3, -2e3, 4e3};
  for (int c = 0; c < stress_components<Dim>; ++c) body.stress[c].assign(body.size(), sigma[c]);
  scatter<Dim>(body, grid, dt, 0, body.size());
  double worst = 0;
  for_each_node(grid.layout, -2, [&](int flat, const auto&) {
    for (int a = 0; a < Dim; ++a) worst = std::max(worst, std::abs(grid.force[flat][a]));
  });
  CHECK(worst < 1e-10);
}

TEST_CASE("One particle of water on a node pushes the node beside it with V p / 2h of its weight") {
  // x on a node: N' of the nodes beside it is -+1/(2h), N across is (1/8, 3/4, 1/8).
  Grid<2> grid = make_grid<2>(box_scene<2>(8, h, WallKind::slip, Transfer::blend));
  Body<2> body = blank_body<2>(Newtonian{1000, 2e6, 0}, 1);
  body.x = {Array<double>{4 * h}, Array<double>{4 * h}};
  body.mass = {50};
  body.J = {0.98};
  scatter<2>(body, grid, dt, 0, 1);
  const double volume = 0.05 * 0.98, p = 2e6 * (1 / 0.98 - 1);
  CHECK(grid.force[grid.layout.index({5, 4})][0] == near(volume * p * 0.75 / (2 * h), 1e-12));
  CHECK(grid.force[grid.layout.index({3, 4})][0] == near(-volume * p * 0.75 / (2 * h), 1e-12));
  CHECK(grid.force[grid.layout.index({5, 5})][1] == near(volume * p * 0.125 / (2 * h), 1e-12));
  CHECK(grid.sum[grid.layout.index({4, 4})][3] == near(50 * 0.75 * 0.75, 1e-13));
}

TEST_CASE("In a filled cell a body with cell pressure carries only its deviator") {
  Scene scene = box_scene<2>(8, h, WallKind::slip, Transfer::blend);
  Grid<2> grid = make_grid<2>(scene);
  std::fill(grid.cell_flags.begin(), grid.cell_flags.end(), cell_filled);
  Body<2> body = blank_body<2>(LinearElastic{1000, 1e6, 1e6}, 1);
  body.pressure = PressureSupport::cell;
  body.x = {Array<double>{4 * h}, Array<double>{4 * h}};
  const double sigma[4] = {-7e3, -1e3, -4e3, 0};
  for (int c = 0; c < 4; ++c) body.stress[c] = {sigma[c]};
  scatter<2>(body, grid, dt, 0, 1);
  const double weight = body.volume(0) * 0.75 / (2 * h);  // mean stress -4 kPa, deviator (-3, 3, 0) kPa
  CHECK(grid.force[grid.layout.index({5, 4})][0] == near(3e3 * weight, 1e-12));
  CHECK(grid.force[grid.layout.index({4, 5})][1] == near(-3e3 * weight, 1e-12));
}
