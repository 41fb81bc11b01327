// The stable time step of the explicit scheme.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/scene/scene.hpp>
#include <geodrop/state/state.hpp>

#include <cstddef>
#include <map>
#include <vector>

#include "pores/pore_soils.hpp"

namespace geodrop {

struct StepLimits {
  double courant;                               ///< [-]
  double end;                                   ///< of the simulated time [s]
  bool bounded;                                 ///< whether particles cannot swing faster than stiffest_mode.hpp says
  std::vector<double> inverse_mass;             ///< by velocity field, the most, over that of lumped masses [-]
  std::map<std::size_t, PoreWaves> pore_waves;  ///< by body

  explicit StepLimits(const Scene& scene);

  /// What waits for its stage has no field yet.
  double inverse_mass_of(int field) const {
    const auto number = static_cast<std::size_t>(field);
    return number < inverse_mass.size() ? inverse_mass[number] : 1.0;
  }
};

/// Stable time step [s] of the present state; throws RunError if it collapses.
template <int Dim>
double stable_dt(const StepLimits& limits, const State<Dim>& state, const GridLayout<Dim>& layout);

template <int Dim>
double stable_dt(const Scene& scene, const State<Dim>& state, const GridLayout<Dim>& layout) {
  return stable_dt(StepLimits(scene), state, layout);
}

}  // namespace geodrop
