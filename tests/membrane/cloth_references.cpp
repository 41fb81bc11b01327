// The references of hanging_net_3d and wrinkled_strip_3d, by computations that share nothing with the program: a net of
// cables that is relaxed, and the equilibrium of a strip whose state varies across it alone.
#include <doctest/doctest.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "support/near.hpp"

using geodrop::test::near;

namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// --- A net on a square frame ----------------------------------------------------------------------------------------

/// n by n meshes of cables that only pull, 2 % longer than the frame; the cables are as wide as the meshes.
struct Net {
  static constexpr double side = 4.0, slack = 0.02, stiffness = 1e5, weight = 20 * 9.81;  // [m], [N/m], [N/m2]

  int n;
  double mesh = side * (1 + slack) / n;
  std::vector<Vector3d> x, v, force;

  explicit Net(int meshes) : n(meshes) {
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j) {
        const double s = 2.0 * i / n - 1, t = 2.0 * j / n - 1;
        x.emplace_back(side / 2 * s, side / 2 * t, -0.3 * (1 - s * s) * (1 - t * t));
      }
    v.assign(x.size(), Vector3d::Zero());
    force = v;
  }
  std::size_t at(int i, int j) const { return static_cast<std::size_t>(i * (n + 1) + j); }
  double tension(std::size_t a, std::size_t b) const {  // per width
    return stiffness * std::max(0.0, (x[b] - x[a]).norm() / mesh - 1);
  }
  void pull(std::size_t a, std::size_t b) {
    const Vector3d along = (x[b] - x[a]).normalized() * tension(a, b) * mesh;
    force[a] += along;
    force[b] -= along;
  }
  /// Largest force that is left on a node.
  double sum_forces() {
    for (Vector3d& f : force) f = Vector3d(0, 0, -weight * mesh * mesh);
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j) {
        if (i < n) pull(at(i, j), at(i + 1, j));
        if (j < n) pull(at(i, j), at(i, j + 1));
      }
    double largest = 0;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j) {
        if (i == 0 || j == 0 || i == n || j == n) force[at(i, j)].setZero();
        largest = std::max(largest, force[at(i, j)].norm());
      }
    return largest;
  }
  /// Moves with unit masses and stops wherever it would climb (Bitzek et al. 2006).
  void relax() {
    const double longest = 1.2 / std::sqrt(4 * stiffness);
    double dt = longest / 3, turn = 0.1;
    int downhill = 0;
    while (sum_forces() > 1e-8 * weight * mesh * mesh) {
      double power = 0, speed = 0, size = 0;
      for (std::size_t k = 0; k < x.size(); ++k) {
        power += force[k].dot(v[k]);
        speed += v[k].squaredNorm();
        size += force[k].squaredNorm();
      }
      if (power > 0) {
        for (std::size_t k = 0; k < x.size(); ++k) v[k] = (1 - turn) * v[k] + turn * std::sqrt(speed / size) * force[k];
        if (++downhill > 5) {
          dt = std::min(1.1 * dt, longest);
          turn *= 0.99;
        }
      } else {
        for (Vector3d& velocity : v) velocity.setZero();
        dt /= 2;
        turn = 0.1;
        downhill = 0;
      }
      for (std::size_t k = 0; k < x.size(); ++k) {
        v[k] += dt * force[k];
        x[k] += dt * v[k];
      }
    }
  }
  double sag() const { return -x[at(n / 2, n / 2)][2]; }
  /// Of the cables along x.
  double mean_tension() const {
    double sum = 0;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j <= n; ++j) sum += (j == 0 || j == n ? 0.5 : 1.0) * tension(at(i, j), at(i + 1, j));
    return sum / n / n;
  }
  /// Across the middle, of the cables that cross it; those of the edge are half as wide.
  double pull_across() const {
    double sum = 0;
    for (int j = 0; j <= n; ++j)
      for (const int i : {n / 2 - 1, n / 2}) {
        const std::size_t a = at(i, j), b = at(i + 1, j);
        sum += (j == 0 || j == n ? 0.25 : 0.5) * mesh * tension(a, b) * (x[b] - x[a]).normalized()[0];
      }
    return sum;
  }
};

// --- A strip that hangs along itself between two rails --------------------------------------------------------------

