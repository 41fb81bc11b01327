// The largest frequency of particles on the nodes around them, by eigenvalues of the whole system of nodes, against
// the bound that the time step takes.
#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>

#include "grid/bases.hpp"
#include "grid/stiffest_mode.hpp"
#include "materials/neo_hookean.hpp"
#include "support/near.hpp"
#include "support/random_particles.hpp"

using namespace geodrop;
using namespace geodrop::test;

namespace {

/// Nodes 0 to side - 1 along each axis, one metre apart; density 1.
constexpr int side = 5;

template <int Dim>
struct Swinging {
  static constexpr int nodes = Dim == 2 ? side * side : side * side * side;
  ElasticSpeeds speeds;
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(nodes * Dim, nodes* Dim);
  Eigen::VectorXd mass = Eigen::VectorXd::Zero(nodes * Dim);

  using Vector = Eigen::Matrix<double, Dim, 1>;

  /// normal: of the membrane.
  void add(const Vector& x, double volume, const Vector& normal) {
    std::array<int, Dim> base;
    std::array<ThreeWeights, Dim> w;
    for (int a = 0; a < Dim; ++a) {
      base[a] = static_cast<int>(std::floor(x[a] + 0.5));
      w[a] = Bspline2::at(x[a] - base[a], 0);
    }
    Eigen::MatrixXd L = Eigen::MatrixXd::Zero(Dim * Dim, nodes * Dim);  // of velocities, row by row
    for (int n = 0; n < (Dim == 2 ? 9 : 27); ++n) {
      const std::array<int, 3> at{n % 3, n / 3 % 3, n / 9};
      int node = 0;
      double N = 1;
      Vector slope = Vector::Ones();
      for (int a = Dim - 1; a >= 0; --a) {
        node = node * side + base[a] + at[a] - 1;
        const double value[3]{w[a].w0, w[a].w1, w[a].w2}, steep[3]{w[a].g0, w[a].g1, w[a].g2};
        N *= value[at[a]];
        for (int b = 0; b < Dim; ++b) slope[b] *= a == b ? steep[at[a]] : value[at[a]];
      }
      for (int i = 0; i < Dim; ++i) {
        mass[node * Dim + i] += volume * N;
        for (int j = 0; j < Dim; ++j) L(i * Dim + j, node * Dim + i) = slope[j];
      }
    }
    stiffness += volume * L.transpose() * elasticity(normal) * L;
  }

  /// lambda (tr L)^2 + 2 G eps : eps + a |stretch of the membrane's plane|^2.
  Eigen::MatrixXd elasticity(const Vector& normal) const {
    const double lambda = speeds.bulk - 2.0 / 3.0 * speeds.shear;
    const auto number = [](int i, int j) { return i * Dim + j; };
    Eigen::MatrixXd D = Eigen::MatrixXd::Zero(Dim * Dim, Dim * Dim);
    for (int i = 0; i < Dim; ++i)
      for (int j = 0; j < Dim; ++j) {
        D(number(i, i), number(j, j)) += lambda;
        D(number(i, j), number(i, j)) += speeds.shear;
        D(number(i, j), number(j, i)) += speeds.shear;
      }
    const Eigen::MatrixXd plane = Eigen::MatrixXd::Identity(Dim, Dim) - normal * normal.transpose();
    const Eigen::VectorXd flat = plane.reshaped();
    D += speeds.membrane / (Dim - 1) * flat * flat.transpose();
    return D;
  }

