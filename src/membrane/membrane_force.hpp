// Tension-only membranes of two-node segments, or in space of triangles (triangles.hpp), and their transfer to and from
// the grid.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

namespace geodrop {

/// Strain e = (L - L0)/L0 of each segment, T = max(0, J e): fills `strain` and `tension`. In space those of triangles.
template <int Dim>
void update_tension(Membrane<Dim>& membrane);

/// Forces of the tensions on the nodes [N], dim-major: their work is elastic energy.
template <int Dim>
std::array<Array<double>, Dim> membrane_forces(const Membrane<Dim>& membrane);

/// Renews the tensions of a field's membranes, for the step from `t` to `t + dt` [s], and adds their mass, momentum and
/// force to the grid.
template <int Dim>
void membranes_to_grid(State<Dim>& state, Grid<Dim>& grid, double t, double dt);

/// MUSL (transfer/baseline/remap.hpp): membrane nodes take their new velocity; positions stay.
template <int Dim>
void update_membrane_velocity(const SolverSpec& solver, State<Dim>& state, const Grid<Dim>& grid, double dt);

/// MUSL: mass and momentum of all membranes back to the grid.
template <int Dim>
void sum_membrane_momentum(const State<Dim>& state, Grid<Dim>& grid);

/// The coordinate [m], or the wall that round-off carried it across.
template <int Dim>
double back_on_grid(const GridLayout<Dim>& layout, int axis, double x);

/// Moves membrane nodes with the grid velocity, but those of sharp skins (move_skins); adds their displacement to
/// State::drift.
template <int Dim>
void grid_to_membranes(const SolverSpec& solver, State<Dim>& state, const Grid<Dim>& grid, double dt);

/// Velocities of the grid at the nodes of a membrane [m/s].
template <int Dim>
std::array<Array<double>, Dim> node_velocities(const Membrane<Dim>& membrane, const Grid<Dim>& grid);

/// Membrane::load := 0 where there is any.
template <int Dim>
void clear_membrane_loads(State<Dim>& state);

/// Moves tracers with the grid velocity.
template <int Dim>
void grid_to_tracers(State<Dim>& state, const Grid<Dim>& grid, double dt);

}  // namespace geodrop
