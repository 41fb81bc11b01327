// Particles stay on their side of a sharp membrane.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

namespace geodrop {

/// Moves particles that are on the wrong side of a sharp membrane to its nearest point. Cells know where the membrane
/// is on the average of a cell only, and a particle that has slipped through is out of reach of any pressure: it falls
/// freely and comes out elsewhere at speed. What moved it through the membrane, at most its velocity towards the
/// membrane, is taken from it and left to the membrane's nodes, Membrane::caught [N s], that the next step puts on the
/// grid: momentum stays, and a jet through a fold that the grid does not resolve ends there.
template <int Dim>
void keep_sides(State<Dim>& state, const Grids<Dim>& grids, double dt);

}  // namespace geodrop