  double largest_omega_squared() const {
    Eigen::VectorXd root = mass;
    for (double& m : root) m = m > 1e-9 ? 1 / std::sqrt(m) : 0;  // nodes without particles do not move
    const Eigen::MatrixXd of_nodes = root.asDiagonal() * stiffness * root.asDiagonal();
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(of_nodes, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
  }

  double bound() const { return 6 * Dim * stiffest_mode<Dim>(speeds); }
};

/// Fluid, soil, a solid of little volume change, one that hardly shears; with a membrane of none, some, much stiffness.
std::vector<ElasticSpeeds> laws() {
  std::vector<ElasticSpeeds> out;
  for (const double membrane : {0.0, 3.0, 100.0})
    for (const auto& [bulk, shear] : {std::pair{1.0, 0.0}, {1.67, 1.0}, {50.0, 1.0}, {0.0, 1.0}, {0.1, 1.0}})
      out.push_back({bulk, shear, membrane});
  return out;
}

/// Largest frequency squared over its bound, of random particles, and of one alone where splines are steepest.
template <int Dim>
std::pair<double, double> shares_of_bound(const ElasticSpeeds& speeds) {
  using Vector = typename Swinging<Dim>::Vector;
  Random random;
  double crowd = 0, lone = 0;
  const auto direction = [&] { return Vector::NullaryExpr([&] { return random.uniform(-1, 1); }).normalized().eval(); };
  for (int trial = 0; trial < (Dim == 2 ? 20 : 3); ++trial) {
    Swinging<Dim> many{speeds};
    for (int p = 0; p < 12; ++p) {
      const Vector x = Vector::NullaryExpr([&] { return random.uniform(1.5, 2.5 + p % 2); });
      many.add(x, random.uniform(0.1, 1), direction());
    }
    crowd = std::max(crowd, many.largest_omega_squared() / many.bound());
  }
  Swinging<Dim> one{speeds};
  one.add(Vector::Constant(2.4999), 1, Vector::Unit(0));
  lone = one.largest_omega_squared() / one.bound();
  return {crowd, lone};
}

}  // namespace

TEST_CASE("No particles swing faster than sqrt(6 d) c_eff / h, with or without a membrane; a lone one does") {
  for (const ElasticSpeeds& speeds : laws()) {
    CAPTURE(speeds.bulk);
    CAPTURE(speeds.shear);
    CAPTURE(speeds.membrane);
    const auto [crowd_2d, lone_2d] = shares_of_bound<2>(speeds);
    const auto [crowd_3d, lone_3d] = shares_of_bound<3>(speeds);
    CHECK(crowd_2d <= 1);
    CHECK(crowd_3d <= 1);
    CHECK(lone_2d == near(1, 1e-3));
    if (speeds.membrane == 0 || speeds.bulk > speeds.shear) CHECK(lone_3d == near(1, 1e-3));
    CHECK(lone_3d <= 1);
  }
}

TEST_CASE(
    "c_eff of a fluid is the speed of sound; of a solid sqrt((lambda + G) / rho) in plane strain, sqrt(K / rho)") {
  CHECK(stiffest_mode<2>({2500, 0}) == near(2500, 1e-15));
  CHECK(stiffest_mode<3>({2500, 0}) == near(2500, 1e-15));
  CHECK(stiffest_mode<2>({5, 3}) == near(5 + 1.0, 1e-15));  // lambda = 3
  CHECK(stiffest_mode<3>({5, 3}) == near(5, 1e-15));
  CHECK(stiffest_mode<2>({0, 3}) == near(3, 1e-15));  // shear alone
  CHECK(stiffest_mode<2>({0, 0, 7}) == near(3.5, 1e-15));
  CHECK(stiffest_mode<3>({0, 0, 6}) == near(2, 1e-15));
  CHECK(stiffest_mode<3>({0, 3, 6}) == near(4, 1e-15));  // unequal stretches of the membrane's plane: 2 G + a
}

TEST_CASE("Pressures of full cells swing with at most a sixth of the square of those of particles") {
  const auto largest = []<int Dim>(std::integral_constant<int, Dim>) {
    const Grid<Dim> grid = [] {
      Scene scene = box_scene<Dim>(8, 1.0, WallKind::slip);
      return make_grid<Dim>(scene);
    }();
    constexpr int inside = GridLayout<Dim>::pad + 4;
    const auto value = [&](int a) { return grid.integrals[0].value[inside][a]; };
    const auto slope = [&](int a) { return grid.integrals[0].slope[inside][a]; };
    double most = 0;
    for (double wave = 0; wave < 3.2; wave += 0.001) {  // the same along all axes is the fastest
      const double along = std::abs(slope(2) - slope(0)) * std::sin(wave);
      const double across = value(1) + (value(0) + value(2)) * std::cos(wave);
      most = std::max(most, Dim * std::pow(along * std::pow(across, Dim - 1), 2));
    }
    return most;
  };
  CHECK(largest(std::integral_constant<int, 2>()) == near(1.08, 0.01));
  CHECK(largest(std::integral_constant<int, 3>()) == near(1.09, 0.01));
}

TEST_CASE(
    "Second differences of the neo-Hookean energy stay below the bound of its stiffest mode, and reach it at rest") {
  const NeoHookean rubber{1000, 2e6, 1e6};
  Random random;
  using Matrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  const auto energy = [&](const Matrix& F) {
    Gradient<3, double> components;
    for (int c = 0; c < 9; ++c) components[c] = F.data()[c];
    return neo_hookean_energy<3>(rubber, components, F.determinant());
  };
  const auto stiffness = [&](const Matrix& F, const Matrix& L) {
    constexpr double step = 1e-3;
    const Matrix I = Matrix::Identity();
    return (energy((I + step * L) * F) - 2 * energy(F) + energy((I - step * L) * F)) / (step * step);
  };
  const auto bound = [&](const Matrix& F) {
    Gradient<3, double> components;
    for (int c = 0; c < 9; ++c) components[c] = F.data()[c];
    return 3 * neo_hookean_stiffest_mode<3>(rubber, components, F.determinant());
  };
  for (int trial = 0; trial < 300; ++trial) {
    const auto entry = [&] { return random.uniform(-0.4, 0.4); };
    const Matrix F = Matrix::Identity() * random.uniform(0.7, 1.6) + Matrix::NullaryExpr(entry);
    if (F.determinant() < 0.1) continue;
    const Matrix L = Matrix::NullaryExpr(entry).normalized();
    CHECK(stiffness(F, L) <= bound(F) * (1 + 1e-4));
    CHECK(stiffness(F, Matrix::Identity().normalized()) <= bound(F) * (1 + 1e-4));
  }
  CHECK(stiffness(Matrix::Identity(), Matrix::Identity().normalized()) == near(bound(Matrix::Identity()), 1e-5));
}
