// A side of the domain through which pressure waves in still water leave: a layer of width d beside the wall in which
//
//   dp/dt + K div v = -s (p - p_0),   dv/dt + (1/rho) grad p = g - s (v - u),   s = s_1 (depth in the layer / d)^2
//
// p_0 is the pressure at rest, u the velocity of the water beyond, across the side. With one rate for both the layer
// has the impedance rho c of the water, so a wave that meets it at right angles enters unreflected and fades by
// exp(-int s dx / c) on its way to the wall and once more on its way back (an absorbing layer after Israeli & Orszag
// 1981 with the matched rates of Berenger's perfectly matched layer, 1994; without his splitting of p, so oblique waves
// come back in part). What p loses is mass that leaves through the wall: particles keep their volume. With v along the
// side left alone round waves come back a fifth less, but water at rest stirs: 4 mm/s instead of 1 mm/s after 5 s.
//
// Slow flow meets an impedance of rho c too, which in water that is nearly incompressible is nearly a wall. It shall
// get through, so the water beyond flows with it, row by row, as a column of length L (p_e: the mean pressure of the
// row at the inner edge; T: rest_time):
//
//   du/dt = (p_e - p_0) / (rho L) - u / T,   p_0 = p_still + r,   dr/dt = (p_e - p_0) / T
//
// The two in parallel send back a plane wave of angular frequency omega by the share 1 / sqrt(1 + (2 omega L / c)^2).
// r is what a grid at rest has over the exact column (rho g h / 4 in the lowest half cell, for one): without it the
// water beyond flowed in at one height and out at another, for ever and ever faster.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/scene/loads.hpp>
#include <geodrop/state/state.hpp>

namespace geodrop {

SilentSide make_silent_side(const Scene& scene, const SilentSideSpec& spec);

/// Advances the water beyond and the pressures at rest, then lets the particles in the layers fade, by one step. What
/// they gain in all, mostly nothing, joins the energy budget.
void fade_at_silent_sides(const GridLayout<2>& layout, double dt, State<2>& state);

}  // namespace geodrop
