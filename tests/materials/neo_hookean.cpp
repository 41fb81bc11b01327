// The neo-Hookean law against closed forms, its own energy, and turning.
#include "element.hpp"

#include <doctest/doctest.h>

#include "support/near.hpp"

namespace {

using namespace geodrop;
using namespace geodrop::test;
using Eigen::Matrix3d;

const NeoHookean rubber{1000, 5.769e6, 3.846e6};

/// A deformation near `distance` from the identity, in the plane if Dim is 2.
template <int Dim>
Matrix3d deformation(Dice& dice, double distance) {
  Matrix3d F = Matrix3d::Identity();
  F.topLeftCorner<Dim, Dim>() += distance * dice.any_matrix().topLeftCorner<Dim, Dim>();
  return F;
}

template <int Dim>
Stress<Dim, double> stress_at(const Matrix3d& F) {
  return neo_hookean_stress<Dim, double>(rubber, gradient<Dim>(F), F.determinant());
}

template <int Dim>
double energy_at(const Matrix3d& F) {
  return neo_hookean_energy<Dim>(rubber, gradient<Dim>(F), F.determinant());
}

template <int Dim>
void check_energy() {
  Dice dice;
  for (int trial = 0; trial < 20; ++trial) {
    const Matrix3d F = deformation<Dim>(dice, 0.1);
    // First Piola-Kirchhoff stress by differences, sigma = P F^T / J.
    constexpr double step = 1e-6;
    Matrix3d P = Matrix3d::Zero();
    for (int a = 0; a < Dim; ++a)
      for (int b = 0; b < Dim; ++b) {
        Matrix3d more = F, less = F;
        more(a, b) += step;
        less(a, b) -= step;
        P(a, b) = (energy_at<Dim>(more) - energy_at<Dim>(less)) / (2 * step);
      }
    Stress<Dim, double> from_energy = components<Dim>(P * F.transpose() / F.determinant());
    const Stress<Dim, double> sigma = stress_at<Dim>(F);
    if constexpr (Dim == 2) from_energy[2] = sigma[2];  // F_zz was not varied
    CHECK(largest_difference(from_energy, sigma) < 1e-7 * rubber.shear_modulus);
  }
}

template <int Dim>
void check_turning() {
  Dice dice;
  for (int trial = 0; trial < 20; ++trial) {
    const Matrix3d F = deformation<Dim>(dice, 0.1);
    const Matrix3d Q =
        Dim == 3 ? dice.rotation() : Eigen::AngleAxisd(dice.uniform(0, 6), Eigen::Vector3d::UnitZ()).toRotationMatrix();
    // In the plane zz and the other shears are those of three dimensions.
    const Matrix3d sigma = matrix(stress_at<3>(F));
    CHECK(largest_difference(components<Dim>(Q * sigma * Q.transpose()), stress_at<Dim>(Q * F)) <
          1e-12 * rubber.lame_lambda);
  }
}

template <int Dim>
void check_packet() {
  Dice dice;
  std::array<double, Dim * Dim * packet_width> lanes;
  Gradient<Dim, Packet> F, dL;
  std::array<Gradient<Dim, double>, packet_width> each;
  for (int k = 0; k < packet_width; ++k) {
    each[k] = gradient<Dim>(deformation<Dim>(dice, 0.15));
    for (int c = 0; c < Dim * Dim; ++c) lanes[c * packet_width + k] = each[k][c];
  }
  for (int c = 0; c < Dim * Dim; ++c) F[c] = load<Packet>(&lanes[c * packet_width]);
  for (int c = 0; c < Dim * Dim; ++c) dL[c] = 0.01 * F[(c + 1) % (Dim * Dim)];
  deform<Dim, Packet>(dL, F);
  const auto sigma = neo_hookean_stress<Dim, Packet>(rubber, F, determinant<Packet>(F));
  for (int k = 0; k < packet_width; ++k) {
    Gradient<Dim, double> increment, one = each[k];
    for (int c = 0; c < Dim * Dim; ++c) increment[c] = 0.01 * one[(c + 1) % (Dim * Dim)];
    deform<Dim, double>(increment, one);
    const auto expected = neo_hookean_stress<Dim, double>(rubber, one, determinant<double>(one));
    for (int c = 0; c < stress_components<Dim>; ++c) {
      double out[packet_width];
      store(out, sigma[c]);
      CHECK(out[k] == within(expected[c], 1e-12 * rubber.shear_modulus));
    }
  }
}

}  // namespace

