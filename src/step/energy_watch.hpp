// Ends a run whose energy grows without cause, as it does when the time step is too large for the scheme.
//
// Motion, strain and membranes may hold what they held at the start, what gravity and the motion of rigid bodies have
// given since, the work that lifts all mass by a tenth of a cell, and a velocity of 1e-6 h/dt: that is the budget. What
// holds half as much again has it from nowhere.
#pragma once

#include <geodrop/step/pipeline.hpp>

namespace geodrop {

/// Steps from one look to the next.
inline constexpr std::uint64_t energy_watch_interval = 50;

/// Largest energy over the budget [-]. Sound runs stay below 1.1, those that were seen to break go beyond 3.
inline constexpr double energy_watch_limit = 1.5;

/// Whether all that gives energy in a scene is known. Not so with pumps, still fluids, viscous boundaries, silent
/// sides, and gravity along a periodic axis.
bool watches_energy(const Scene& scene);

/// At the end of a step, every so many steps. A new budget begins with each of the scene's stages. `h` is the spacing
/// [m]. Throws RunError.
template <int Dim>
void watch_energy(const Point& gravity, double h, const StepContext& step, State<Dim>& state);

}  // namespace geodrop
