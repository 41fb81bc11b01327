// Viscous stress of a Newtonian fluid. Its pressure K (1/J - 1) is the business of the pressure stage.
#pragma once

#include <geodrop/materials.hpp>
#include <geodrop/packet.hpp>

#include "strain.hpp"

namespace geodrop {

/// s = 2 (mu + rho l^2 |S|) dev(sym grad_v) [Pa], |S| = sqrt(2 e:e) of that deviator e. dL = dt grad_v, row-major [-].
template <int Dim, class R>
[[gnu::always_inline]] inline Stress<Dim, R> viscous_stress(const Newtonian& fluid, double dt,
                                                            const Gradient<Dim, R>& dL) {
  Stress<Dim, R> s = deviator<Dim, R>(dL);
  R two_mu = R{} + 2.0 * fluid.viscosity / dt;
  if (fluid.mixing_length > 0) {
    const double mixing = 2.0 * fluid.density * fluid.mixing_length * fluid.mixing_length / (dt * dt);
    two_mu += mixing * sqrt(2.0 * norm_squared<Dim, R>(s));
  }
  for (R& component : s) component *= two_mu;
  return s;
}

}  // namespace geodrop
