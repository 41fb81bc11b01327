// The stable time step of the explicit scheme.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/scene/scene.hpp>
#include <geodrop/state/state.hpp>

namespace geodrop {

struct StepLimits {
  double courant;  ///< [-]
  double end;      ///< of the simulated time [s]

  explicit StepLimits(const Scene& scene) : courant(scene.solver.courant), end(scene.time.end) {}
};

/// Stable time step [s] of the present state; throws RunError if it collapses.
template <int Dim>
double stable_dt(const StepLimits& limits, const State<Dim>& state, const GridLayout<Dim>& layout);

template <int Dim>
double stable_dt(const Scene& scene, const State<Dim>& state, const GridLayout<Dim>& layout) {
  return stable_dt(StepLimits(scene), state, layout);
}

}  // namespace geodrop