TEST_CASE("Stretch without lateral strain: sigma = (mu (l^2 - 1) + lambda ln l) / l") {
  for (const double l : {0.5, 0.9, 1.0, 1.11, 2.0}) {
    CAPTURE(l);
    const Matrix3d F = Eigen::Vector3d(l, 1, 1).asDiagonal();
    const double lateral = rubber.lame_lambda * std::log(l) / l;
    const double axial = lateral + rubber.shear_modulus * (l * l - 1) / l;
    CHECK(stress_at<2>(F)[0] == within(axial, 1e-15 * rubber.shear_modulus));
    CHECK(stress_at<3>(F)[0] == within(axial, 1e-15 * rubber.shear_modulus));
    for (const int c : {1, 2}) CHECK(stress_at<2>(F)[c] == within(lateral, 1e-15 * rubber.shear_modulus));
    CHECK(stress_at<2>(F)[3] == 0);
    // c^2 of waves along x: l^2 dP/dl / rho0 in space, P = sigma (lateral stretch 1).
    constexpr double step = 1e-6;
    const auto nominal = [&](double x) { return stress_at<3>(Eigen::Vector3d(x, 1, 1).asDiagonal())[0]; };
    const double modulus = l * l * (nominal(l + step) - nominal(l - step)) / (2 * step);
    const double bound = neo_hookean_wave_modulus<3>(rubber, gradient<3>(F), l);
    if (l >= 1) CHECK(bound == near(modulus, 1.5e-10));
    CHECK(bound >= modulus * (1 - 1e-7));  // squeezed: waves across are the faster ones
    CHECK(bound == near(neo_hookean_wave_modulus<2>(rubber, gradient<2>(F), l), 1e-12));
  }
}

TEST_CASE("Simple shear: sigma_xy = mu g, sigma_xx = mu g^2 (Poynting effect)") {
  Matrix3d F = Matrix3d::Identity();
  F(0, 1) = 0.4;
  const auto sigma = stress_at<2>(F);
  CHECK(sigma[3] == near(rubber.shear_modulus * 0.4, 1e-12));
  CHECK(sigma[0] == near(rubber.shear_modulus * 0.16, 1e-12));
  CHECK(std::abs(sigma[1]) < 1e-8);
  CHECK(std::abs(sigma[2]) < 1e-8);
}

TEST_CASE("The stress is the slope of the energy") {
  check_energy<2>();
  check_energy<3>();
}

TEST_CASE("The stress turns with the body") {
  check_turning<2>();
  check_turning<3>();
}

TEST_CASE("A packet of neo-Hookean points gives what single points give") {
  check_packet<2>();
  check_packet<3>();
}

TEST_CASE("F of many small steps is the product of the steps; a full turn in steps keeps its determinant") {
  Gradient<2, double> F{1, 0, 0, 1};
  for (int k = 0; k < 1000; ++k) deform<2, double>({0.001, 0, 0, 0}, F);
  CHECK(F[0] == near(std::pow(1.001, 1000), 1e-12));
  Gradient<3, double> G{1, 0.2, 0, 0, 1.1, 0.1, 0.3, 0, 0.9};
  const double before = determinant<double>(G);
  CHECK(before == near(1.1 * 0.9 + 0.2 * 0.1 * 0.3, 1e-12));
  const double angle = 0.01;
  for (int k = 0; k < 100; ++k)
    deform<3, double>({std::cos(angle) - 1, -std::sin(angle), 0, std::sin(angle), std::cos(angle) - 1, 0, 0, 0, 0}, G);
  CHECK(determinant<double>(G) == near(before, 1e-12));
  CHECK(G[0] == near(std::cos(1.0), 1e-12));
}

TEST_CASE("A particle that is turned inside out has no stress") {
  const Matrix3d F = Eigen::Vector3d(-0.5, 1, 1).asDiagonal();
  CHECK(std::isnan(stress_at<2>(F)[0]));
}

TEST_CASE("A neo-Hookean material begins with the moduli of its linear elastic namesake") {
  MaterialSpec spec;
  spec.model = NeoHookeanSpec{1000, 1e7, 0.3};
  const Material material = make_material(spec);
  const auto& law = std::get<NeoHookean>(material);
  CHECK(law.shear_modulus == near(1e7 / 2.6, 1e-12));
  CHECK(law.lame_lambda == near(1e7 * 0.3 / (1.3 * 0.4), 1e-12));
  CHECK(wave_speed(material) == near(std::sqrt(1e7 * 0.7 / (1.3 * 0.4) / 1000), 1e-12));
}
