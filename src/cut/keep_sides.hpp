// Particles stay on their side of a sharp membrane.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

namespace geodrop {

/// Moves particles that are on the wrong side of a sharp membrane to its nearest point. Cells know where the membrane
/// is on the average of a cell only, and a particle that has slipped through is out of reach of any pressure: it falls
/// freely and comes out elsewhere at speed. Momentum stays.
template <int Dim>
void keep_sides(State<Dim>& state, const Grids<Dim>& grids);

}  // namespace geodrop
