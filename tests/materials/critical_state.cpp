// Soil with a critical porosity: simple shear against closed forms, drained and undrained, and its limits.
#include "element.hpp"

#include <doctest/doctest.h>

#include "support/near.hpp"

namespace {

using namespace geodrop;
using namespace geodrop::test;

constexpr double slope = 4.09, critical = 0.42, friction = 30;  // K, n_c, phi_c
const double tan_friction = std::tan(friction * std::numbers::pi / 180);

CriticalStateSoil soil_of(double porosity, double youngs_modulus = 100e6, double cohesion = 0) {
  MohrCoulombSpec spec;
  spec.density = 1500;
  spec.youngs_modulus = youngs_modulus;
  spec.poissons_ratio = 0.3;
  spec.cohesion = cohesion;
  spec.friction_angle_deg = friction;
  spec.tension_cutoff = 1e30;
  spec.critical_state = CriticalStateSpec{porosity, critical, slope};
  MaterialSpec material;
  material.model = spec;
  return std::get<CriticalStateSoil>(make_material(material));
}

/// A point in plane strain, compressed alike along all axes at the start.
struct Element {
  CriticalStateSoil law;
  Stress<2, double> stress;
  double J = 1;

  Element(const CriticalStateSoil& soil, double pressure) : law(soil), stress{-pressure, -pressure, -pressure, 0} {}

  double porosity() const { return 1 - law.solid_fraction / J; }
  void step(const Gradient<2, double>& dL) {
    const FlowAngles<double> angles = angles_at(law, J);
    const YieldSurface<double> surface(law, angles, cutoff_at(law, angles));
    const double dvol = dL[0] + dL[3];
    update_stress<2>(law, surface, dL, dvol, stress);
    J *= 1 + dvol;
  }
  /// Simple shear by dgamma, the height such that sigma_yy stays.
  void shear(double dgamma) {
    const double wanted = stress[1];
    const auto miss = [&](double rise) {
      Element trial = *this;
      trial.step({0, dgamma, 0, rise});
      return trial.stress[1] - wanted;
    };
    double low = -dgamma, high = dgamma;  // pressed too much, torn
    for (int i = 0; i < 60; ++i) {
      const double middle = (low + high) / 2;
      (miss(middle) > 0 ? high : low) = middle;
    }
    step({0, dgamma, 0, high});
  }
};

/// s = 1 - n after a shear strain from s0: ds/dgamma = -K s (s - s_c).
double solid_fraction(double start, double gamma) {
  const double end = 1 - critical;
  return end / (1 - (1 - end / start) * std::exp(-slope * end * gamma));
}

void shear_to_critical_state(double n0) {
  CAPTURE(n0);
  Element element(soil_of(n0), 1e3);
  double gamma = 0;
  for (const double until : {0.2, 0.5, 1.0, 2.0}) {
    for (; gamma < until - 1e-9; gamma += 1e-3) element.shear(1e-3);
    // The stress turns towards the shear over a strain of about sigma / G = 2.6e-5; the step takes the angles of its
    // start.
    CHECK(1 - element.porosity() == within(solid_fraction(1 - n0, gamma), 2e-3 * std::abs(n0 - critical)));
    const FlowAngles<double> now = angles_at(element.law, element.J);
    const double cos_psi = std::sqrt(1 - now.sin_psi * now.sin_psi);
    const double davis = now.sin_phi * cos_psi / (1 - now.sin_phi * now.sin_psi);
    CHECK(-element.stress[3] / element.stress[1] == near(davis, 2e-3));
  }
  CHECK(std::abs(element.porosity() - critical) < 0.01 * std::abs(n0 - critical));
}

}  // namespace

TEST_CASE("Simple shear under constant load brings dense and loose soil to the critical porosity, as the closed form") {
  shear_to_critical_state(0.36);
  shear_to_critical_state(0.48);
}

