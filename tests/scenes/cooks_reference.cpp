// The reference of cooks_membrane: Cook's panel at small strain by finite elements of Taylor and Hood, displacement by
// nine nodes and pressure by four, which do not lock. The elements become finer towards all corners, where stress is
// singular.
#include "support/near.hpp"

#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <Eigen/Sparse>

#include <array>
#include <cmath>
#include <vector>

using geodrop::test::near;

namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr double length = 4.8, clamped = 4.4, edge = 1.6;  // of the sides [m]

struct Solid {
  double lambda, mu;  ///< [Pa]
};
Solid plane_strain(double youngs_modulus, double nu) {
  return {youngs_modulus * nu / (1 + nu) / (1 - 2 * nu), youngs_modulus / (2 * (1 + nu))};
}
Solid plane_stress(double youngs_modulus, double nu) {
  return {youngs_modulus * nu / (1 - nu * nu), youngs_modulus / (2 * (1 + nu))};
}

struct Load {
  double on_edge, weight;  ///< shear stress [Pa], weight per volume [N/m3]
};

/// Displacements along the load [m]: of the corner that is farthest off and of the middle of its edge.
struct Found {
  double corner, middle;
};

double graded(double t) { return t < 0.5 ? 4 * t * t * t : 1 - 4 * (1 - t) * (1 - t) * (1 - t); }

/// n by n elements; nodes of the displacement lie along each side at 0, 1 ... 2 n, those of the pressure at the even.
struct Panel {
  int n;
  Solid solid;
  Load load;

  int side() const { return 2 * n + 1; }
  int node(int i, int j) const { return i * side() + j; }
  int pressure(int i, int j) const { return 2 * side() * side() + i * (n + 1) + j; }
  int unknowns() const { return 2 * side() * side() + (n + 1) * (n + 1); }

  double share(int i) const {
    const auto of = [&](int even) { return graded(0.5 * even / n); };
    return i % 2 == 0 ? of(i) : (of(i - 1) + of(i + 1)) / 2;
  }
  Vector2d place(int i, int j) const {
    const double s = share(i), t = share(j);
    return {length * s, clamped * s * (1 - t) + (clamped + edge * s) * t};
  }
};

constexpr std::array<double, 3> gauss_points{-0.7745966692414834, 0.0, 0.7745966692414834};
constexpr std::array<double, 3> gauss_weights{5.0 / 9, 8.0 / 9, 5.0 / 9};

std::array<double, 3> quadratic(double x) { return {x * (x - 1) / 2, 1 - x * x, x * (x + 1) / 2}; }
std::array<double, 3> quadratic_slope(double x) { return {x - 0.5, -2 * x, x + 0.5}; }
std::array<double, 2> linear(double x) { return {(1 - x) / 2, (1 + x) / 2}; }

struct AtPoint {
  std::array<double, 9> shape;
  std::array<Vector2d, 9> gradient;
  std::array<double, 4> pressure;
  double volume;
};
AtPoint at_point(const Panel& panel, int i, int j, int p, int q) {
  const double x = gauss_points[p], y = gauss_points[q];
  const auto nx = quadratic(x), ny = quadratic(y), dx = quadratic_slope(x), dy = quadratic_slope(y);
  AtPoint out;
  std::array<Vector2d, 9> by_local;
  Matrix2d jacobian = Matrix2d::Zero();  // d place_c / d local_r at (r, c)
  for (int a = 0; a < 9; ++a) {
    out.shape[a] = nx[a / 3] * ny[a % 3];
    by_local[a] = {dx[a / 3] * ny[a % 3], nx[a / 3] * dy[a % 3]};
    jacobian += by_local[a] * panel.place(2 * i + a / 3, 2 * j + a % 3).transpose();
  }
  for (int a = 0; a < 9; ++a) out.gradient[a] = jacobian.inverse() * by_local[a];
  for (int m = 0; m < 4; ++m) out.pressure[m] = linear(x)[m / 2] * linear(y)[m % 2];
  out.volume = jacobian.determinant() * gauss_weights[p] * gauss_weights[q];
  return out;
}

/// The equations div(2 mu eps + p I) = -load and div u = p / lambda, row by row.
struct Equations {
  std::vector<Eigen::Triplet<double>> matrix;
  VectorXd load;

  void add(int row, int column, double value) { matrix.emplace_back(row, column, value); }
};

