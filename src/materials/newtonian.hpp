// Viscous stress of a Newtonian fluid. Its pressure K (1/J - 1) is the business of the pressure stage.
#pragma once

#include <geodrop/base/packet.hpp>
#include <geodrop/materials/materials.hpp>

#include "strain.hpp"

namespace geodrop {

/// s = 2 (mu + rho l^2 |S|) dev(sym grad_v) [Pa], |S| = sqrt(2 e:e) of that deviator e; l = eddy_length [m].
/// dL = dt grad_v, row-major [-].
template <int Dim, class R>
[[gnu::always_inline]] inline Stress<Dim, R> viscous_stress(const Newtonian& fluid, double dt,
                                                            const Gradient<Dim, R>& dL, R eddy_length) {
  Stress<Dim, R> s = deviator<Dim, R>(dL);
  R two_mu = R{} + 2.0 * fluid.viscosity / dt;
  if (fluid.mixing_length > 0) {
    const double mixing = 2.0 * fluid.density / (dt * dt);
    two_mu += mixing * (eddy_length * eddy_length) * sqrt(2.0 * norm_squared<Dim, R>(s));
  }
  for (R& component : s) component *= two_mu;
  return s;
}

template <int Dim, class R>
void update_point(auto& points, const Newtonian& water, const auto& rates, double dt, std::size_t p, int k) {
  store(&points.J[p], load<R>(&points.J[p]) * (1 + load<R>(&rates.volume[k])));
  if (!water.viscous()) return;
  const R eddy_length = water.mixing_length > 0 ? load<R>(&points.eddy_length[p]) : R{};
  const auto s = viscous_stress<Dim, R>(water, dt, load_increment<Dim, R>(rates, k), eddy_length);
  for (int c = 0; c < stress_components<Dim>; ++c) store(&points.stress[c][p], s[c]);
}

inline Newtonian make(const NewtonianSpec& spec) {
  Newtonian fluid{spec.density, spec.bulk_modulus, spec.viscosity, spec.mixing_length, spec.tension_cutoff};
  fluid.unit_weight = spec.still_level ? spec.unit_weight : 0;
  fluid.still_level = spec.still_level.value_or(0);
  return fluid;
}

}  // namespace geodrop
