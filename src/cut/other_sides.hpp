// Fill ratios of nodes beside a sharp membrane, for the shifting of particles.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

namespace geodrop {

/// Adds to the fill ratios of nodes what lies on the other side: particles shift away from crowds and into voids beside
/// the membrane as elsewhere, and keep their distance from it.
template <int Dim>
void fill_other_sides(const State<Dim>& state, Grids<Dim>& grids);

}  // namespace geodrop
