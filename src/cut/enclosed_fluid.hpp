// Pressure of a fluid that fills a closed membrane: exact in the cells that the membrane cuts, and at rest with nothing
// left over (PressureSupport::enclosed; quadratic B-splines on uniform axes; in space
// with triangles in place of edges, and all bodies of the field are such fluids).
//
// The pressure is split into that of the fluid's weight, known in closed form, and the rest, which the volume makes:
//
//   p = pi + gamma (y0 - y),  pi = K (1/J - 1),  pi_c = sum V_p pi_p / sum V_p over the particles of cell c
//
//   weight     loads the membrane alone: f_k = -d/dX_k [gamma int (y - y0) dA] over the polygon of its nodes; inside it
//              balances gravity exactly, and neither is computed
//   pi         loads the membrane by pi_c on the pieces of its edges in cell c, and acts on the nodes of the grid by
//              its jumps over the faces between cells: f_i = sum_faces (pi_c - pi_d) int_(inside) N_i dA n
//   rate       D_c = (1/V_c) (flow through the faces of c + that through the membrane's pieces in c), V_c = sum V_p
//
// Forces and rates are an adjoint pair: the work of one is the change of sum V pi of the other. The membrane's share
// comes from the velocities that its nodes move with, so that sum V_c D_c is the change of the polygon's area: with the
// exact integral along its edges instead, ripples of the membrane pumped 0.25 % of the area out of a tube in 20 s. At
// rest pi is uniform, and no force on the grid is left but those of the polygon's energy. With sums over particles in
// its place forces of 5 % of the pressure were left at the cut cells, and tension varied by 4 % along a tube.
//
// Cells less than half inside, or of few particles, join a neighbour: both have one pressure and one rate.
// Differences of pi even out slowly from cell to cell, as in delta-SPH (Molteni & Colagrossi 2009), and those of J
// within a cell: the checkerboard of pi has no force that would do it.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

namespace geodrop {

/// Cut cells, their hosts and pressures, from membranes and particles.
template <int Dim>
void update_enclosed_cells(const State<Dim>& state, Grid<Dim>& grid);

/// Adds the loads of enclosed fluids to their membranes.
template <int Dim>
void add_fluid_loads(State<Dim>& state, const Grid<Dim>& grid);

/// Adds the forces of pressure jumps to the grid, and takes gravity `g` [m/s2] from the enclosed fluids.
template <int Dim>
void enclosed_force_to_grid(const State<Dim>& state, Grid<Dim>& grid, const Point& g, double dt);

/// Volume rates of enclosed cells from the nodal velocities; evens out J within cells.
template <int Dim>
void update_enclosed_rates(State<Dim>& state, Grid<Dim>& grid, double dt);

}  // namespace geodrop
