// Entries of the hot loops. Each works on a range of one body's particles and knows nothing of threads.
#pragma once

#include "gather.hpp"

namespace geodrop {

/// Adds mass, momentum and stress force of particles [begin, end) to the grid. If the grid has no separate force
/// record, dt times the force joins the momentum.
template <int Dim>
void scatter(const Body<Dim>& body, Grid<Dim>& grid, double dt, std::size_t begin, std::size_t end);

/// Moves particles [begin, end), updates their volume and stress.
template <int Dim>
Maxima gather(Body<Dim>& body, const Grid<Dim>& grid, const GatherOptions& options, std::size_t begin, std::size_t end);

/// Adds V_p, and V_p p_p of bodies with cell pressure, to the base cells of particles [begin, end).
template <int Dim>
void sum_cells(const Body<Dim>& body, Grid<Dim>& grid, std::size_t begin, std::size_t end);

}  // namespace geodrop
