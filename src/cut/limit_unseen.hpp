// In cells that a sharp membrane cuts, fluids keep no velocity that their nodes do not see.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

namespace geodrop {

/// Most that the velocity of a fluid's particle in a cut cell may differ from that of the grid at its place, as a part
/// of the speed of sound. Flow that obeys its limit of the Mach number, 0.1, does so with less.
inline constexpr double most_unseen = 0.03;

/// Takes from the velocities of fluids' particles in cells that a sharp membrane cuts what is beyond most_unseen. In a
/// neck a cell wide between two flanks particles that part from each other have a mean that stands still, so that no
/// node and no pressure sees them; a pressure in the neck, which drives them apart, then adds to their velocities in
/// each step, and only the blend takes from them (a / blend_rate: 12 m/s under a gradient of 120 kPa/m).
template <int Dim>
void limit_unseen(State<Dim>& state, const Grids<Dim>& grids);

}  // namespace geodrop
