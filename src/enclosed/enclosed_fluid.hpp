// Pressure of a fluid that fills a closed membrane: exact in the cells that the membrane cuts, and at rest with nothing
// left over (PressureSupport::enclosed; 2D, quadratic B-splines on uniform axes).
//
// The pressure is split into that of the fluid's weight, known in closed form, and the rest, which the volume makes:
//
//   p = pi + gamma (y0 - y),  pi = K (1/J - 1)
//
//   weight      acts on the membrane alone: f_k = -d/dX_k [gamma int (y - y0) dA] over the polygon of its nodes;
//               inside, it balances gravity exactly and neither is computed
//   pi          f_i = sum_c pi_c int_(c inside) grad N_i,   D_c = (1/V_c) sum_i v_i . int_(c inside) grad N_i
//
// with pi_c = sum V_p pi_p / sum V_p over the particles of the cell and V_c = sum V_p: an adjoint pair, as cell
// pressure. Cells less than half inside, or of few particles, join a neighbour: both have one pressure and one rate.
// The integrals are those of polygon_moments. A uniform pi, the state at rest, gives the exact resultant on each node,
// so that no force is left over but the membrane's; sums over particles left 5 % of the pressure at the cut cells.
#pragma once

#include <geodrop/grid.hpp>
#include <geodrop/state.hpp>

namespace geodrop {

/// The parts inside of all cells, their hosts and pressures, from membranes and particles.
template <int Dim>
void update_enclosed_cells(const State<Dim>& state, Grid<Dim>& grid);

/// Adds the load of the weight of enclosed fluids to their membranes.
template <int Dim>
void add_weight_loads(State<Dim>& state);

/// Adds the forces of the pressures to the grid, and takes gravity `g` [m/s2] from the enclosed fluids.
template <int Dim>
void enclosed_force_to_grid(const State<Dim>& state, Grid<Dim>& grid, const Point& g, double dt);

/// Volume rates of enclosed cells from the nodal velocities.
template <int Dim>
void update_enclosed_rates(State<Dim>& state, Grid<Dim>& grid, double dt);

}  // namespace geodrop
