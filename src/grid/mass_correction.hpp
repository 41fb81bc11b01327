// The consistent mass matrix, to the second term of its inverse.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

namespace geodrop {

/// Corrects velocity and velocity change of the nodes for the lumping of mass (Guermond & Pasquetti 2013):
///
///   M^-1 f = (I + (I - D^-1 M) + ...) D^-1 f,    a_i += sum_j s min(m_i, m_j) / m_i (a_i - a_j)
///
/// M is the consistent, D the lumped mass matrix; j are the neighbours along the axes. In a full lattice D^-1 M is
/// I + s h^2 laplace to second order; s = 1/4 for quadratic B-splines, 1/6 for hat functions. On graded axes that holds
/// but for the growth of the cells: the smaller mass stands for that of a cell between the nodes. Walls mirror.
/// Particles do not take part, so it costs as much as the momentum of the grid, not a second transfer (FMPM(2)).
template <int Dim>
void correct_mass(Grid<Dim>& grid);

}  // namespace geodrop
