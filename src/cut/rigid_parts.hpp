// What rigid bodies have of the cells of a fluid that touches them (2D), and the pressure in what they leave of a cell.
//
//   s_ic = int_(c in rigid bodies) grad N_i dV
//
// The fluid's part of a cell c has int_c grad N_i - s_ic, as across a sharp interface (interface_cells.hpp): its force
// and its volume rate end at the surface, where contact acts. With the pressure of each particle in its place
// water at rest beside a rigid hull moved by 0.11 m/s (h = 0.25 m) and 0.16 m/s (0.125 m) after 4 s.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

namespace geodrop {

/// Grid::rigid_cells, rigid_splines and rigid_parts of the rigid bodies that particles of this grid's bodies may touch.
void find_rigid_parts(const State<2>& state, Grid<2>& grid);

}  // namespace geodrop
