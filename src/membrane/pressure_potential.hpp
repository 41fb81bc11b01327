// The potential of pressures on membranes that depend on nothing but height: of still fluids and gauge pressures.
//
//   U = -int p dV = -sum x_k f_k
//
// over what the membrane encloses: linear in the x of its nodes (or another axis, without ends at walls), so that the
// loads f = -dU/dx tell it (Euler). They do no other work.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "fluid_load.hpp"
#include "membrane_force.hpp"
#include "surface_load.hpp"
#include "triangles.hpp"

namespace geodrop {

template <int Dim>
bool is_pressed(const std::vector<StillFluid>& fluids, const Membrane<Dim>& membrane) {
  if constexpr (Dim == 3)
    if (membrane.triangles.gauge_pressure != 0) return true;
  return std::any_of(fluids.begin(), fluids.end(), [&](const auto& fluid) { return fluid.membrane == membrane.name; });
}

/// U [J].
template <int Dim>
double pressure_potential(const std::vector<StillFluid>& fluids, const State<Dim>& state) {
  State<Dim> pressed;
  for (const Membrane<Dim>& membrane : state.membranes)
    if (is_pressed(fluids, membrane)) pressed.membranes.push_back(membrane);
  clear_membrane_loads(pressed);
  if constexpr (Dim == 2) add_still_fluids(fluids, pressed);
  if constexpr (Dim == 3) add_surface_pressure(fluids, pressed);
  double potential = 0;
  for (const Membrane<Dim>& membrane : pressed.membranes) {
    int a = 0;
    if constexpr (Dim == 3) a = axis_without_ends(membrane);
    potential -= std::inner_product(membrane.load[a].begin(), membrane.load[a].end(), membrane.x[a].begin(), 0.0);
  }
  return potential;
}

}  // namespace geodrop
