// Keeps particles in memory in the order of their base cells, slab by slab, and tells which blocks they may touch.
#pragma once

#include <geodrop/grid.hpp>
#include <geodrop/state.hpp>

namespace geodrop {

/// Stable counting sort of every body by (slab, base cell) if particles may have left the cell in which the last sort
/// found them, i.e. if the accumulated drift reached one cell; otherwise does nothing. Also renews the active blocks.
/// Throws RunError naming body and particle if a particle is not a finite point of the domain, or its volume ratio not
/// above 0.
template <int Dim>
void sort_particles_if_due(State<Dim>& state, Grids<Dim>& grids);

/// Largest drift since the sort that the colouring and the active blocks allow, in (finest) cells.
inline constexpr double allowed_drift_cells = 0.99;

}  // namespace geodrop
