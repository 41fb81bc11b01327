// What a feature brings into a run from outside, for the energy watch.
#pragma once

#include <geodrop/state/state.hpp>

#include <algorithm>

namespace geodrop {

struct EnergyGain {
  double held = 0;    ///< in motion and strain [J]
  double height = 0;  ///< potential in gravity [J]

  EnergyGain& operator+=(const EnergyGain& other) {
    held += other.held;
    height += other.height;
    return *this;
  }
};

/// A feature that takes gives nothing back later: where swings pass through a pump by turns, the small difference of
/// what goes in and out would be the scheme's error.
inline void give(const EnergyGain& gain, EnergyBudget& budget) {
  budget.potential += std::max(0.0, gain.held) + gain.height;
}

}  // namespace geodrop