TEST_CASE("Pure shear at constant volume: loose soil loses effective stress, dense soil gains it") {
  // By hand, with the angles of the start: ds = -(lambda + G) sin(psi) G dgamma / (lambda sin(phi) sin(psi) + G (1 +
  // sin(phi) sin(psi))), s the mean in the plane, tension positive.
  for (const double n0 : {0.36, 0.45}) {
    CAPTURE(n0);
    Element element(soil_of(n0), 20e3);
    const FlowAngles<double> angles = angles_at(element.law, 1.0);
    CHECK((angles.sin_psi > 0) == (n0 < critical));
    const double dgamma = 1e-5, G = element.law.shear_modulus, lambda = element.law.bulk_modulus - 2 * G / 3;
    const Gradient<2, double> dL{dgamma / 2, 0, 0, -dgamma / 2};
    for (int k = 0; k < 60; ++k) element.step(dL);  // yields, s2 between s1 and s3
    const double before = (element.stress[0] + element.stress[1]) / 2;
    for (int k = 0; k < 10; ++k) element.step(dL);
    const double product = angles.sin_phi * angles.sin_psi;
    const double rate = -(lambda + G) * angles.sin_psi * G / (lambda * product + G * (1 + product));
    CHECK((element.stress[0] + element.stress[1]) / 2 - before == near(rate * 10 * dgamma, 1e-8));
  }
}

TEST_CASE("Angles by hand; soil that has opened has no friction, and the apex follows the angle") {
  const CriticalStateSoil soil = soil_of(0.36, 100e6, 1e3);
  const FlowAngles<double> dense = angles_at(soil, 1.0);
  const double tan_psi = slope * 0.06;
  CHECK(dense.sin_psi / std::sqrt(1 - dense.sin_psi * dense.sin_psi) == near(tan_psi, 1e-14));
  CHECK(dense.sin_phi / dense.cos_phi == near(tan_friction + tan_psi, 1e-14));
  CHECK(cutoff_at(soil, dense) == near(1e3 / (tan_friction + tan_psi), 1e-12));
  const FlowAngles<double> critical_state = angles_at(soil, 0.64 / 0.58);
  CHECK(critical_state.sin_psi == near_zero(1e-14));
  CHECK(critical_state.sin_phi == near(std::sin(friction * std::numbers::pi / 180), 1e-14));
  const FlowAngles<double> open = angles_at(soil, 2.0);
  CHECK(open.sin_phi == 0);
  CHECK(open.cos_phi == 1);
  CHECK(open.sin_psi == near(-0.5, 1e-14));
}

TEST_CASE("With n = n_c the law is Mohr-Coulomb without dilatancy") {
  Element element(soil_of(critical), 1e3);
  const MohrCoulomb plain = soil({100e6, 0.3, 0, friction, 0});
  Stress<2, double> stress = element.stress;
  for (int k = 0; k < 100; ++k) {
    const Gradient<2, double> dL{1e-5, 2e-5, -1e-5, -1e-5};
    element.step(dL);
    update_stress<2, double>(plain, dL, 0.0, stress);
  }
  CHECK(largest_difference(element.stress, stress) < 1e-9);  // of 1 kPa
}

TEST_CASE("Packets of points with different porosities do what the points do") {
  Dice dice;
  const CriticalStateSoil soil = soil_of(0.40, 1e6, 500);
  for (int repeat = 0; repeat < 500; ++repeat) {
    std::array<double, packet_width> J;
    for (double& each : J) each = std::exp(0.2 * dice.normal());
    std::array<std::array<double, packet_width>, 6> trial;
    for (auto& component : trial)
      for (double& value : component) value = 8e3 * (dice.normal() - 0.3);
    Stress<3, Packet> wide;
    for (int c = 0; c < 6; ++c) wide[c] = load<Packet>(trial[c].data());
    const auto angles = angles_at<Packet>(soil, load<Packet>(J.data()));
    return_stress(YieldSurface<Packet>(soil, angles, cutoff_at<Packet>(soil, angles)), wide);
    for (int lane = 0; lane < packet_width; ++lane) {
      Stress<3, double> one;
      for (int c = 0; c < 6; ++c) one[c] = trial[c][lane];
      const auto own = angles_at<double>(soil, J[lane]);
      const YieldSurface<double> surface(soil, own, cutoff_at<double>(soil, own));
      CHECK(surface.stiffness > 0);
      CHECK(surface.compression_edge + surface.stiffness > 0);
      CHECK(surface.extension_edge + surface.stiffness > 0);
      return_stress(surface, one);
      double worst = 0;
      for (int c = 0; c < 6; ++c) {
        std::array<double, packet_width> lanes;
        store(lanes.data(), wide[c]);
        worst = std::max(worst, std::abs(lanes[lane] - one[c]));
      }
      CHECK(worst < 1e-6);  // of 10 kPa
    }
  }
}
