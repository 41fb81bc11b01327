// Pore water that flows through a sharp membrane: Membrane::seepage, which cut/interface_constraint found in the last
// step, as mass that particles of the water on one side hand to those on the other.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

namespace geodrop {

/// For each cell that a membrane cuts: the particles in the cells that share its pressure inside, and those of the
/// fluid around in the cells that share it there, exchange the mass that flows in a step, with the mean velocity of
/// the givers. Mass and momentum are kept to round-off; particles stay on their side. What flows out into air leaves
/// the scene.
template <int Dim>
void seep(State<Dim>& state, const Grids<Dim>& grids, double dt);

}  // namespace geodrop
