// The stress that a body starts with.
#pragma once

#include <geodrop/scene/scene.hpp>
#include <geodrop/state/state.hpp>

namespace geodrop {

/// Pressure of a still fluid [Pa] at height y: p = K (exp(rho0 g d / K) - 1), d = surface - y >= 0, else 0. The exact
/// weakly compressible column, so that a column at rest stays at rest at any sound speed.
double still_fluid_pressure(const Scene& scene, const HydrostaticSpec& still, double y);

/// Normal stresses of skeleton and pores together that a body of solid starts with at height y [Pa]; zero if it
/// starts from an exact solution.
struct TotalStress {
  double vertical = 0, horizontal = 0;  ///< tension positive
};
TotalStress initial_total_stress(const Scene& scene, const BodySpec& spec, double y);

/// The state variables of a body's law at zero strain, for as many particles as J has entries.
template <int Dim>
void set_unstrained(Body<Dim>& body);

/// Sets stress, pore pressure, J and mass of all particles; on entry J holds the particle's volume [m3].
template <int Dim>
void set_initial_stress(const Scene& scene, const BodySpec& spec, Body<Dim>& body);

}  // namespace geodrop
