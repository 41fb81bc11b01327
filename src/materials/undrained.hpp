// Pore water that cannot leave: it follows the volume of the skeleton.
#pragma once

#include <geodrop/materials/materials.hpp>

namespace geodrop {

/// Increment of pore pressure [Pa], compression positive: du = -(K_f / n) dvol; grains taken as rigid.
template <class R>
[[gnu::always_inline]] inline R pore_pressure_increment(const MohrCoulomb& soil, const R& dvol) {
  return -soil.pore_stiffness * dvol;
}

}  // namespace geodrop
