// Anchors: nodes of membranes that are held, or that hang on lines. Their impulses change the nodal velocity after all
// forces have acted, implicitly, so that neither a rigid line nor a stiff one limits the time step.
//
// A node k sees v_k = sum_i N_i v_i. An impulse P on it gives the nodes dv_i = N_i P / (M_i s), M_i their mass, or that
// of a light node if it is less, s = sum_i N_i m_i / M_i, and itself a P, a = sum_i N_i^2 / M_i / s. Held at X:  v_k dt
// = X - x_k. A line of compliance C and rest length L to a point X, e the unit vector towards it, has the tension T of
// the end of the step, of linear complementarity with T >= 0:
//
//   C T = |X - x_k| - L - dt e . v_k,   P = dt T e
//
// Anchors whose nodes share grid nodes are swept until none has to change (projected Gauss-Seidel).
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/scene/scene.hpp>
#include <geodrop/state/state.hpp>

namespace geodrop {

/// The nearest node of its membrane.
template <int Dim>
Anchor<Dim> make_anchor(const AnchorSpec& spec, const State<Dim>& state);

/// Of a field's membranes without a sharp interface (those: cut/anchor_rows): changes the nodal velocity and its
/// change, keeps force and stretch.
template <int Dim>
void hold_anchors(State<Dim>& state, Grid<Dim>& grid, double dt);

/// With Transfer::musl, after velocities were mapped anew from the particles: makes the nodes move as hold_anchors
/// found. Only positions and strains follow these velocities, so that no momentum comes from it.
template <int Dim>
void hold_remapped(State<Dim>& state, Grid<Dim>& grid, double dt);

}  // namespace geodrop
