// Compressible neo-Hookean solid: sigma = (mu / J) (F F^T - I) + (lambda ln J / J) I, W = mu/2 (F:F - 3) - mu ln J +
// lambda/2 (ln J)^2 per reference volume. F has no history but itself, so stresses close over any cycle of strain.
//
// In plane strain F_zz = 1 is not stored.
#pragma once

#include "strain.hpp"

#include <geodrop/materials/materials.hpp>

namespace geodrop {

/// F <- (I + dL) F, row-major as dL: exact for particles that move with x += dt sum N v'.
template <int Dim, class R>
[[gnu::always_inline]] inline void deform(const Gradient<Dim, R>& dL, Gradient<Dim, R>& F) {
  const Gradient<Dim, R> old = F;
#pragma GCC unroll 3
  for (int a = 0; a < Dim; ++a)
#pragma GCC unroll 3
    for (int b = 0; b < Dim; ++b) {
      R sum = old[a * Dim + b];
#pragma GCC unroll 3
      for (int c = 0; c < Dim; ++c) sum += dL[a * Dim + c] * old[c * Dim + b];
      F[a * Dim + b] = sum;
    }
}

template <class R>
[[gnu::always_inline]] inline R determinant(const Gradient<2, R>& F) {
  return F[0] * F[3] - F[1] * F[2];
}
template <class R>
[[gnu::always_inline]] inline R determinant(const Gradient<3, R>& F) {
  return F[0] * (F[4] * F[8] - F[5] * F[7]) - F[1] * (F[3] * F[8] - F[5] * F[6]) + F[2] * (F[3] * F[7] - F[4] * F[6]);
}

/// b = F F^T in the order of a stress.
template <int Dim, class R>
[[gnu::always_inline]] inline Stress<Dim, R> left_cauchy_green(const Gradient<Dim, R>& F) {
  const auto row_product = [&](int a, int b) __attribute__((always_inline)) {
    R sum = F[a * Dim] * F[b * Dim];
    for (int c = 1; c < Dim; ++c) sum += F[a * Dim + c] * F[b * Dim + c];
    return sum;
  };
  if constexpr (Dim == 2) {
    return {row_product(0, 0), row_product(1, 1), R(1.0), row_product(0, 1)};
  } else {
    return {row_product(0, 0), row_product(1, 1), row_product(2, 2),
            row_product(0, 1), row_product(1, 2), row_product(0, 2)};
  }
}

/// Cauchy stress [Pa] at F with J = det F; NaN if J is not positive.
template <int Dim, class R>
[[gnu::always_inline]] inline Stress<Dim, R> neo_hookean_stress(const NeoHookean& law, const Gradient<Dim, R>& F,
                                                                const R& J) {
  const R inverse = 1.0 / J;
  const R shear = law.shear_modulus * inverse;
  const R mean = law.lame_lambda * log(J) * inverse - shear;
  Stress<Dim, R> stress = left_cauchy_green<Dim, R>(F);
#pragma GCC unroll 6
  for (int k = 0; k < stress_components<Dim>; ++k) stress[k] = shear * stress[k] + (k < 3 ? mean : R{});
  return stress;
}

/// Energy per reference volume [J/m3].
template <int Dim>
double neo_hookean_energy(const NeoHookean& law, const Gradient<Dim, double>& F, double J) {
  const Stress<Dim, double> b = left_cauchy_green<Dim, double>(F);
  const double volumetric = log(J);
  return 0.5 * law.shear_modulus * (b[0] + b[1] + b[2] - 3) - law.shear_modulus * volumetric +
         0.5 * law.lame_lambda * volumetric * volumetric;
}

/// At least the largest principal value of b = F F^T, and 1: row sums of |b| (Gershgorin), exact for stretch along the
/// axes of the grid.
template <int Dim>
double largest_stretch_squared(const Gradient<Dim, double>& F) {
  const Stress<Dim, double> b = left_cauchy_green<Dim, double>(F);
  double stretch = 1;
  for (int a = 0; a < Dim; ++a) {
    double row = b[a];
    if constexpr (Dim == 2)
      row += abs(b[3]);
    else
      row += a == 0 ? abs(b[3]) + abs(b[5]) : a == 1 ? abs(b[3]) + abs(b[4]) : abs(b[4]) + abs(b[5]);
    stretch = max(stretch, row);
  }
  return stretch;
}

/// Stiffness [Pa] of compression waves at the present strain, per reference density: rho0 c^2 along a principal axis n
/// is lambda (1 - ln J) + mu (1 + b_n).
template <int Dim>
double neo_hookean_wave_modulus(const NeoHookean& law, const Gradient<Dim, double>& F, double J) {
  return law.lame_lambda * (1 - log(J)) + law.shear_modulus * (1 + largest_stretch_squared<Dim>(F));
}

/// D_max / d of grid/stiffest_mode.hpp [Pa]: the second variation of the energy for a gradient L of increments of the
/// displacement is lambda (tr L)^2 + (mu - lambda ln J) tr(L L) + mu tr(L b L^T) per reference volume.
template <int Dim>
double neo_hookean_stiffest_mode(const NeoHookean& law, const Gradient<Dim, double>& F, double J) {
  const double shear = law.shear_modulus, turning = abs(shear - law.lame_lambda * log(J));
  return law.lame_lambda + (turning + shear * largest_stretch_squared<Dim>(F)) / Dim;
}

/// J is det F: the volume rate of the cell has no part in it.
template <int Dim, class R>
void update_point(auto& points, const NeoHookean& solid, const auto& rates, double, std::size_t p, int k) {
  std::array<R, Dim * Dim> F;
  for (int c = 0; c < Dim * Dim; ++c) F[c] = load<R>(&points.deformation[c][p]);
  deform<Dim, R>(load_increment<Dim, R>(rates, k), F);
  const R J = determinant<R>(F);
  const auto sigma = neo_hookean_stress<Dim, R>(solid, F, J);
  for (int c = 0; c < Dim * Dim; ++c) store(&points.deformation[c][p], F[c]);
  for (int c = 0; c < stress_components<Dim>; ++c) store(&points.stress[c][p], sigma[c]);
  store(&points.J[p], J);
}

inline NeoHookean make(const NeoHookeanSpec& spec) {
  const double shear = shear_modulus(spec.youngs_modulus, spec.poissons_ratio);
  return {spec.density, bulk_modulus(spec.youngs_modulus, spec.poissons_ratio) - 2.0 / 3.0 * shear, shear};
}

}  // namespace geodrop
