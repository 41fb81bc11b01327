// Pressures that change from cell to cell and push no node.
//
// The nodal force of the cell pressures P_c is a central difference: of stripes and checkerboards (+, -, +, ...) it
// sees nothing, and the velocities answer with nothing. In water particles carry them away; undrained soil keeps them.
// They are taken out of the pore pressure u by a filter of fourth order along each axis,
//
//   D_c = (P_c+1 - P_c) / d+ - (P_c - P_c-1) / d-,   du_c = -r dt ((q_c+1 - q_c) / d+ - (q_c - q_c-1) / d-) / w_c,   q
//   = w^3 D,
//
// w: width of a cell, d: distance of centres, both in h; r: 0.1 c / (16 h Dim). Where the pressure is linear nothing
// changes; the sum of V u and its first moment stay; sum V P du <= 0. A checkerboard fades at 0.1 c / h, a stripe along
// one axis at 1 / Dim of that, a wave of 8 cells at 2 % of it.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/scene/scene.hpp>
#include <geodrop/state/state.hpp>

namespace geodrop {

/// Undrained soil whose pore pressure follows its law and acts by cells.
bool has_checkerboard(const Scene& scene, const BodySpec& body);
template <int Dim>
bool has_checkerboard(const Body<Dim>& body);

/// Changes the pore pressure of particles in cells that such soil fills, whose neighbours it fills too.
template <int Dim>
void filter_checkerboard(State<Dim>& state, Grid<Dim>& grid, double dt);

}  // namespace geodrop
