// The added mass of a sphere at the centre of a closed box, which cases/verification/sphere_release_3d.toml refers to.
#include <doctest/doctest.h>

#include <Eigen/Dense>

#include <cmath>
#include <vector>

#include "support/near.hpp"

using namespace geodrop::test;

namespace {

/// Legendre functions P_l^m, l to `last`, with the norm of spherical harmonics.
std::vector<double> legendre(int m, int last, double x) {
  std::vector<double> P(last + 1, 0.0);
  P[m] = 1;
  for (int i = 1; i <= m; ++i) P[m] *= std::sqrt((1 - x * x) * (2.0 * i + 1) / (2.0 * i));
  if (last > m) P[m + 1] = x * std::sqrt(2.0 * m + 3) * P[m];
  for (double l = m + 2; l <= last; ++l) {
    const double a = std::sqrt((4 * l * l - 1) / (l * l - m * m));
    const double b = std::sqrt(((l - 1) * (l - 1) - m * m) / (4 * (l - 1) * (l - 1) - 1));
    P[static_cast<std::size_t>(l)] =
        a * (x * P[static_cast<std::size_t>(l) - 1] - b * P[static_cast<std::size_t>(l) - 2]);
  }
  return P;
}

/// Potential of a sphere of radius 1 that moves along z with velocity 1 at the centre of a cube, half as wide as
/// `half`: solid harmonics r^l + l/(l+1) r^-(l+1) of odd l, which do not flow through the sphere, on top of that of an
/// unbounded fluid; the walls are met by least squares (Trefftz). C_a = -phi(pole).
struct Potential {
  double half;
  int last;
  std::vector<std::pair<int, int>> modes;

  Potential(double half_width, int degree) : half(half_width), last(degree) {
    for (int m = 0; m <= last; m += 4)
      for (int l = 1; l <= last; l += 2)
        if (l >= m) modes.emplace_back(l, m);
  }
  double size() const { return half * std::sqrt(3.0); }

  Eigen::VectorXd harmonics(const Eigen::Vector3d& x) const {
    const double r = x.norm(), azimuth = std::atan2(x[1], x[0]), R = size();
    Eigen::VectorXd values(modes.size());
    for (std::size_t k = 0; k < modes.size(); ++k) {
      const auto [l, m] = modes[k];
      const double radial = std::pow(r / R, l) + l / (l + 1.0) * std::pow(1 / R, 2 * l + 1) * std::pow(R / r, l + 1);
      values[static_cast<Eigen::Index>(k)] = radial * legendre(m, last, x[2] / r)[l] * std::cos(m * azimuth);
    }
    return values;
  }
  static double unbounded(const Eigen::Vector3d& x) { return -0.5 * x[2] / std::pow(x.norm(), 3); }

  double added_mass(int points) const {
    Eigen::MatrixXd flow(3 * points * points, modes.size());
    Eigen::VectorXd of_unbounded(flow.rows());
    const double step = 1e-5 * half;
    for (Eigen::Index k = 0; k < flow.rows(); ++k) {
      const auto i = static_cast<double>(k / 3 % points), j = static_cast<double>(k / 3 / points);
      Eigen::Vector3d x;
      x[k % 3] = half;
      x[(k + 1) % 3] = (i + 0.5) / points * half;
      x[(k + 2) % 3] = (j + 0.5) / points * half;
      const Eigen::Vector3d way = step * Eigen::Vector3d::Unit(k % 3);
      flow.row(k) = (harmonics(x + way) - harmonics(x - way)) / (2 * step);
      of_unbounded[k] = (unbounded(x + way) - unbounded(x - way)) / (2 * step);
    }
    const Eigen::VectorXd scale = flow.colwise().norm();
    const Eigen::VectorXd c =
        (flow * scale.cwiseInverse().asDiagonal()).colPivHouseholderQr().solve(-of_unbounded).cwiseQuotient(scale);
    const Eigen::Vector3d pole(0, 0, 1);
    return 0.5 - c[0] * harmonics(pole)[0];  // other degrees have no part in the force
  }
};

}  // namespace

TEST_CASE("Added mass of a sphere in a cube: 1/2 far from the walls, 0.622827 in one of four radii") {
  CHECK(Potential(40, 5).added_mass(8) == near(0.5, 6e-5));
  CHECK(Potential(2, 15).added_mass(16) == near(0.6228266, 5e-5));
  CHECK(Potential(2, 21).added_mass(20) == near(0.6228266, 1e-6));
}
