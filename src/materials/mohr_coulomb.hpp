// Elastic, perfectly plastic Mohr-Coulomb in effective stress: rotate, elastic trial, return in principal space.
#pragma once

#include "principal_frame.hpp"
#include "principal_return.hpp"
#include "strain.hpp"
#include "undrained.hpp"

#include <geodrop/materials/materials.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace geodrop {

/// Principal stresses: two are centre +- radius, the third is along a known axis. Plane strain is of this kind as it
/// stands; in 3D one eigenvector is found first.
template <class R>
struct AxisStress {
  R centre, radius, axis;
};

/// What the return changes: the centre and the axis by so much [Pa], the radius by this share of it [-].
template <class R>
struct AxisChange {
  R centre, ratio, axis;
};

/// Radius of a circle in the plane across the axis [Pa]. Its floor, far below any stress and far above underflow,
/// gives equal principal stresses a harmless direction.
template <class R>
[[gnu::always_inline]] inline R radius_of(const R& square) {
  return max(sqrt(square), R(1e-100));
}

/// Change that brings `trial` back to the yield surface; exactly zero where it does not yield. Tells whether any lane
/// yields.
template <class S, class R>
[[gnu::always_inline]] inline bool plastic_correction(const YieldSurface<S>& surface, const AxisStress<R>& trial,
                                                      AxisChange<R>& change) {
  const R inverse_radius = 1.0 / trial.radius;  // here, so that it runs beside the return
  const R high = trial.centre + trial.radius, low = trial.centre - trial.radius, z = trial.axis;
  const Principal<R> sorted{max(high, z), max(low, min(high, z)), min(low, z)};
  const auto outside = violates(surface, sorted);
  if (!any_lane(outside)) return false;

  const Principal<R> back = return_to_yield(surface, sorted, outside);
  const Principal<R> d{back.first - sorted.first, back.second - sorted.second, back.third - sorted.third};
  const auto axis_first = z > high;
  const auto axis_third = z < low;
  const R d_high = select(axis_first, d.second, d.first);
  const R d_low = select(axis_third, d.second, d.third);
  change.centre = 0.5 * (d_high + d_low);
  change.ratio = 0.5 * (d_high - d_low) * inverse_radius;
  change.axis = select(axis_first, d.first, select(axis_third, d.third, d.second));
  return true;
}

template <class S, class R>
[[gnu::always_inline]] inline void return_stress(const YieldSurface<S>& surface, Stress<2, R>& stress) {
  const R centre = 0.5 * (stress[0] + stress[1]);
  const R half_difference = 0.5 * (stress[0] - stress[1]);
  const R radius = radius_of<R>(half_difference * half_difference + stress[3] * stress[3]);
  AxisChange<R> change;
  if (!plastic_correction(surface, AxisStress<R>{centre, radius, stress[2]}, change)) return;
  stress[0] += change.centre + change.ratio * half_difference;
  stress[1] += change.centre - change.ratio * half_difference;
  stress[2] += change.axis;
  stress[3] += change.ratio * stress[3];
}

/// The change is found in the principal frame and added outside, so that an elastic stress keeps every bit.
template <class S, class R>
[[gnu::always_inline]] inline void return_stress(const YieldSurface<S>& surface, Stress<3, R>& stress) {
  constexpr double third = 1.0 / 3.0;
  const R mean = third * (stress[0] + stress[1] + stress[2]);
  const Stress<3, R> s{stress[0] - mean, stress[1] - mean, stress[2] - mean, stress[3], stress[4], stress[5]};
  const R p2 = squared_scale(s);
  if (!any_lane(leaves_cone(surface, mean, p2))) return;
  const EigenAxis<R> axis = separated_axis(s, p2);
  // s = (3 l n n^T - l I) / 2 + a rest in the plane across n
  const R half = 0.5 * axis.eigenvalue;
  Stress<3, R> plane;
#pragma GCC unroll 6
  for (int k = 0; k < 6; ++k) plane[k] = (k < 3 ? s[k] + half : s[k]) - 3.0 * half * axis.dyad[k];
  const R radius = radius_of<R>(0.5 * norm_squared<3, R>(plane));
  AxisChange<R> change;
  if (!plastic_correction(surface, AxisStress<R>{mean - half, radius, mean + axis.eigenvalue}, change)) return;
  const R along = change.axis - change.centre;
#pragma GCC unroll 6
  for (int k = 0; k < 6; ++k) {
    const R sheared = change.ratio * plane[k] + along * axis.dyad[k];
    stress[k] += k < 3 ? change.centre + sheared : sheared;
  }
}

