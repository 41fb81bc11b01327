// Pressure and volume rate of knot-span cells: an adjoint pair, so that neither pumps energy into the other.
//
//   P_c = sum V_p p_p / sum V_p,   f_i = sum_c P_c int_c grad N_i,   D_c = (1/V_c) sum_i v_i . int_c grad N_i
//
// design.md section 2, steps 1, 2, 5: "Smoothing only one of them blows up or sinks the column".
#pragma once

#include <geodrop/grid.hpp>
#include <geodrop/state.hpp>

namespace geodrop {

/// A cell is filled where the binomially smoothed fill ratio is at least this.
inline constexpr double filled_ratio = 0.7;

/// Turns the particle sums of the cells into pressures; decides which cells are filled, and (if `shift`) where
/// particles shift.
template <int Dim>
void average_cell_pressure(const State<Dim>& state, Grid<Dim>& grid, bool shift);

/// D_c of all filled cells from the new nodal velocities.
template <int Dim>
void cell_volume_rate(const State<Dim>& state, Grid<Dim>& grid);

/// Force of the cell pressures on the node with stored coordinates `node`, flat index `flat` [N].
template <int Dim>
std::array<double, Dim> cell_pressure_force(const Grid<Dim>& grid, const std::array<int, Dim>& node, int flat);

}  // namespace geodrop
