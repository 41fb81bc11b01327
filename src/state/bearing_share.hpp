// Share of a particle's volume that its stress acts on.
#pragma once

#include <geodrop/state/state.hpp>

#include "materials/void_memory.hpp"

namespace geodrop {

/// [-]; open voids bear nothing.
template <int Dim>
double bearing_share(const Body<Dim>& body, std::size_t p) {
  const auto* const soil = std::get_if<MohrCoulombWithVoids>(&body.material);
  return soil ? 1 - void_share(*soil, body.gap[p]) : 1.0;
}

}  // namespace geodrop