/// Cloth of nu = 0 that wrinkles, 1 / 0.99 times as long and as wide as at rest.
struct Strip {
  static constexpr double stiffness = 1e5, weight = 4000, at_rest = 0.99, stretch = 1 / at_rest;

  struct State {
    double shear = 0, pull = 0;    ///< of a line along the strip, per length at rest [N/m]
    double larger = 0, other = 0;  ///< principal tensions
  };
  /// Of the slopes (du/dY, dv/dY).
  static State state(const Vector2d& slope) {
    Matrix2d F;
    F << stretch, slope[0], 0, slope[1];
    const Eigen::SelfAdjointEigenSolver<Matrix2d> principal(F.transpose() * F);
    Matrix2d stress = Matrix2d::Zero();
    Vector2d tension;
    for (int k = 0; k < 2; ++k) {
      const double length = std::sqrt(std::max(1e-12, principal.eigenvalues()[k]));
      tension[k] = stiffness * std::max(0.0, length - 1);
      stress += tension[k] / length * principal.eigenvectors().col(k) * principal.eigenvectors().col(k).transpose();
    }
    const Matrix2d nominal = F * stress;
    return {nominal(0, 1), nominal(1, 1), tension[1], tension[0]};
  }
  /// Newton's method with differences.
  static Vector2d slopes(double shear, double pull, Vector2d slope) {
    const auto missing = [&](const Vector2d& s) {
      const State found = state(s);
      return Vector2d(found.shear - shear, found.pull - pull);
    };
    for (int k = 0; k < 100 && missing(slope).norm() > 1e-8; ++k) {
      Matrix2d slope_of;
      for (int c = 0; c < 2; ++c) {
        const Vector2d step = 1e-7 * Vector2d::Unit(c);
        slope_of.col(c) = (missing(slope + step) - missing(slope - step)) / 2e-7;
      }
      const Vector2d change = slope_of.fullPivLu().solve(missing(slope));
      double part = 1;
      while (part > 1e-3 && missing(slope - part * change).norm() > missing(slope).norm()) part /= 2;
      slope -= part * change;
    }
    REQUIRE(missing(slope).norm() < 1e-6);
    return slope;
  }

  double width = 0, sag = 0, larger = 0, other = 0, wrinkled = 0;
  /// With `pull` across it; from the middle, which bears no shear, to a rail.
  Strip(double pull, int layers) {
    Vector2d slope(0, 1 + pull / stiffness);
    for (int k = 0; k < layers; ++k) {
      const double Y = at_rest / 2 * (k + 0.5) / layers;
      slope = slopes(weight * Y, pull, slope);
      const State found = state(slope);
      sag += slope[0] * at_rest / 2 / layers;
      width += slope[1] * at_rest / layers;
      larger += found.larger / layers;
      other += found.other / layers;
      wrinkled += found.other > 0 ? 0.0 : 1.0 / layers;
    }
  }
};

}  // namespace

TEST_CASE("The reference of hanging_net_3d: cables relaxed, extrapolated from two nets") {
  Net coarse(16), fine(32);
  coarse.relax();
  fine.relax();
  CHECK(fine.sag() + (fine.sag() - coarse.sag()) / 3 == near(0.393514, 2e-5));
  CHECK(fine.mean_tension() + (fine.mean_tension() - coarse.mean_tension()) / 3 == near(394.36, 1e-4));
  CHECK(fine.pull_across() + (fine.pull_across() - coarse.pull_across()) / 3 == near(1535.6, 3e-4));
}

TEST_CASE("The reference of wrinkled_strip_3d: equilibrium over its width") {
  constexpr int layers = 200;
  double low = 500, high = 3000;  // of the pull that makes it 1 m wide
  for (int k = 0; k < 40; ++k) {
    const double middle = (low + high) / 2;
    (Strip(middle, layers).width < 1 ? low : high) = middle;
  }
  const Strip strip(low, layers);
  CHECK(low == near(1412.58, 3e-5));
  CHECK(strip.sag == near(0.0128152, 3e-5));
  CHECK(strip.larger == near(2364.08, 3e-5));
  CHECK(strip.other == near(344.99, 2e-4));
  CHECK(strip.wrinkled == near(0.387, 0.01));
}
