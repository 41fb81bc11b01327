// Viscous stress of a Newtonian fluid. Its pressure K (1/J - 1) is the business of the pressure stage.
#pragma once

#include "strain.hpp"

namespace geodrop {

/// s = 2 mu dev(sym grad_v) [Pa]; viscosity mu [Pa s], grad_v row-major [1/s].
template <int Dim, class R>
[[gnu::always_inline]] inline std::array<R, stress_components<Dim>> viscous_stress(
    double viscosity, const std::array<R, std::size_t{Dim * Dim}>& grad_v) {
  Stress<Dim, R> s = deviator<Dim, R>(grad_v);
  for (R& component : s) component *= 2.0 * viscosity;
  return s;
}

}  // namespace geodrop
