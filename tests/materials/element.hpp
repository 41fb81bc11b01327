// One material point under test: soils by their usual constants, tensors by principal values and axes.
#pragma once

#include <geodrop/materials/materials.hpp>

#include "materials/laws.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>

namespace geodrop::test {

/// What a test says of a soil: moduli, cohesion, cut-off [Pa], angles [degree].
struct SoilConstants {
  double youngs_modulus, poissons_ratio, cohesion, friction_angle, dilatancy_angle;
  double tension_cutoff = 1e30;  ///< none: make_material takes the apex
};

inline MohrCoulomb soil(const SoilConstants& constants) {
  MohrCoulombSpec spec;
  spec.density = 1600;
  spec.youngs_modulus = constants.youngs_modulus;
  spec.poissons_ratio = constants.poissons_ratio;
  spec.cohesion = constants.cohesion;
  spec.friction_angle_deg = constants.friction_angle;
  spec.dilatancy_angle_deg = constants.dilatancy_angle;
  spec.tension_cutoff = constants.tension_cutoff;
  MaterialSpec material;
  material.name = "soil";
  material.model = spec;
  return std::get<MohrCoulomb>(make_material(material));
}

/// The first Dim rows and columns, then zz and the other shears.
template <int Dim>
Stress<Dim, double> components(const Eigen::Matrix3d& m) {
  if constexpr (Dim == 2) {
    return {m(0, 0), m(1, 1), m(2, 2), m(0, 1)};
  } else {
    return {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(1, 2), m(0, 2)};
  }
}

inline Eigen::Matrix3d matrix(const Stress<3, double>& s) {
  Eigen::Matrix3d m;
  m << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  return m;
}

template <int Dim>
Gradient<Dim, double> gradient(const Eigen::Matrix3d& m) {
  Gradient<Dim, double> dL;
  for (int a = 0; a < Dim; ++a)
    for (int b = 0; b < Dim; ++b) dL[a * Dim + b] = m(a, b);
  return dL;
}

template <std::size_t N>
double largest(const std::array<double, N>& values) {
  double result = 0;
  for (const double value : values) result = std::max(result, std::abs(value));
  return result;
}

template <std::size_t N>
double largest_difference(const std::array<double, N>& a, const std::array<double, N>& b) {
  double result = 0;
  for (std::size_t k = 0; k < N; ++k) result = std::max(result, std::abs(a[k] - b[k]));
  return result;
}

/// Random rotations and numbers, the same in every run.
class Dice {
 public:
  double normal() { return normal_(engine_); }
  double uniform(double low, double high) { return std::uniform_real_distribution<>(low, high)(engine_); }
  Eigen::Matrix3d rotation() {
    return Eigen::Quaterniond(normal(), normal(), normal(), normal()).normalized().toRotationMatrix();
  }
  Eigen::Matrix3d any_matrix() {
    return Eigen::Matrix3d::NullaryExpr([this](Eigen::Index, Eigen::Index) { return normal(); });
  }

 private:
  std::mt19937 engine_{20240607};
  std::normal_distribution<> normal_;
};

/// The return alone: a step without strain.
template <int Dim>
Stress<Dim, double> returned(const MohrCoulomb& law, Stress<Dim, double> trial) {
  update_stress<Dim, double>(law, Gradient<Dim, double>{}, 0.0, trial);
  return trial;
}

}  // namespace geodrop::test
