// An edge of the ground that lets waves out (Lysmer & Kuhlemeyer 1969): beyond it nothing is simulated, and what the
// ground there would do to the edge is a traction
//
//   t = t_0 - rho c_s v_t - (rho c_p v_n + k u_n) n,   k = rho c_p^2 / depth,   t_0 = sigma_0 n
//
// n points out of the body. sigma_0 is the stress of the start, so ground at rest stays at rest; t_0 acts at the edge
// itself. v and u are velocity and displacement of points h/2 apart, which ride with the outermost particles, half a
// particle inside: at the edge itself they would push nodes that hardly have a mass, which is stable only up to
// C = 0.5, with one particle a cell or GIMP not even there. The mass beyond them makes up for the dashpots' being half
// a time step late (P, h = 0.25 m: 0.4 % of the amplitude are reflected, 0.9 % with points at the edge).
//
// The spring is that of a layer of the same ground on rock; without it the edge would drift for ever under a load that
// stays. A P wave of angular frequency omega that meets the edge at right angles is reflected by the share
// 1 / sqrt(1 + (2 omega depth / c_p)^2), which is the spring's own; dashpots alone leave nothing of it.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/scene/loads.hpp>
#include <geodrop/state/state.hpp>

namespace geodrop {

/// The body must be in the state already.
ViscousBoundary<2> make_viscous_boundary(const Scene& scene, const ViscousBoundarySpec& spec, const State<2>& state);

/// Traction of dashpots and spring on the body at a point, t - t_0 [Pa].
template <int Dim>
Vec<Dim> yielding_traction(const ViscousBoundary<Dim>& boundary, std::size_t point);

/// sum l (k u_n^2 / 2 - t_0 . u) [J]: what the springs hold and the pushes of the start have not yet given. Dashpots
/// only take.
template <int Dim>
double boundary_potential(const State<Dim>& state);

/// Adds the forces of all points to the grid.
template <int Dim>
void boundaries_to_grid(const State<Dim>& state, Grid<Dim>& grid, double dt);

/// Moves the points with the grid velocity; adds their displacement to State::drift.
template <int Dim>
void grid_to_boundaries(State<Dim>& state, const Grid<Dim>& grid, double dt);

}  // namespace geodrop
