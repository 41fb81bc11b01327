// Soil with void memory: paths by hand, and the balance of volume, stress and gap that it never leaves.
#include "element.hpp"

#include <doctest/doctest.h>

#include <vector>

#include "support/near.hpp"

namespace {

using namespace geodrop;
using namespace geodrop::test;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double percent = 0.01;

/// A point of soil with its volume ratio.
template <int Dim>
struct Sample {
  MohrCoulombWithVoids law;
  Stress<Dim, double> stress{};
  double gap = 0, J = 1;

  double mean() const { return (stress[0] + stress[1] + stress[2]) / 3; }
  void step(const Matrix3d& dL, double dvol) {
    update_stress<Dim, double>(law, gradient<Dim>(dL), dvol, stress, gap);
    J *= 1 + dvol;
  }
  /// Alike along the axes of the plane or of space, by `strain` = ln(J / J before) in ten steps.
  void swell(double strain) {
    const double dvol = std::expm1(strain / 10);
    Matrix3d dL = Matrix3d::Zero();
    for (int a = 0; a < Dim; ++a) dL(a, a) = dvol / Dim;
    for (int step_number = 0; step_number < 10; ++step_number) step(dL, dvol);
  }
  void shear(double strain) {
    Matrix3d dL = Matrix3d::Zero();
    dL(0, 1) = strain / 10;
    for (int step_number = 0; step_number < 10; ++step_number) step(dL, 0);
  }
  double balance() const { return std::log(J) - mean() / law.bulk_modulus - gap; }
};

template <int Dim>
Sample<Dim> sample(const SoilConstants& constants) {
  return {{soil(constants)}};
}

constexpr SoilConstants sand{10e6, 0.3, 0, 30, 0};
constexpr SoilConstants cut_sand{10e6, 0.3, 3e3, 30, 0, 1e3};  // apex at 5196 Pa

/// Opens by 3 % and closes by 3 %, sheared while it is open.
template <int Dim>
void open_and_close() {
  Sample<Dim> p = sample<Dim>(sand);
  const double K = p.law.bulk_modulus;
  p.swell(3 * percent);
  CHECK(largest(p.stress) < 1e-9);  // of K gap = 250 kPa
  CHECK(p.gap == near(3 * percent, 1e-12));
  p.shear(10 * percent);
  CHECK(largest(p.stress) < 1e-9);
  CHECK(p.gap == near(3 * percent, 1e-12));
  p.swell(-2 * percent);
  CHECK(largest(p.stress) < 1e-9);
  CHECK(p.gap == near(1 * percent, 1e-12));
  p.swell(-1 * percent);
  CHECK(p.mean() == near_zero(1e-10));  // of 8 kPa
  CHECK(p.gap < 1e-14);
  CHECK(p.J == near(1, 1e-12));
  p.swell(-0.1 * percent);
  CHECK(p.mean() == near(-0.1 * percent * K, 2e-12));

  Stress<Dim, double> forgetful{};  // the plain law on the same way resists at once, and for good
  for (const double strain : {3 * percent, -3 * percent})
    update_stress<Dim, double>(p.law, gradient<Dim>(Matrix3d::Identity() * (strain / Dim)), strain, forgetful);
  CHECK(forgetful[0] < -0.9 * 3 * percent * K);
}

/// Random strains about zero, of which every other one opens; largest drift of the balance.
template <int Dim>
double drift_of_balance(const SoilConstants& constants, int steps) {
  Dice dice;
  Sample<Dim> p = sample<Dim>(constants);
  p.stress = components<Dim>(Matrix3d(Vector3d(-2e4, -3e4, -1e4).asDiagonal()));
  const double start = p.balance();
  double worst = 0;
  for (int step = 0; step < steps; ++step) {
    Matrix3d dL = 2e-3 * dice.any_matrix();
    if (Dim == 2) dL.row(2).setZero(), dL.col(2).setZero();
    const double back = -1e-2 * std::log(p.J);  // keeps J near 1
    const double dvol = 5e-3 * dice.normal() + back;
    p.step(dL, dvol);
    CHECK(p.gap >= 0);
    worst = std::max(worst, std::abs(p.balance() - start));
  }
  return worst;
}

}  // namespace

TEST_CASE("Sand opened by 3 % and closed by 3 % bears nothing until it is closed, sheared or not") {
  open_and_close<2>();
  open_and_close<3>();
}

TEST_CASE("Soil with a cut-off below the apex opens and closes at the cut-off") {
  Sample<3> p = sample<3>(cut_sand);
  const double K = p.law.bulk_modulus, elastic = 1e3 / K;
  p.swell(3 * percent);
  CHECK(p.mean() == near(1e3, 1e-12));
  CHECK(p.gap == near(3 * percent - elastic, 1e-12));
  p.swell(-(3 * percent - elastic));
  CHECK(p.mean() == near(1e3, 1e-12));
  CHECK(p.gap < 1e-14);
  p.swell(-3 * elastic);
  CHECK(p.mean() == near(-2e3, 7e-12));
}

TEST_CASE("A crack along one axis keeps the mean stress that it took, as volume") {
  // Stretched along x alone beyond t: sigma_x is held at t, by hand the plastic strain is e - t / (lambda + 2 G).
  Sample<3> p = sample<3>(cut_sand);
  const double K = p.law.bulk_modulus, G = p.law.shear_modulus, lambda = K - 2 * G / 3;
  const double strain = 2e-4;  // sigma_y = lambda t / (lambda + 2 G) stays below t
  const double dvol = std::expm1(strain);
  // Deviator as of the logarithm, so that the elastic stress is known exactly.
  p.step(Vector3d(strain, 0, 0).asDiagonal(), dvol);
  CHECK(p.stress[0] == near(1e3, 1e-12));
  CHECK(p.stress[1] == near(1e3 * lambda / (lambda + 2 * G), 1.5e-12));
  CHECK(p.gap == near(strain - 1e3 / (lambda + 2 * G), 1e-12));
}

