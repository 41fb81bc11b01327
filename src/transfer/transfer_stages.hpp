// The stages that move data between particles and grid: they own the parallelism, the kernels own the arithmetic.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/scene/scene.hpp>
#include <geodrop/state/state.hpp>

namespace geodrop {

/// Zeroes the fields of the active blocks.
template <int Dim>
void clear_grid(Grid<Dim>& grid);

/// Cell volumes and volume-weighted pressures, colour by colour.
template <int Dim>
void sum_particles_in_cells(const State<Dim>& state, Grid<Dim>& grid);

/// P_i of the nodes, for bodies with PressureSupport::nodal (simplex.hpp).
template <int Dim>
void average_nodal_pressure(const State<Dim>& state, Grid<Dim>& grid);

/// D_i of the nodes from the new nodal velocities, likewise.
template <int Dim>
void average_nodal_rate(const State<Dim>& state, Grid<Dim>& grid);

/// MUSL (Sulsky et al. 1995) for simplices: particles take their new velocity, and the grid takes its velocity anew
/// from them. Where nodes are nearly empty the first nodal velocity may be anything; the second is bounded by the
/// particles'.
template <int Dim>
void remap_velocity(const SolverSpec& solver, State<Dim>& state, Grid<Dim>& grid, double dt);

/// Mass, momentum and stress force of all bodies, colour by colour.
template <int Dim>
void particles_to_grid(const State<Dim>& state, Grid<Dim>& grid, double dt);

/// Moves all particles and updates their stress; renews State::v_max and adds to State::drift.
template <int Dim>
void grid_to_particles(const SolverSpec& solver, State<Dim>& state, Grids<Dim>& grids, double dt);

}  // namespace geodrop
