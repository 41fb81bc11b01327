// Normal velocities on both sides of a sharp interface are one, weakly: with e_r = sum_c in r sum_i b_ic . (v_i inside
// - v_i around) of the stretches r of a membrane, each about a cell long,
//
//   sum_r B_rk e_r = 0
//
// for each knot k (traction_basis). Its multiplier p_k is the pressure on the membrane
// there [Pa], p_r = sum_k B_rk p_k that on a stretch: v_i inside -= dt p_r b_ir / m_i, around += dt p_r b_ir / m_i.
// What light nodes cannot take goes to their neighbours, here as in grid/momentum, so that an even pressure inside,
// around and on the membrane leaves no node with a force; b is spread in the same way, so that the system
//
//   S p = E v / dt,  S = E M^-1 E^T,  rows of E by knots
//
// stays symmetric, and all impulses come in pairs. traction_solver solves it.
//
// Where the fluid sticks to the membrane (Shear::no_slip) a second row for each stretch says the same of the velocities
// along it. Otherwise friction follows: at most mu (p_r - u_r) on a bed, if the membrane names one, u_r the pressure of
// the water in its pores; at most 1/2 rho C_f u^2 in fluid that slips with the velocity u (Shear::wall_law).
// In space two rows stand for the directions along each stretch, and their tractions are limited together.
// The membrane does not part from a fluid. From a bed it does rather than pull: p_r >= 0 there, with a gap that only
// opens where p_r = 0. Anchors are rows of the same system, see anchor_rows.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

#include <vector>

#include "cloth_knots.hpp"

namespace geodrop {

/// Makes the velocities on both sides of sharp membranes agree, by equal and opposite impulses; renews
/// Membrane::water_pressure and water_shear, and force and stretch of anchors there. Throws RunError where one of them
/// is not finite. knots: of the membranes in space, which the first call finds; in the plane there are none.
template <int Dim>
void join_interfaces(State<Dim>& state, Grids<Dim>& grids, double dt, std::vector<ClothKnots>& knots);

/// Counts steps whose tractions fell short of the tolerance; throws RunError at the hundredth in a row. t [s].
void count_solution(bool converged, double t, ConstraintWatch& watch);

}  // namespace geodrop
