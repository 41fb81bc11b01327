// Normal velocities on both sides of a sharp interface are one, weakly: for each stretch r of a membrane, about a cell
// long,
//
//   sum_c in r sum_i b_ic . (v_i inside - v_i around) = 0
//
// Its multiplier p_r is the pressure on the membrane [Pa]: v_i inside -= dt p_r b_ir / m_i, around += dt p_r b_ir / m_i.
// What light nodes cannot take goes to their neighbours, here as in grid/momentum, so that an even pressure inside, around
// and on the membrane leaves no node with a force; b is spread in the same way, so that the system
//
//   S p = E v / dt,  S = E M^-1 E^T
//
// stays symmetric, and all impulses come in pairs. Conjugate gradients, from the pressures of the last step.
//
// On the bed, if the membrane names one, p_r is at least the pressure u_r of the water in its pores: with less the
// membrane parts from it, and water follows. Friction along the membrane is at most mu (p_r - u_r).
#pragma once

#include <geodrop/grid.hpp>
#include <geodrop/state.hpp>

namespace geodrop {

/// Makes the velocities on both sides of sharp membranes agree, by equal and opposite impulses; renews
/// Membrane::water_pressure.
template <int Dim>
void join_interfaces(State<Dim>& state, Grids<Dim>& grids, double dt);

}  // namespace geodrop