/// Advances the effective Cauchy stress [Pa] by one step and returns sqrt(2/3 de:de) of the deviatoric strain
/// increment de, elastic and plastic together [-]. Strain as in the linear elastic law.
template <int Dim, class S, class R>
[[gnu::always_inline]] inline R update_stress(const MohrCoulomb& law, const YieldSurface<S>& surface,
                                              const std::array<R, std::size_t{Dim * Dim}>& dL, const R& dvol,
                                              std::array<R, std::size_t{stress_components<Dim>}>& stress) {
  const Stress<Dim, R> deviatoric = deviator<Dim, R>(dL);
  constexpr double two_thirds = 2.0 / 3.0;
  const R strain = sqrt(two_thirds * norm_squared<Dim, R>(deviatoric));
  rotate(dL, stress);
  add_elastic<Dim, R>(law, deviatoric, dvol, stress);
  return_stress(surface, stress);
  return strain;
}

/// The same with the angles of the law. Hand over a local copy of the law: behind a reference that stores might alias,
/// its constants are recomputed for each packet.
template <int Dim, class R>
[[gnu::always_inline]] inline R update_stress(const MohrCoulomb& law, const std::array<R, std::size_t{Dim * Dim}>& dL,
                                              const R& dvol,
                                              std::array<R, std::size_t{stress_components<Dim>}>& stress) {
  return update_stress<Dim>(law, YieldSurface(law), dL, dvol, stress);
}

/// What soils keep of a step: stress, accumulated deviatoric strain, and J, which takes dvol as it is.
template <int Dim, class R>
[[gnu::always_inline]] inline void keep_step(auto& points, std::size_t p,
                                             const std::array<R, std::size_t{stress_components<Dim>}>& sigma,
                                             const R& strain, const R& volume) {
  for (int c = 0; c < stress_components<Dim>; ++c) store(&points.stress[c][p], sigma[c]);
  store(&points.deviatoric_strain[p], load<R>(&points.deviatoric_strain[p]) + strain);
  store(&points.J[p], load<R>(&points.J[p]) * (1 + volume));
}

template <int Dim, class R>
void update_point(auto& points, const MohrCoulomb& soil, const auto& rates, double, std::size_t p, int k) {
  const R volume = load<R>(&rates.volume[k]);
  auto sigma = load_stress<Dim, R>(points, p);
  const R strain = update_stress<Dim, R>(soil, load_increment<Dim, R>(rates, k), volume, sigma);
  keep_step<Dim, R>(points, p, sigma, strain, volume);
  if (!points.pore_pressure.empty())
    store(&points.pore_pressure[p], load<R>(&points.pore_pressure[p]) + pore_pressure_increment(soil, volume));
}

inline double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

inline MohrCoulomb make(const MohrCoulombSpec& spec) {
  MohrCoulomb soil{};
  soil.density = spec.density;
  soil.bulk_modulus = bulk_modulus(spec.youngs_modulus, spec.poissons_ratio);
  soil.shear_modulus = shear_modulus(spec.youngs_modulus, spec.poissons_ratio);
  soil.cohesion = spec.cohesion;
  soil.sin_phi = std::sin(radians(spec.friction_angle_deg));
  soil.cos_phi = std::cos(radians(spec.friction_angle_deg));
  soil.sin_psi = std::sin(radians(spec.dilatancy_angle_deg));
  // The return relies on t <= c cot(phi); a value typed in with a few digits may lie just above.
  soil.tension_cutoff = soil.sin_phi > 0 ? std::min(spec.tension_cutoff, soil.cohesion * soil.cos_phi / soil.sin_phi)
                                         : spec.tension_cutoff;
  const UndrainedSpec* const pores = spec.undrained();
  soil.pore_stiffness = pores ? pores->fluid_bulk_modulus / pores->porosity : 0.0;
  return soil;
}

}  // namespace geodrop