TEST_CASE("ln J - p / K - gap of a point never changes") {
  // 1e4 steps, each of which rounds ln J and gap by 1e-16: their random walk is 1e-14.
  for (const SoilConstants& constants : {sand, cut_sand, SoilConstants{10e6, 0.3, 3e3, 30, 0}}) {
    CHECK(drift_of_balance<2>(constants, 10000) < 2e-13);
    CHECK(drift_of_balance<3>(constants, 10000) < 2e-13);
  }
}

TEST_CASE("Clay that is pressed, opens beside its load and is released gives back what it took, and no more") {
  // Along y by 0.1 % and back, in between along x to twice the width. On its whole volume it would give back twice as
  // much.
  Sample<2> p{{soil({5e6, 0.3, 20e3, 30, 0, 0})}};
  double work = 0, on_all = 0, taken = 0;
  const auto strain = [&](int axis, double total, int steps) {
    for (int k = 0; k < steps; ++k) {
      Matrix3d dL = Matrix3d::Zero();
      dL(axis, axis) = total / steps;
      const double before = p.stress[axis];
      p.step(dL, dL.trace());
      const double power = p.J * (before + p.stress[axis]) / 2 * dL(axis, axis);
      on_all += power;
      work += (1 - void_share(p.law, p.gap)) * power;
    }
  };
  strain(1, -1e-3, 1000);
  taken = work;
  CHECK(taken > 1);                  // [J/m3]
  strain(0, std::log(2.0), 200000);  // of 3.5e-6: the elastic part of the way takes 124 of them
  CHECK(p.J == near(2, 2e-3));
  CHECK(p.stress[0] == near_zero(1e-8));
  CHECK(p.stress[1] < -5e3);
  while (p.stress[1] < -1) strain(1, 1e-6, 1);
  CHECK(work == near_zero(2e-3 * taken));
  CHECK(on_all < -0.5 * taken);
}

TEST_CASE("Soil that never opens has the stress of the plain law, and no gap") {
  Dice dice;
  Sample<3> p = sample<3>(cut_sand);
  Stress<3, double> plain{-5e4, -5e4, -5e4, 0, 0, 0};
  p.stress = plain;
  for (int step = 0; step < 200; ++step) {
    const Matrix3d dL = 1e-4 * dice.any_matrix();
    const double strain = dice.uniform(-1e-4, 0);
    update_stress<3, double>(p.law, gradient<3>(dL), std::log(1 + std::expm1(strain)), plain);
    p.step(dL, std::expm1(strain));
  }
  CHECK(largest_difference(p.stress, plain) == 0);
  CHECK(p.gap < 1e-17);
}

TEST_CASE("Shaken soil keeps its volume: a plain sum of dvol would lose dvol^2 / 2 each step") {
  Sample<3> p = sample<3>(sand);
  p.stress = {-5e4, -5e4, -5e4, 0, 0, 0};
  const double before = p.mean(), dvol = 1e-3;
  for (int step = 0; step < 1000; ++step) {
    p.step(Matrix3d::Identity() * (dvol / 3), dvol);
    p.step(Matrix3d::Identity() * (-dvol / 3), -dvol / (1 + dvol));
  }
  CHECK(p.J == near(1, 1e-12));
  CHECK(p.mean() == near(before, 1e-10));
}

TEST_CASE("Each lane of a packet opens and closes as a point does") {
  Dice dice;
  const MohrCoulombWithVoids law{soil(cut_sand)};
  for (int repeat = 0; repeat < 500; ++repeat) {
    std::array<Stress<3, double>, packet_width> lanes;
    std::array<Gradient<3, double>, packet_width> dL;
    std::array<double, packet_width> dvol{}, gap{};
    for (int k = 0; k < packet_width; ++k) {
      lanes[k] = components<3>(Matrix3d(2e3 * dice.any_matrix()));
      dL[k] = gradient<3>(2e-3 * dice.any_matrix());
      dvol[k] = 2e-3 * dice.normal();
      gap[k] = std::max(0.0, 2e-3 * dice.normal());
    }
    const auto pack = [](auto value) {
      std::array<double, packet_width> values;
      for (int k = 0; k < packet_width; ++k) values[k] = value(k);
      return load<Packet>(values.data());
    };
    Stress<3, Packet> stress;
    Gradient<3, Packet> increment;
    for (int c = 0; c < 6; ++c) stress[c] = pack([&](int k) { return lanes[k][c]; });
    for (int c = 0; c < 9; ++c) increment[c] = pack([&](int k) { return dL[k][c]; });
    Packet gaps = load<Packet>(gap.data());
    const auto step = update_stress<3, Packet>(law, increment, load<Packet>(dvol.data()), stress, gaps);
    std::array<double, packet_width> gap_of_lane, volumetric, deviatoric;
    store(gap_of_lane.data(), gaps);
    store(volumetric.data(), step.volumetric_strain);
    store(deviatoric.data(), step.deviatoric_strain);
    for (int k = 0; k < packet_width; ++k) {
      const auto one = update_stress<3, double>(law, dL[k], dvol[k], lanes[k], gap[k]);
      CHECK(gap_of_lane[k] == within(gap[k], 1e-17));  // of 0.01
      CHECK(volumetric[k] == near(one.volumetric_strain, 1e-12));
      CHECK(deviatoric[k] == near(one.deviatoric_strain, 1e-12));
    }
  }
}
