// Ends a run whose energy grows without cause, as it does when the time step is too large for the scheme.
//
// Motion, strain and membranes may hold what they held at the start, what has been given since, the work that lifts all
// mass by a tenth of a cell, and a velocity of 1e-6 h/dt: that is the budget. What holds half as much again has it from
// nowhere. What gives:
//
//   gravity, pressures, viscous boundaries   the most that their potential has been below that of the start
//   pumps, absorbing layers                  what they bring (state/energy_gain.hpp), as potential
//   gravity along a periodic axis            its power at a look, g . sum m v, since the look before: more than its
//                                            work while the flow speeds up
//   rigid bodies that move                   their work on what touches them
//
// Dashpots, damping and friction only take.
#pragma once

#include <geodrop/step/pipeline.hpp>

#include <vector>

#include "membrane/fluid_load.hpp"

namespace geodrop {

/// Steps from one look to the next.
inline constexpr std::uint64_t energy_watch_interval = 50;

/// Largest energy over the budget [-]. Sound runs stay below 1.1, those that were seen to break go beyond 3.
inline constexpr double energy_watch_limit = 1.5;

/// What gives energy in a scene, beside what the state tells of rigid bodies, pumps and boundaries.
struct EnergySources {
  Point gravity;                        ///< along axes with walls, where it has a potential [m/s2]
  double h;                             ///< spacing [m]
  Point endless_gravity = {};           ///< along periodic axes [m/s2]
  std::vector<StillFluid> fluids = {};  ///< at rest, on membranes
};
EnergySources energy_sources(const Scene& scene);

/// At the end of a step, every so many steps. A new budget begins with each of the scene's stages. Throws RunError.
template <int Dim>
void watch_energy(const EnergySources& sources, const StepContext& step, State<Dim>& state);

}  // namespace geodrop
