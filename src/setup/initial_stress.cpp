#include "initial_stress.hpp"

#include <cmath>
#include <stdexcept>

namespace geodrop {
namespace {

const NewtonianSpec& fluid_of(const Scene& scene, const std::string& name) {
  for (const MaterialSpec& material : scene.materials)
    if (material.name == name) return std::get<NewtonianSpec>(material.model);
  throw std::logic_error("check_scene let an unknown fluid pass: " + name);
}

/// Vertical and horizontal effective stress, and pressure of the fluid, at one height.
struct StressAt {
  double vertical = 0, horizontal = 0;  ///< [Pa], tension positive
  double fluid_pressure = 0;            ///< [Pa]
};

StressAt stress_at(const Scene& scene, const InitialStress& initial, double density, double y) {
  StressAt out;
  if (const auto* still = std::get_if<HydrostaticSpec>(&initial)) {
    out.fluid_pressure = still_fluid_pressure(scene, *still, y);
  } else if (const auto* bag = std::get_if<FluidPressureSpec>(&initial)) {
    out.fluid_pressure = still_fluid_pressure(scene, bag->fluid, y);
  } else if (const auto* soil = std::get_if<K0StressSpec>(&initial)) {
    const double g = -scene.gravity[scene.dimension - 1], depth = std::max(0.0, soil->surface - y);
    double buoyancy = 0;
    if (soil->fluid) {
      // Below the soil's surface the pressure goes on from there at the fluid's density at zero pressure; with the
      // soil's own weight as total stress the effective stress is that of the buoyant soil, whatever the fluid's
      // compression.
      const double at_surface = still_fluid_pressure(scene, *soil->fluid, soil->surface);
      const NewtonianSpec& fluid = fluid_of(scene, soil->fluid->fluid);
      buoyancy = fluid.density;
      out.fluid_pressure = at_surface + fluid.density * g * depth;
    }
    out.vertical = -(density - buoyancy) * g * depth;
    out.horizontal = soil->k0 * out.vertical;
  }
  return out;
}

template <int Dim>
void set_fluid(const Newtonian& water, const StressAt& at, Body<Dim>& body, std::size_t p) {
  const double volume = body.J[p];
  body.J[p] = 1 / (1 + at.fluid_pressure / water.bulk_modulus);
  body.mass[p] = water.density * volume / body.J[p];
}

/// Solids carry the fluid's pressure in the pores (undrained) or, drained or dry, as isotropic stress of the skeleton.
template <int Dim>
void set_solid(double density, const StressAt& at, Body<Dim>& body, std::size_t p) {
  body.mass[p] = density * body.J[p];
  body.J[p] = 1;
  const bool pores = !body.pore_pressure.empty();
  const double carried = pores ? 0.0 : at.fluid_pressure;
  for (int c = 0; c < 3; ++c) body.stress[c][p] = at.horizontal - carried;
  body.stress[Dim - 1][p] = at.vertical - carried;
  if (pores) body.pore_pressure[p] = at.fluid_pressure;
}

}  // namespace

double still_fluid_pressure(const Scene& scene, const HydrostaticSpec& still, double y) {
  const NewtonianSpec& fluid = fluid_of(scene, still.fluid);
  return still_pressure({fluid.density, fluid.bulk_modulus, fluid.viscosity}, -scene.gravity[scene.dimension - 1],
                        still.surface - y);
}

template <int Dim>
void set_initial_stress(const Scene& scene, const BodySpec& spec, Body<Dim>& body) {
  const double density = reference_density(body.material);
  for (std::size_t p = 0; p < body.size(); ++p) {
    const StressAt at = stress_at(scene, spec.initial_stress, density, body.x[Dim - 1][p]);
    if (const auto* water = std::get_if<Newtonian>(&body.material))
      set_fluid(*water, at, body, p);
    else
      set_solid(density, at, body, p);
  }
}

template void set_initial_stress<2>(const Scene&, const BodySpec&, Body<2>&);
template void set_initial_stress<3>(const Scene&, const BodySpec&, Body<3>&);

}  // namespace geodrop
