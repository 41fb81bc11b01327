// The consistent mass matrix beside sharp membranes, to the second term of its inverse.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

namespace geodrop {

/// Corrects velocity and velocity change of the nodes for the lumping of mass, as grid/mass_correction does, by the
/// particles p in cells that a sharp membrane cuts and their neighbours:
///
///   a_i += sum_p m_p N_ip (a_i - sum_j N_jp a_j) / m_i
///
/// Lumping takes a change of velocity a_i, which is the mean over what the spline of a node holds, for that at the
/// node: at an interface, where all of that lies on one side, the flow has too much energy, by (rho h^2 / 8) int |grad
/// v|^2. That of a flow without divergence and spin is a sum over the interface: particles further away change nothing.
/// The sum of m_i a_i is kept; the mass of cloth in m_i stays lumped. Fields of coupled soils and of the water in their
/// pores keep the lumped mass: the forces of pore pressure come after this.
template <int Dim>
void correct_mass_at_membranes(const State<Dim>& state, Grids<Dim>& grids);

}  // namespace geodrop
