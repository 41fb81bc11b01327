#include "extremes_probe.hpp"

#include <geodrop/measure/measure.hpp>

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "base/fixed_order_sum.hpp"

namespace geodrop {
namespace {

/// Effective stress in soil, total stress elsewhere [Pa], components as in types.hpp.
template <int Dim>
std::array<double, stress_components<Dim>> acting_stress(const Body<Dim>& body, std::size_t p) {
  auto stress = total_stress(body, p);
  if (!body.pore_pressure.empty())
    for (int k = 0; k < 3; ++k) stress[k] += body.pore_pressure[p];
  return stress;
}

template <int Dim>
double largest_principal(const std::array<double, stress_components<Dim>>& s) {
  Eigen::Matrix3d matrix = Eigen::Vector3d(s[0], s[1], s[2]).asDiagonal();
  matrix(1, 0) = s[3];
  if constexpr (Dim == 3) {
    matrix(2, 1) = s[4];
    matrix(2, 0) = s[5];
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(matrix, Eigen::EigenvaluesOnly).eigenvalues()[2];
}

}  // namespace

Extremes& Extremes::operator+=(const Extremes& other) {
  volume_min = std::min(volume_min, other.volume_min);
  volume_max = std::max(volume_max, other.volume_max);
  pressure_min = std::min(pressure_min, other.pressure_min);
  pressure_max = std::max(pressure_max, other.pressure_max);
  tension = std::max(tension, other.tension);
  return *this;
}

template <int Dim>
Extremes extremes_of(const Body<Dim>& body) {
  return fixed_order_sum<Extremes>(body.size(), [&](Extremes& so_far, std::size_t p) {
    const double J = body.J[p], pressure = mean_pressure(body, p);
    so_far += {J, J, pressure, pressure, largest_principal<Dim>(acting_stress(body, p))};
  });
}

template Extremes extremes_of(const Body<2>&);
template Extremes extremes_of(const Body<3>&);

}  // namespace geodrop
