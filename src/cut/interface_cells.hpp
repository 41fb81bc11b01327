// A sharp interface between the body inside a closed membrane and what is around it (quadratic B-splines): each has a
// velocity field of its own, and the cells that the membrane cuts are shared exactly.
//
//   a_ic = int_(c inside) grad N_i dV,  G_ic = int_c grad N_i dV,  b_ic = int_(membrane in c) N_i n dl
//
// The body's field has the part a_ic of a cut cell, the field around it the part G_ic - a_ic. With g_ic the part of a
// field, P and D of that field as in grid/cell_pressure:
//
//   f_i = sum_c P_c g_ic,   D_c = sum_i v_i . g_ic / sum V_p
//
// Since sum_c a_ic = sum_c b_ic, an even pressure on both sides and on the membrane leaves no node with a force.
// Cells of which a field has less than half, or few particles, join a neighbour: both have one pressure and one rate.
// Method: cut cells as in Fries & Belytschko's review of XFEM (2010), the merging of small cells of cut-cell
// finite-volume methods (Ye et al. 1999).
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

#include <array>
#include <functional>
#include <type_traits>

namespace geodrop {

/// Cuts the cells at sharp membranes; Grid::taken of the fields on both sides.
template <int Dim>
void cut_interface_cells(const State<Dim>& state, Grids<Dim>& grids);

/// Pressures of the parts of cut cells, from those that grid/cell_fill left.
template <int Dim>
void share_interface_pressure(const State<Dim>& state, Grids<Dim>& grids);

template <int Dim>
using ForceAtNode = std::type_identity_t<std::function<void(int, const std::array<double, Dim>&)>>;

/// f(node, force [N]): what turns the force of the whole cells of a field into that of their parts.
template <int Dim>
void for_each_interface_force(const Grid<Dim>& grid, const ForceAtNode<Dim>& f);

/// Turns the force of whole cells, which grid/momentum adds, into that of their parts: to Grid::force [N]. Before,
/// parts too stiff for a step of dt [s] are softened. Water in pores shares its own with the grains, see pores/pores.
template <int Dim>
void add_interface_force(Grids<Dim>& grids, double dt);

/// Volume rates of the parts of cut cells.
template <int Dim>
void update_interface_rates(Grids<Dim>& grids);

}  // namespace geodrop
