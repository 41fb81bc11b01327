// What a body gives to the limit of the time step: its waves, and its viscosity. The most over its particles, as they
// are now.
#pragma once

#include <geodrop/state/state.hpp>

#include <algorithm>
#include <cmath>

#include "materials/neo_hookean.hpp"
#include "materials/pore_gas.hpp"
#include "materials/strain.hpp"
#include "stiffest_mode.hpp"

namespace geodrop {

/// The largest of value(p) over the particles of a body, at least `least`; passes over what is no number.
template <int Dim>
double largest(const Body<Dim>& body, double least, const auto& value) {
  const auto n = static_cast<std::ptrdiff_t>(body.size());
#pragma omp parallel for schedule(static) reduction(max : least)
  for (std::ptrdiff_t p = 0; p < n; ++p) least = std::max(least, value(static_cast<std::size_t>(p)));
  return least;
}

/// Moduli that the next step follows explicitly, of pore gas at the largest pore pressure in place of that at the
/// start.
template <int Dim>
ElasticModuli present_moduli(const Body<Dim>& body) {
  ElasticModuli moduli = explicit_moduli(body);
  if (const auto* soil = std::get_if<MohrCoulombWithGas>(&body.material)) {
    const auto stiffness = [&](std::size_t p) { return gas_pore_stiffness(*soil, body.pore_pressure[p], body.J[p]); };
    moduli.bulk += largest(body, soil->pore_stiffness, stiffness) - soil->pore_stiffness;
  }
  return moduli;
}

/// Of a neo-Hookean body, which stiffens where it is stretched or squeezed [Pa]; a NaN is left to v_max, which shows it
/// a step later.
template <int Dim>
double most_strained(const Body<Dim>& body, const auto& modulus_at) {
  return largest(body, 0, [&](std::size_t p) {
    Gradient<Dim, double> F;
    for (int c = 0; c < Dim * Dim; ++c) F[c] = body.deformation[c][p];
    return modulus_at(F, body.J[p]);
  });
}

/// c_eff^2 of a body with the membranes of its field, without the water that flows through it [m2/s2]. Where no bound
/// of the basis is known, waves and membranes in one sum. inverse_mass: what impulses move more than with lumped
/// masses.
template <int Dim>
double speed_squared(const Body<Dim>& body, bool bounded, double membranes, double inverse_mass) {
  /// Share of K that counts where cells bear the mean stress of a solid. Light cells at the edges of a body swing
  /// together: a panel of nu = 0.4999 breaks with 1 / 6, and bears 0.18.
  constexpr double solid_cells_to_particles = 1.0 / 3;
  const double density = reference_density(body.material);
  if (const auto* solid = std::get_if<NeoHookean>(&body.material)) {
    const auto waves = [&](const auto& F, double J) { return neo_hookean_wave_modulus<Dim>(*solid, F, J); };
    if (!bounded) return most_strained(body, waves) / density + membranes;
    const auto stiffest = [&](const auto& F, double J) { return neo_hookean_stiffest_mode<Dim>(*solid, F, J); };
    return inverse_mass * (most_strained(body, stiffest) / density + stiffest_mode<Dim>({0, 0, membranes}));
  }
  const ElasticModuli moduli = present_moduli(body);
  // Fluids keep the sum, too: splashing water bears no longer steps (docs/verification.md), and a bag of water at rest
  // circulates more with them. Their cells swing with 1.1 c^2 / h^2, a fifth of what would be stable.
  if (!bounded || moduli.shear == 0) return moduli.of_waves() / density + inverse_mass * membranes;
  const bool by_cells = body.pressure == PressureSupport::cell;
  const double bulk = moduli.bulk / density, of_cells = by_cells ? solid_cells_to_particles * bulk : 0;
  return inverse_mass * (of_cells + stiffest_mode<Dim>({by_cells ? 0 : bulk, moduli.shear / density, membranes}));
}

/// The largest [m2/s]. Eddies of a mixing length l mix with at most l sqrt(tau / rho), tau the shear stress of the step
/// before.
template <int Dim>
double viscosity_in(const Body<Dim>& body) {
  const double laminar = kinematic_viscosity(body.material);
  const auto* fluid = std::get_if<Newtonian>(&body.material);
  if (!fluid || fluid->mixing_length == 0) return laminar;
  const double square = largest(body, 0, [&](std::size_t p) {
    Stress<Dim, double> s;
    for (int c = 0; c < stress_components<Dim>; ++c) s[c] = body.stress[c][p];
    return 0.5 * norm_squared<Dim, double>(s);
  });
  return laminar + fluid->mixing_length * std::sqrt(std::sqrt(square) / fluid->density);
}

}  // namespace geodrop