void add_point(const Panel& panel, int i, int j, const AtPoint& at, Equations& sum) {
  const auto [lambda, mu] = panel.solid;
  for (int a = 0; a < 9; ++a) {
    const int row = 2 * panel.node(2 * i + a / 3, 2 * j + a % 3);
    sum.load[row + 1] += panel.load.weight * at.shape[a] * at.volume;
    for (int b = 0; b < 9; ++b) {
      const int column = 2 * panel.node(2 * i + b / 3, 2 * j + b % 3);
      const Matrix2d k = mu * (at.gradient[a].dot(at.gradient[b]) * Matrix2d::Identity() +
                               at.gradient[b] * at.gradient[a].transpose());
      for (int c = 0; c < 4; ++c) sum.add(row + c / 2, column + c % 2, k(c / 2, c % 2) * at.volume);
    }
    for (int m = 0; m < 4; ++m)
      for (int c = 0; c < 2; ++c) {
        const int pressure = panel.pressure(i + m / 2, j + m % 2);
        sum.add(row + c, pressure, at.gradient[a][c] * at.pressure[m] * at.volume);
        sum.add(pressure, row + c, at.gradient[a][c] * at.pressure[m] * at.volume);
      }
  }
  for (int m = 0; m < 16; ++m)
    sum.add(panel.pressure(i + m / 8, j + m / 4 % 2), panel.pressure(i + m / 2 % 2, j + m % 2),
            -at.pressure[m / 4] * at.pressure[m % 4] * at.volume / lambda);
}

void add_edge(const Panel& panel, Equations& sum) {
  for (int j = 0; j < panel.n; ++j) {
    const double force =
        panel.load.on_edge * (panel.place(2 * panel.n, 2 * j + 2) - panel.place(2 * panel.n, 2 * j))[1];
    for (int a = 0; a < 3; ++a)  // Simpson's rule is exact
      sum.load[2 * panel.node(2 * panel.n, 2 * j + a) + 1] += force * (a == 1 ? 4 : 1) / 6;
  }
}

Found solve(const Panel& panel) {
  Equations sum{{}, VectorXd::Zero(panel.unknowns())};
  for (int i = 0; i < panel.n; ++i)
    for (int j = 0; j < panel.n; ++j)
      for (int p = 0; p < 9; ++p) add_point(panel, i, j, at_point(panel, i, j, p / 3, p % 3), sum);
  add_edge(panel, sum);
  const int held = 2 * panel.side(), free = panel.unknowns() - held;  // the nodes at i = 0 come first
  std::vector<Eigen::Triplet<double>> kept;
  for (const auto& one : sum.matrix)
    if (one.row() >= held && one.col() >= held) kept.emplace_back(one.row() - held, one.col() - held, one.value());
  Eigen::SparseMatrix<double> matrix(free, free);
  matrix.setFromTriplets(kept.begin(), kept.end());
  const Eigen::SparseLU<Eigen::SparseMatrix<double>> factors(matrix);
  const VectorXd u = factors.solve(sum.load.tail(free));
  const auto along = [&](int j) { return u[2 * panel.node(2 * panel.n, j) + 1 - held]; };
  return {along(2 * panel.n), along(panel.n)};
}

}  // namespace

TEST_CASE("The elements give the published deflection of Cook's panel in plane stress") {
  // E = 1, nu = 1/3, a shear force of 1 on the edge: 23.96 at its middle (Cook 1974, finest meshes of the literature).
  // A panel a tenth as large under the same stress deflects by a tenth.
  const Found found = solve({16, plane_stress(1, 1.0 / 3), {1.0 / 16, 0}});
  CHECK(10 * found.middle == near(23.96, 4e-4));
}

TEST_CASE("Cook's panel of nearly incompressible rubber with a loaded edge: the reference of cooks_membrane") {
  const Solid rubber = plane_strain(1e7, 0.4999);
  const Load load{4500 * 0.01, 1000 * 0.01};
  const Found coarse = solve({8, rubber, load}), fine = solve({16, rubber, load});
  CHECK(fine.corner == near(0.20752e-3, 5e-4));   // 32 by 32 elements: 0.20751 mm
  CHECK(fine.middle == near(0.200677e-3, 5e-4));  // 0.20067 mm
  CHECK(fine.corner - coarse.corner < 0.002 * fine.corner);
  CHECK(fine.corner > coarse.corner);  // a mesh is stiffer than what it stands for
}
