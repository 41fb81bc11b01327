// Volume ratios of fluids whose cells have a pressure.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

namespace geodrop {

/// Volume ratios of the particles of fluids near their cell's mean, at a share of the wave speed; the volume of each
/// cell stays. No force does that: cells know means only, and what strays from them is carried along and turns up
/// elsewhere as noise of the pressure.
template <int Dim>
void even_out_volumes(State<Dim>& state, const Grids<Dim>& grids, double dt);

}  // namespace geodrop
