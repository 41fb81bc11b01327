// Water that flows through the pores of a soil: two velocities in one place (v-w form; double-point material points,
// Bandara & Soga 2015; Wang et al. 2018).
//
// Particles of the soil are the skeleton: effective stress, 1 - n = (1 - n0) / J. Particles of the water are those of a
// fluid body, whose volume in pores is that of the water alone. Both have a velocity field of their own:
//
//   m_s a_s = -(1 - n) grad p + div sigma' + m_s g + R,   m_w a_w = -n grad p + m_w g - R,
//   R = n^2 gamma_w / k (v_w - v_s) V,   k = k0 (n^3 / (1 - n)^2) / (n0^3 / (1 - n0)^2)   (Darcy; Kozeny-Carman, unless
//   constant)
//
// The pressure p is that of the cells of the water. Its force on a node is divided by the node's porosity n_i; the rate
// of a cell's water is the adjoint, from the velocity n_i v_w + (1 - n_i) v_s of the mixture. An even pressure so moves
// nothing, wherever the porosity jumps. The drag R is implicit, node by node: the time step does not depend on k.
//
// With Forchheimer's term R += n^3 gamma_w b |v_w - v_s| (v_w - v_s) V, so that i = q / k + b q^2 of the flow
// q = n (v_w - v_s); b = b0 ((1 - n) / n^3) / ((1 - n0) / n0^3) (Ergun 1952), unless constant.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

#include <vector>

#include "pore_soils.hpp"

namespace geodrop {

/// Grains in the cells and drag resistance, of the soils and where the water is.
template <int Dim>
void sum_grains(const std::vector<PoreSoil>& soils, const State<Dim>& state, Grids<Dim>& grids);

/// Porosity and resistance at the nodes of the water; cells too stiff for the step give up pressure; the soil's part of
/// the pressure joins its nodal forces.
template <int Dim>
void share_pore_pressure(const std::vector<PoreSoil>& soils, double dt, Grids<Dim>& grids);

/// Drag between both new nodal velocities: an impulse and its opposite.
template <int Dim>
void drag_pore_water(const std::vector<PoreSoil>& soils, double dt, Grids<Dim>& grids);

/// The change of pressure at the end of the step, of undrained soils and of pore water that say so
/// (grid/implicit_pressure); side by side where these have fields of their own. Throws RunError if one is not found.
template <int Dim>
void press_implicitly(const std::vector<PoreSoil>& soils, double dt, State<Dim>& state, Grids<Dim>& grids);

/// Volume rate of the water in cells: that of the mixture over the volume of the water, times the share of cells that
/// gave up pressure.
template <int Dim>
void update_pore_rate(const std::vector<PoreSoil>& soils, Grids<Dim>& grids);

}  // namespace geodrop
