// Pressure and volume rate of knot-span cells: an adjoint pair, so that neither pumps energy into the other.
//
//   P_c = sum V_p p_p / sum V_p,   f_i = sum_c P_c int_c grad N_i,   D_c = (1/V_c) sum_i v_i . int_c grad N_i
//
// Smoothing only one of the two blows up a column of water or sinks it (trials); docs/step.md, "cell_pressure".
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

namespace geodrop {

/// A cell is filled where the binomially smoothed fill ratio is at least this; one with soil whose pore pressure is
/// implicit is, however little: that soil hardly changes its volume, whatever of the cell it has.
inline constexpr double filled_ratio = 0.7;

/// Whether a cell has a pressure and a volume rate of its own.
template <int Dim>
bool carries_pressure(const Grid<Dim>& grid, int flat) {
  return (grid.cell_flags[flat] & cell_filled) && grid.cell_volume[flat] > 0;
}

/// Turns the particle sums of the cells into pressures; decides which cells are filled, and (if `shift`) where
/// particles shift.
template <int Dim>
void average_cell_pressure(const State<Dim>& state, Grid<Dim>& grid, bool shift);

/// One number for each cell of a row of a block.
template <int Dim>
using CellRow = std::array<double, GridLayout<Dim>::block_width[0]>;

/// S = (dt w)^2 of `count` cells along x, each alone, from flat index `begin`, stored coordinates `cell`, from the
/// folded nodal masses [-].
template <int Dim>
CellRow<Dim> cell_swing(const Grid<Dim>& grid, int begin, int count, const std::array<int, Dim>& cell, double dt);

/// The same for the parts of cells beside a sharp interface that share a pressure, before their force joins the nodal
/// one; the share stands in PartCell::share.
template <int Dim>
void soften_light_parts(Grid<Dim>& grid, double dt);

/// Where a cell has S > 1 its pressure takes the share sqrt(1/S), and so will its volume rate: the pair stays adjoint.
/// The share of each cell stands in Grid::volume_rate until cell_volume_rate. Parts of cells beside a sharp interface
/// keep theirs.
template <int Dim>
void soften_light_cells(Grid<Dim>& grid, double dt);

/// D_c of all filled cells from the new nodal velocities, times the share of soften_light_cells.
template <int Dim>
void cell_volume_rate(Grid<Dim>& grid);

/// What integrals of slopes from Grid::integrals are multiplied with: a face of a cell of the width h [m, m2].
template <int Dim>
double face_measure(const GridLayout<Dim>& layout) {
  return Dim == 2 ? layout.h : layout.h * layout.h;
}

/// int dN/dx_component over a cell, of the node that is entry `a` of its neighbourhood, walls folded in; h = 1; cell:
/// stored coordinates.
template <int Dim>
double slope_integral(const Grid<Dim>& grid, const std::array<int, Dim>& cell, const std::array<int, Dim>& a,
                      int component) {
  double integral = 1;
  for (int axis = 0; axis < Dim; ++axis) {
    const auto& table = grid.integrals[axis];
    integral *= axis == component ? table.slope[cell[axis]][a[axis]] : table.value[cell[axis]][a[axis]];
  }
  return integral;
}

/// Nodes of a row of a block, in one structure of arrays.
template <int Dim>
using RowForce = std::array<CellRow<Dim>, Dim>;

/// Sums over the rows around a row, with one node or cell more at both ends.
template <int Dim>
using WideRow = std::array<double, GridLayout<Dim>::block_width[0] + 2>;

/// Force of the cell pressures on `count` nodes along x from flat index `begin`, stored coordinates `node` [N].
template <int Dim>
RowForce<Dim> cell_pressure_force(const Grid<Dim>& grid, int begin, int count, const std::array<int, Dim>& node);

}  // namespace geodrop
