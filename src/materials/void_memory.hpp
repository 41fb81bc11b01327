// Soil that opens and closes without growing: Mohr-Coulomb with psi = 0 that remembers its voids.
//
// Stretched beyond the apex or the tension cut-off, the return takes mean stress away, and with it the memory of the
// volume by which the soil has opened: on closing it would resist at once, and keep that volume for ever (a bag of soil
// that lands grows by 37 to 82 %). Here the volume is kept as `gap`, and what closes it costs no stress:
//
//   e = ln(1 + dvol);  closing = min(gap, max(0, -e));  the skeleton is strained by e + closing
//   gap += (p_trial - p_returned) / K - closing,        p the mean stress, tension positive
//
// With psi = 0 nothing but the cut-off takes mean stress away, so ln J - p / K - gap never changes. That the strain is
// the logarithm and not dvol itself is part of it: a skeleton that is shaken would else lose dvol^2 / 2 each step.
//
// The pores see e, all of it: pore water fills the voids that open, and flows out of them when they close.
//
// J is not bounded anywhere. Where the cut-off is the apex, an open soil has no stiffness that its larger volume could
// multiply. Below the apex it opens along one axis and bears along the others: the stress is that of the soil between
// the voids, and acts on its volume V exp(-gap) alone. On V, what is pressed, opens by the factor J and is released
// gives back J times the work, and is J times as stiff as the time step knows.
#pragma once

#include "mohr_coulomb.hpp"

#include <cmath>

namespace geodrop {

/// Share of its voids in the volume of a point [-], where what is between them bears a stress.
inline double void_share(const MohrCoulombWithVoids& soil, double gap) {
  return soil.bears_while_open() ? -std::expm1(-gap) : 0.0;
}

/// What one step has done to a point, beside its stress.
template <class R>
struct VoidStep {
  R deviatoric_strain;  ///< sqrt(2/3 de:de) [-]
  R volumetric_strain;  ///< e, what J and the pores see [-]
};

/// As that of MohrCoulomb; advances the gap [-], too.
template <int Dim, class R>
[[gnu::always_inline]] inline VoidStep<R> update_stress(const MohrCoulombWithVoids& law,
                                                        const std::array<R, std::size_t{Dim * Dim}>& dL, const R& dvol,
                                                        std::array<R, std::size_t{stress_components<Dim>}>& stress,
                                                        R& gap) {
  const auto trace = [&] { return stress[0] + stress[1] + stress[2]; };
  const R volumetric = log(1.0 + dvol);
  const R closing = min(gap, max(-volumetric, R(0.0)));
  const Stress<Dim, R> deviatoric = deviator<Dim, R>(dL);
  rotate(dL, stress);
  add_elastic<Dim, R>(law, deviatoric, volumetric + closing, stress);
  const R trial = trace();
  return_stress(YieldSurface(law), stress);
  const double per_trace = 1.0 / (3.0 * law.bulk_modulus);
  gap += per_trace * max(trial - trace(), R(0.0)) - closing;
  constexpr double two_thirds = 2.0 / 3.0;
  return {sqrt(two_thirds * norm_squared<Dim, R>(deviatoric)), volumetric};
}

/// J takes dvol as it is: particles' volumes change by what flows through the surface, to round-off.
template <int Dim, class R>
void update_point(auto& points, const MohrCoulombWithVoids& soil, const auto& rates, double, std::size_t p, int k) {
  const R volume = load<R>(&rates.volume[k]);
  auto sigma = load_stress<Dim, R>(points, p);
  R gap = load<R>(&points.gap[p]);
  const VoidStep<R> step = update_stress<Dim, R>(soil, load_increment<Dim, R>(rates, k), volume, sigma, gap);
  keep_step<Dim, R>(points, p, sigma, step.deviatoric_strain, volume);
  store(&points.gap[p], gap);
  if (!points.pore_pressure.empty())
    store(&points.pore_pressure[p],
          load<R>(&points.pore_pressure[p]) + pore_pressure_increment<R>(soil, step.volumetric_strain));
}

}  // namespace geodrop
