// Elastic, perfectly plastic Mohr-Coulomb in effective stress: rotate, elastic trial, return in principal space.
#pragma once

#include "principal_frame.hpp"
#include "principal_return.hpp"
#include "strain.hpp"

#include <geodrop/materials.hpp>

namespace geodrop {

/// A stress in a frame of which the third axis is principal: in-plane xx, yy, xy and the stress along that axis.
/// Plane strain is of this kind as it stands; in 3D one eigenvector is found first.
template <class R>
struct AxisStress {
  R xx, yy, xy, axis;
};

/// Change of stress that brings `trial` back to the yield surface; exactly zero where it does not yield.
/// Tells whether any lane yields.
template <class R>
[[gnu::always_inline]] inline bool plastic_correction(const YieldSurface& surface, const AxisStress<R>& trial,
                                                      AxisStress<R>& change) {
  const R centre = 0.5 * (trial.xx + trial.yy);
  const R half_difference = 0.5 * (trial.xx - trial.yy);
  // Far below any stress [Pa], far above underflow: gives equal principal stresses a harmless direction.
  const double smallest_radius = 1e-100;
  const R radius = max(sqrt(half_difference * half_difference + trial.xy * trial.xy), R(smallest_radius));
  const R inverse_radius = 1.0 / radius;  // here, so that it runs beside the return
  const R high = centre + radius, low = centre - radius, z = trial.axis;
  const Principal<R> sorted{max(high, z), max(low, min(high, z)), min(low, z)};
  const auto outside = violates(surface, sorted);
  if (!any(outside)) return false;

  const Principal<R> back = return_to_yield(surface, sorted, outside);
  const Principal<R> d{back.first - sorted.first, back.second - sorted.second, back.third - sorted.third};
  const auto axis_first = z > high;
  const auto axis_third = z < low;
  const R d_high = select(axis_first, d.second, d.first);
  const R d_low = select(axis_third, d.second, d.third);
  const R d_centre = 0.5 * (d_high + d_low);
  const R ratio = 0.5 * (d_high - d_low) * inverse_radius;
  change.xx = d_centre + ratio * half_difference;
  change.yy = d_centre - ratio * half_difference;
  change.xy = ratio * trial.xy;
  change.axis = select(axis_first, d.first, select(axis_third, d.third, d.second));
  return true;
}

template <class R>
[[gnu::always_inline]] inline void return_stress(const YieldSurface& surface, std::array<R, 4>& stress) {
  AxisStress<R> change;
  if (!plastic_correction<R>(surface, {stress[0], stress[1], stress[3], stress[2]}, change)) return;
  stress[0] += change.xx;
  stress[1] += change.yy;
  stress[2] += change.axis;
  stress[3] += change.xy;
}

/// The change is found in the principal frame and added outside, so that an elastic stress keeps every bit.
template <class R>
[[gnu::always_inline]] inline void return_stress(const YieldSurface& surface, std::array<R, 6>& stress) {
  const Reflection<R> reflection = reflection_to_z(separated_eigenvector(stress));
  const Stress<3, R> turned = reflect(reflection, stress);
  AxisStress<R> change;
  if (!plastic_correction<R>(surface, {turned[0], turned[1], turned[3], turned[2]}, change)) return;
  const Stress<3, R> back = reflect<R>(reflection, {change.xx, change.yy, change.axis, change.xy, R{}, R{}});
#pragma GCC unroll 6
  for (int k = 0; k < 6; ++k) stress[k] += back[k];
}

/// Advances the effective Cauchy stress [Pa] by one step and returns sqrt(2/3 de:de) of the deviatoric strain
/// increment de, elastic and plastic together [-]. Strain as in the linear elastic law. Hand over a local copy of
/// the law: behind a reference that stores might alias, its constants are recomputed for each packet.
template <int Dim, class R>
[[gnu::always_inline]] inline R update_stress(const MohrCoulomb& law, const std::array<R, std::size_t{Dim * Dim}>& dL,
                                              const R& dvol,
                                              std::array<R, std::size_t{stress_components<Dim>}>& stress) {
  const Stress<Dim, R> deviatoric = deviator<Dim, R>(dL);
  rotate(dL, stress);
  add_elastic<Dim, R>(law, deviatoric, dvol, stress);
  return_stress(YieldSurface(law), stress);
  constexpr double two_thirds = 2.0 / 3.0;
  return sqrt(two_thirds * norm_squared<Dim, R>(deviatoric));
}

}  // namespace geodrop
