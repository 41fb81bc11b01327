// Particles of fluids that come closer to each other than their size are pushed apart.
//
// Where a flow stretches, particles draw up in lines, close to each other along the line and further than a cell from
// the next one. Fill ratios of nodes a cell apart do not see that: particles that shift down their gradient stay on
// their line until there are voids between the lines.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

namespace geodrop {

/// Particles that move by so much, in (finest) cells, between two times that they are spread.
inline constexpr double spread_every_cells = 0.25;

/// Spreads the particles of fluids that shift if they have moved by `spread_every_cells` since the last sort, and makes
/// a sort due. In grid coordinates q, in which a cell is 1 wide on graded axes, too, the size of a particle is
/// s = (V_p / V_c)^(1/Dim), and twice
///   dq_p = sum_q (s_pq - |r|)/4 r/|r|,  r = q_p - q_q,  s_pq = (s_p + s_q)/2,
/// over all that are closer than s_pq, images beyond walls and periodic seams included, at most s_p/10. Particles push,
/// but do not move themselves, in cells that have a neighbour that is not shiftable or rigid, or that another body has
/// a part of. The velocity follows its gradient, v_p += C_p dx. In a lattice nothing is closer than s: it stays as it
/// is.
template <int Dim>
void spread_particles_if_due(State<Dim>& state, const Grids<Dim>& grids);

/// The same for one body, whatever its motion.
template <int Dim>
void spread_particles(const Grid<Dim>& grid, Body<Dim>& body);

}  // namespace geodrop
