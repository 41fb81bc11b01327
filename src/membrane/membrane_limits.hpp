// What membranes give to the limit of the time step: stiffness over the mass that they share a node with.
#pragma once

#include <geodrop/state/state.hpp>

#include <algorithm>

namespace geodrop {

/// Density of the material that a membrane's mass and stiffness share a node with [kg/m3].
template <int Dim>
double density_beside(const State<Dim>& state, const Membrane<Dim>& membrane) {
  for (const Body<Dim>& body : state.bodies)
    if (body.name == membrane.body) return reference_density(body.material);
  return 0;
}

/// Stiffness over mass of a membrane in a cell [m2/s2], of that of its body beside it or, without a body, its own.
template <int Dim>
double membrane_speed_squared(const State<Dim>& state, const Membrane<Dim>& membrane, double h) {
  const double beside = density_beside(state, membrane) * h;
  if constexpr (Dim == 2) {
    return membrane.axial_stiffness / beside;
  } else {
    const auto& cloth = membrane.triangles;
    const double stiffness = std::max(membrane.axial_stiffness / (1 - cloth.poisson_ratio), cloth.weft_stiffness);
    return stiffness / std::max(beside, cloth.mass_per_area);
  }
}

/// Of the stiffest membrane of a velocity field; 0 if it has none.
template <int Dim>
double stiffest_membrane(const State<Dim>& state, double h, int field) {
  double square = 0;
  for (const Membrane<Dim>& membrane : state.membranes)
    if (membrane.field == field) square = std::max(square, membrane_speed_squared(state, membrane, h));
  return square;
}

}  // namespace geodrop
