// Pore water with gas that follows Boyle's law: half as much of it at twice the absolute pressure.
//
// Per volume of soil at J = 1 the water has the compliance A = n S / K_w and the gas the volume B / p, B = n (1 - S)
// p_g, p the absolute pressure, that of the water too (no menisci, nothing dissolves, constant temperature). Grains are
// rigid, so
//
//   J + A p - B / p  never changes;  p = (c + sqrt(c^2 + 4 A B)) / (2 A),  c = A p_before - B / p_before - J dvol
//
// p stays above 0 however far the soil opens: the pore pressure u = p - p_atm is at least -p_atm. The stiffness -J
// du/dJ = J / (A + B / p^2) grows as p^2 until the water takes over; it is that of pore_fluid_bulk_modulus at p_g.
#pragma once

#include "mohr_coulomb.hpp"

namespace geodrop {

/// Pore pressure [Pa] after the volume has changed by J dvol.
template <class R>
[[gnu::always_inline]] inline R gas_pore_pressure(const MohrCoulombWithGas& soil, const R& u, const R& change) {
  const double A = soil.water_compliance, B = soil.gas;
  const R before = u + soil.atmosphere;
  const R c = A * before - B / before - change;
  const R root = sqrt(c * c + 4.0 * A * B);
  // The other form of the root where the first would cancel.
  const R absolute = select(c < 0.0, 2.0 * B / (root - c), (c + root) * (0.5 / A));
  return absolute - soil.atmosphere;
}

/// -J du/dJ [Pa].
inline double gas_pore_stiffness(const MohrCoulombWithGas& soil, double u, double J) {
  const double p = u + soil.atmosphere;
  return J / (soil.water_compliance + soil.gas / (p * p));
}

/// Work of u since u = 0, per volume of soil at J = 1 [J/m3].
inline double gas_pore_energy(const MohrCoulombWithGas& soil, double u) {
  const double ratio = u / soil.atmosphere;
  return soil.water_compliance * u * u / 2 + soil.gas * (std::log1p(ratio) - ratio / (1 + ratio));
}

template <int Dim, class R>
void update_point(auto& points, const MohrCoulombWithGas& soil, const auto& rates, double, std::size_t p, int k) {
  const R volume = load<R>(&rates.volume[k]), J = load<R>(&points.J[p]);
  auto sigma = load_stress<Dim, R>(points, p);
  const R strain = update_stress<Dim, R>(soil, load_increment<Dim, R>(rates, k), volume, sigma);
  keep_step<Dim, R>(points, p, sigma, strain, volume);
  store(&points.pore_pressure[p], gas_pore_pressure<R>(soil, load<R>(&points.pore_pressure[p]), J * volume));
}

inline MohrCoulombWithGas make(const MohrCoulombSpec& spec, const UndrainedSpec& pores, const PoreGasSpec& gas) {
  MohrCoulombWithGas soil{};
  static_cast<MohrCoulomb&>(soil) = make(spec);
  soil.water_compliance = pores.porosity * *pores.saturation / gas.water_bulk_modulus;
  soil.gas = pores.porosity * (1 - *pores.saturation) * gas.gas_pressure;
  soil.atmosphere = gas.atmospheric_pressure;
  return soil;
}

}  // namespace geodrop
