// Pore pressure of undrained soil, found at the end of the step (implicit Euler): the time step follows the skeleton,
// not the water in its pores, which may be as stiff as it is.
//
//   dp_c = -dt K_c D_c(v'),   v'_i = v_i + (dt / m_i) sum_c g_ic dp_c,   D_c = (1 / V_c) sum_i g_ic . v'_i
//
// K_c: mean of K_f / n over the cell's volume; g_ic = int_c grad N_i as in grid/cell_pressure, softened as there. Only
// the velocities change here: the particles' pore pressures follow from the volume rates as without it. The system
// (V_c / (K_c dt^2) + g M^-1 g^T) q = -g . v for q = dt dp is symmetric and positive definite, whatever the masses of
// nodes: those of small mass take all of their impulse here. Conjugate gradients.
// Parts of cells beside a sharp interface that share a pressure are one row. There nodes of small mass hand on what
// they cannot take, as their volume rates see it (carried_velocity). After join_interfaces: the velocities that this
// leaves are those of the volume rates, so that at rest the stored pore pressure is the one that acts. As the
// semi-implicit treatment of pressure by Chorin (1968), with compressibility.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

namespace geodrop {

/// Adds what the change of pore pressure does to the nodal velocities; throws RunError if it is not found.
template <int Dim>
void press_cells(Grid<Dim>& grid, double dt);

/// The same, unless the last step found that this one has to be explicit (BodySettings::implicit_pores); renews that.
/// Particles in cells that carry no pressure act by themselves, with all of their stiffness.
template <int Dim>
void press_pores(State<Dim>& state, Grid<Dim>& grid, double dt);

}  // namespace geodrop
