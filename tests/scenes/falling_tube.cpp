// The reference of falling_tube: a tube of cloth full of fluid that moves broadside through an ideal fluid, as a bubble
// with the tension of its cloth in place of surface tension: T kappa = p_inside - p_around. Around a body that
// accelerates the pressure is linear along an ellipse and balances the weight inside, so that what is left is that of a
// steady flow, Delta + rho q^2 / 2. The outline is the image of the unit circle under z = a (w + sum_k c_k w^(1 - 2k)),
// q = 2 U a |cos t| / |dz/dt|; the unknowns a, c_k, T, Delta follow from Newton's method on the harmonics of the
// balance, the area and the perimeter.
#include "support/near.hpp"
#include "support/scene_files.hpp"

#include <doctest/doctest.h>

#include <Eigen/Dense>

#include <cmath>
#include <complex>
#include <numbers>

using namespace geodrop;
using geodrop::test::near;

namespace {

using Eigen::VectorXd;
using Complex = std::complex<double>;

constexpr double pi = std::numbers::pi;
constexpr int harmonics = 10, points = 256;  // 6 and 128 change the tension by less than 1e-6

struct Tube {
  double velocity = 0;                          ///< [m/s]
  double perimeter = 0, area = 0;               ///< at rest, without tension [m], [m2]
  double axial_stiffness = 0;                   ///< [N/m]
  double density_around = 0, bulk_modulus = 0;  ///< [kg/m3]; of the fluid inside [Pa]
  double deeper = 0;                            ///< rise of the pressure of still water since then [Pa]
};

struct Outline {
  double area = 0, perimeter = 0;
  VectorXd balance;  ///< harmonics of T kappa - Delta - rho q^2 / 2 [Pa]
};

/// u = a, T / 1000, Delta / 1000, c_1 ...
Outline outline_of(const Tube& tube, const VectorXd& u) {
  Outline outline;
  outline.balance = VectorXd::Zero(harmonics + 1);
  for (int i = 0; i < points; ++i) {
    const double t = 2 * pi * (i + 0.5) / points;
    Complex z = std::polar(1.0, t), slope = Complex(0, 1) * z, bend = -z;
    for (int k = 1; k <= harmonics; ++k) {
      const double n = 1 - 2 * k;
      const Complex term = u[2 + k] * std::polar(1.0, n * t);
      z += term, slope += Complex(0, n) * term, bend -= n * n * term;
    }
    const double length = u[0] * std::abs(slope), flow = 2 * tube.velocity * u[0] * std::cos(t) / length;
    const double curvature = (std::conj(slope) * bend).imag() / std::pow(std::abs(slope), 3) / u[0];
    const double residual = 1e3 * u[1] * curvature - 1e3 * u[2] - 0.5 * tube.density_around * flow * flow;
    for (int k = 0; k <= harmonics; ++k) outline.balance[k] += residual * std::cos(2 * k * t) / points;
    outline.perimeter += length * 2 * pi / points;
    outline.area += 0.5 * u[0] * u[0] * (std::conj(z) * slope).imag() * 2 * pi / points;
  }
  return outline;
}

VectorXd residual(const Tube& tube, const VectorXd& u) {
  const Outline outline = outline_of(tube, u);
  const double tension = 1e3 * u[1];
  VectorXd all(harmonics + 3);
  all << outline.balance / 1e3, outline.area - tube.area * (1 - (tube.deeper + tension) / tube.bulk_modulus),
      outline.perimeter - tube.perimeter * (1 + tension / tube.axial_stiffness);
  return all;
}

/// Newton's method with differences, from an ellipse.
VectorXd solve(const Tube& tube, double half_width, double tension) {
  VectorXd u = VectorXd::Zero(harmonics + 3);
  const double half_height = tube.area / (pi * half_width);
  u[0] = (half_width + half_height) / 2, u[1] = u[2] = tension / 1e3;
  u[3] = (half_width - half_height) / (half_width + half_height);
  for (int round = 0; round < 20; ++round) {
    const VectorXd now = residual(tube, u);
    Eigen::MatrixXd slope(now.size(), u.size());
    for (Eigen::Index j = 0; j < u.size(); ++j) {
      VectorXd moved = u;
      moved[j] += 1e-7;
      slope.col(j) = (residual(tube, moved) - now) / 1e-7;
    }
    u -= slope.partialPivLu().solve(now);
  }
  return u;
}

double perimeter_of_ellipse(double a, double b) {
  double sum = 0;
  for (int i = 0; i < points; ++i)
    sum += std::hypot(a * std::sin(2 * pi * i / points), b * std::cos(2 * pi * i / points));
  return sum * 2 * pi / points;
}

}  // namespace

TEST_CASE("A tube that is hardly flattened: T = rho U^2 R e^(2 e) / (3 e) for half axes R e^e and R e^-e") {
  for (const double e : {0.02, 0.005}) {
    const Tube tube{1, perimeter_of_ellipse(std::exp(e), std::exp(-e)), pi, 1e15, 1000, 1e15, 0};
    const VectorXd u = solve(tube, std::exp(e), 1000 / (3 * e));
    CHECK(residual(tube, u).norm() < 1e-9);
    CHECK(1e3 * u[1] == near(1000 * std::exp(2 * e) / (3 * e), 0.3 * e * e));
  }
}

TEST_CASE("The tension and the velocity that falling_tube is measured by") {
  const Scene scene = read_scene(source_path("cases/verification/falling_tube.toml"));
  const auto& shape = std::get<EllipseShape>(scene.bodies[1].shape);
  const double a = shape.semi_axes[0], area = pi * a * shape.semi_axes[1], time = 0.11, g = -scene.gravity[1];
  const double velocity = time * g * 200 * area / (1200 * area + 1000 * pi * a * a);
  const Tube tube{velocity,
                  perimeter_of_ellipse(a, shape.semi_axes[1]),
                  area,
                  scene.membranes[0].axial_stiffness,
                  1000,
                  1200 * std::pow(1000.0, 2),
                  1000 * g * velocity * time / 2};
  const VectorXd u = solve(tube, a, 6e4);
  CHECK(residual(tube, u).norm() < 1e-9);
  for (const VerifySpec& verify : scene.verify) {
    if (verify.result == "velocity_m_s") CHECK(verify.expected == near(velocity, 1e-4));
    if (verify.result == "tension_N_m") CHECK(verify.expected == near(1e3 * u[1], 1e-4));
  }
}
