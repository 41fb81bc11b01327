// Soil that dilates or contracts while it is sheared, until it has its critical porosity (Roux & Radjai 1998; Pailha &
// Pouliquen 2009, J. Fluid Mech. 633, eqs 2.10 to 2.12 without their dependence on the rate of shear):
//
//   tan(psi) = K (n_c - n),  tan(phi) = tan(phi_c) + tan(psi),  1 - n = (1 - n0) / J
//
// for each point with the porosity that it has at the start of the step. In simple shear under a constant normal stress
// the solid fraction s = 1 - n follows ds/dgamma = -K s (s - s_c), s = s_c / (1 - (1 - s_c / s0) exp(-K s_c gamma)).
// A point that has opened so far that tan(phi) would be negative has no friction: tan(psi) >= -tan(phi_c).
#pragma once

#include "mohr_coulomb.hpp"

namespace geodrop {

/// Angles of a point with the volume ratio J.
template <class R>
[[gnu::always_inline]] inline FlowAngles<R> angles_at(const CriticalStateSoil& soil, const R& J) {
  const R porosity = 1.0 - soil.solid_fraction / J;
  const R tan_psi = max(soil.dilatancy_slope * (soil.critical_porosity - porosity), R(-soil.tan_phi));
  const R tan_phi = soil.tan_phi + tan_psi;
  const R cos_phi = 1.0 / sqrt(1.0 + tan_phi * tan_phi);
  return {tan_phi * cos_phi, cos_phi, tan_psi / sqrt(1.0 + tan_psi * tan_psi)};
}

/// Cut-off below the apex of that friction [Pa].
template <class R>
[[gnu::always_inline]] inline R cutoff_at(const CriticalStateSoil& soil, const FlowAngles<R>& angles) {
  constexpr double least_sine = 1e-12;  // an apex beyond any stress
  return min(R(soil.tension_cutoff), soil.cohesion * angles.cos_phi / max(angles.sin_phi, R(least_sine)));
}

template <int Dim, class R>
void update_point(auto& points, const CriticalStateSoil& soil, const auto& rates, double, std::size_t p, int k) {
  const R volume = load<R>(&rates.volume[k]), J = load<R>(&points.J[p]);
  const FlowAngles<R> angles = angles_at<R>(soil, J);
  auto sigma = load_stress<Dim, R>(points, p);
  const R strain = update_stress<Dim>(soil, YieldSurface<R>(soil, angles, cutoff_at<R>(soil, angles)),
                                      load_increment<Dim, R>(rates, k), volume, sigma);
  keep_step<Dim, R>(points, p, sigma, strain, volume);
}

inline CriticalStateSoil make(const MohrCoulombSpec& spec, const CriticalStateSpec& state) {
  CriticalStateSoil soil{};
  static_cast<MohrCoulomb&>(soil) = make(spec);
  soil.solid_fraction = 1 - state.porosity;
  soil.critical_porosity = state.critical_porosity;
  soil.dilatancy_slope = state.dilatancy_slope;
  soil.tan_phi = std::tan(radians(spec.friction_angle_deg));
  return soil;
}

}  // namespace geodrop
