// The added mass of a sphere in a closed box and its fall, which cases/verification/sphere_release_3d.toml and
// sphere_fall_3d.toml refer to.
#include <doctest/doctest.h>

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
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

/// A box around the origin, square in the plan.
struct Box {
  double half, bottom, top;

  double size() const { return Eigen::Vector3d(half, half, std::max(-bottom, top)).norm(); }
};

/// Potential of a sphere of radius 1 at the origin that moves along z with velocity 1 in a box: solid harmonics
/// r^l + l/(l+1) r^-(l+1), which do not flow through the sphere, on top of that of an unbounded fluid; the walls are
/// met by least squares (Trefftz). C_a is what of -phi on the sphere goes with z.
struct Potential {
  Box box;
  int last;
  std::vector<std::pair<int, int>> modes;

  Potential(const Box& walls, int degree) : box(walls), last(degree) {
    const int step = box.bottom == -box.top ? 2 : 1;  // odd in z
    for (int m = 0; m <= last; m += 4)
      for (int l = 1; l <= last; l += step)
        if (l >= m) modes.emplace_back(l, m);
  }

  Eigen::VectorXd harmonics(const Eigen::Vector3d& x) const {
    const double r = x.norm(), azimuth = std::atan2(x[1], x[0]), R = box.size();
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
    struct Place {
      Eigen::Vector3d x;
      int normal;
    };
    std::vector<Place> walls;
    for (int k = 0; k < points * points; ++k) {
      const double i = (k % points + 0.5) / points, j = (static_cast<double>(k / points) + 0.5) / points;
      const double y = i * box.half, z = box.bottom + j * (box.top - box.bottom);
      walls.push_back({{box.half, y, z}, 0});
      walls.push_back({{y, j * box.half, box.top}, 2});
      walls.push_back({{y, j * box.half, box.bottom}, 2});
    }
    Eigen::MatrixXd flow(walls.size(), modes.size());
    Eigen::VectorXd of_unbounded(flow.rows());
    const double step = 1e-5 * box.half;
    for (Eigen::Index k = 0; k < flow.rows(); ++k) {
      const auto& [x, normal] = walls[static_cast<std::size_t>(k)];
      const Eigen::Vector3d way = step * Eigen::Vector3d::Unit(normal);
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

/// Velocity of a sphere of radius 1 m that has fallen in a box for some time, from rest: its energy and that of the
/// water are the work of gravity, (M + C_a(z) rho V) v^2 / 2 = (M - rho V) g d, with C_a a polynomial through `places`
/// of z.
double velocity_of_fall(const Box& at_start, double mass, double time, int degree, int points) {
  constexpr double g = 9.81, displaced = 4.0 / 3 * M_PI * 1000;
  constexpr std::array<double, 5> places{0, 0.4, 0.8, 1.2, 1.6};
  std::array<double, places.size()> added;
  for (std::size_t k = 0; k < places.size(); ++k)
    added[k] =
        Potential({at_start.half, at_start.bottom + places[k], at_start.top + places[k]}, degree).added_mass(points);
  const auto added_at = [&](double fallen) {
    double sum = 0;
    for (std::size_t k = 0; k < places.size(); ++k) {
      double part = added[k];
      for (std::size_t other = 0; other < places.size(); ++other)
        if (other != k) part *= (fallen - places[other]) / (places[k] - places[other]);
      sum += part;
    }
    return sum;
  };
  const auto inertia = [&](double fallen) { return mass + added_at(fallen) * displaced; };
  const auto velocity = [&](double fallen) { return std::sqrt(2 * (mass - displaced) * g * fallen / inertia(fallen)); };
  // d = s^2: dt = 2 s ds / v is smooth.
  constexpr double ds = 1e-4;
  double s = 0;
  for (double t = 0; t < time; s += ds) {
    const double middle = s + ds / 2;
    t += ds * 2 * middle / velocity(middle * middle);
  }
  return velocity(s * s);
}

}  // namespace

TEST_CASE("Added mass of a sphere in a cube: 1/2 far from the walls, 0.622827 in one of four radii") {
  CHECK(Potential({40, -40, 40}, 5).added_mass(8) == near(0.5, 6e-5));
  CHECK(Potential({2, -2, 2}, 15).added_mass(16) == near(0.6228266, 5e-5));
  CHECK(Potential({2, -2, 2}, 21).added_mass(20) == near(0.6228266, 1e-6));
}

TEST_CASE("Fall of a sphere in a box of 4 x 4 x 6 m for a second, by energy") {
  const double mass = 4.0 / 3 * M_PI * 1631 + 4 * M_PI * 0.1;
  CHECK(velocity_of_fall({2, -4, 2}, mass, 1.0, 14, 16) == near(2.7568, 4e-5));
  CHECK(velocity_of_fall({2, -4, 2}, mass, 1.0, 18, 20) == near(2.7568, 1e-5));
}
