#include "initial_stress.hpp"

#include <algorithm>
#include <cmath>
#include <geodrop/grid/grid.hpp>
#include <geodrop/solutions/exact.hpp>
#include <stdexcept>

#include "grid/neighbourhood.hpp"
#include "materials/laws.hpp"
#include "scene/needs.hpp"

namespace geodrop {
namespace {

const NewtonianSpec& fluid_of(const Scene& scene, const std::string& name) {
  if (const MaterialSpec* fluid = find_material(scene, name)) return std::get<NewtonianSpec>(fluid->model);
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
    out.vertical = out.horizontal = -bag->effective_pressure;
  } else if (const auto* uniform = std::get_if<UniformPressureSpec>(&initial)) {
    out.vertical = out.horizontal = -uniform->pressure;
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
  body.J[p] = fluid_volume_ratio(water, at.fluid_pressure);
  body.mass[p] = water.density * volume / body.J[p];
}

/// Solids carry the fluid's pressure in the pores (undrained), not at all (coupled: the fluid itself does) or, drained
/// or dry, as isotropic stress of the skeleton.
template <int Dim>
void set_solid(double density, const StressAt& at, Body<Dim>& body, std::size_t p, bool coupled = false) {
  body.mass[p] = density * body.J[p];
  body.J[p] = 1;
  const bool pores = !body.pore_pressure.empty();
  const double carried = pores || coupled ? 0.0 : at.fluid_pressure;
  for (int c = 0; c < 3; ++c) body.stress[c][p] = at.horizontal - carried;
  body.stress[Dim - 1][p] = at.vertical - carried;
  if (pores) body.pore_pressure[p] = at.fluid_pressure;
}

/// sigma of uniform stretches along the axes, from zero strain: logarithmic for the hypoelastic law.
template <int Dim>
void stretch_solid(const UniformMotion<Dim>& motion, Body<Dim>& body, std::size_t p) {
  const double J = motion.stretch.prod();
  body.mass[p] = reference_density(body.material) * body.J[p] / J;
  body.J[p] = J;
  std::array<double, stress_components<Dim>> stress{};
  if (const auto* rubber = std::get_if<NeoHookean>(&body.material)) {
    std::array<double, Dim * Dim> F{};
    for (int a = 0; a < Dim; ++a) F[a * Dim + a] = body.deformation[a * Dim + a][p] = motion.stretch[a];
    stress = neo_hookean_stress<Dim, double>(*rubber, F, J);
  } else {
    std::array<double, Dim * Dim> strain{};
    for (int a = 0; a < Dim; ++a) strain[a * Dim + a] = std::log(motion.stretch[a]);
    update_stress<Dim, double>(std::get<LinearElastic>(body.material), strain, std::log(J), stress);
  }
  for (int c = 0; c < stress_components<Dim>; ++c) body.stress[c][p] = stress[c];
}

template <int Dim>
void set_exact_stress(const ExactSolution<Dim>& solution, Body<Dim>& body) {
  for (std::size_t p = 0; p < body.size(); ++p) {
    if (const auto* flow = std::get_if<TaylorGreen>(&solution))
      set_fluid(std::get<Newtonian>(body.material), {0, 0, pressure<Dim>(*flow, vector_at(body.x, p), 0)}, body, p);
    else if (const auto* drop = std::get_if<OscillatingDrop>(&solution))
      set_fluid(std::get<Newtonian>(body.material), {0, 0, pressure<Dim>(*drop, vector_at(body.x, p), 0)}, body, p);
    else if (const auto* pair = std::get_if<LambDipole>(&solution))
      set_fluid(std::get<Newtonian>(body.material), {0, 0, pressure<Dim>(*pair, vector_at(body.x, p), 0)}, body, p);
    else if (const auto* motion = std::get_if<UniformMotion<Dim>>(&solution))
      stretch_solid(*motion, body, p);
    else
      set_solid(reference_density(body.material), {}, body, p);  // those that swing begin unstrained
  }
}

/// Middle of the cell of each particle less the mean height of the body's particles in it [m]: 0 in a full cell.
template <int Dim>
Array<double> middles_over_means(const GridLayout<Dim>& layout, const Body<Dim>& body) {
  const Array<double>& y = body.x[vertical_axis<Dim>];
  const auto cell_of = [&](std::size_t p) { return cell_at(layout, body.x, p); };
  Array<double> sum(layout.nodes()), count(layout.nodes()), over(body.size());
  for (std::size_t p = 0; p < body.size(); ++p) {
    sum[cell_of(p)] += y[p];
    ++count[cell_of(p)];
  }
  for (std::size_t p = 0; p < body.size(); ++p) {
    const int row = layout.base(vertical_axis<Dim>, y[p]) + GridLayout<Dim>::pad;
    over[p] = layout.middle_of_row[row] - sum[cell_of(p)] / count[cell_of(p)];
  }
  return over;
}

/// Mass of the water in the pores of a coupled soil per volume of soil [kg/m3]; else 0.
double water_in_pores(const Scene& scene, const BodySpec& spec) {
  const BodySpec* water = find_body(scene, spec.saturated_by);
  if (!water) return 0;
  return pores_of(scene, spec)->porosity * fluid_of(scene, water->material).density;
}

}  // namespace

double still_fluid_pressure(const Scene& scene, const HydrostaticSpec& still, double y) {
  const NewtonianSpec& fluid = fluid_of(scene, still.fluid);
  return still_pressure(make(fluid), -scene.gravity[scene.dimension - 1], still.surface - y);
}

TotalStress initial_total_stress(const Scene& scene, const BodySpec& spec, double y) {
  const double density =
      reference_density(make_material(*find_material(scene, spec.material))) + water_in_pores(scene, spec);
  const StressAt at = stress_at(scene, spec.initial_stress, density, y);
  return {at.vertical - at.fluid_pressure, at.horizontal - at.fluid_pressure};
}

template <int Dim>
void set_unstrained(Body<Dim>& body) {
  const auto begin_at_zero = [&](auto& field) {
    for_each_component(field, [&](Array<double>& values) { values.assign(body.J.size(), 0.0); });
  };
  std::visit([&](const auto& law) { law.state(body, begin_at_zero); }, body.material);
  for (int a = 0; a < Dim; ++a) std::ranges::fill(body.deformation[a * Dim + a], 1.0);
}

template <int Dim>
void set_initial_stress(const Scene& scene, const BodySpec& spec, Body<Dim>& body) {
  if (std::holds_alternative<FromExactSpec>(spec.initial_stress))
    return set_exact_stress(exact_solution<Dim>(scene, spec.name), body);
  const double density = reference_density(body.material), pore_water = water_in_pores(scene, spec);
  // The pressure of a cell has its weight at its middle: where it is full in part it begins with that of its particles.
  const auto* water = std::get_if<Newtonian>(&body.material);
  const bool level = water && water->has_still_level();
  const Array<double> over =
      level ? middles_over_means(GridLayout<Dim>(scene.grid, scene.walls), body) : Array<double>(body.size());
  for (std::size_t p = 0; p < body.size(); ++p) {
    const double y = body.x[Dim - 1][p];
    StressAt at = stress_at(scene, spec.initial_stress, density + pore_water, y);
    if (water) {
      at.fluid_pressure -= at.vertical;
      at.fluid_pressure -= water->of_weight(y + over[p]);  // the density follows the rest
      set_fluid(*water, at, body, p);
    } else {
      set_solid(density, at, body, p, pore_water > 0);
    }
  }
}

template void set_unstrained(Body<2>&);
template void set_unstrained(Body<3>&);
template void set_initial_stress<2>(const Scene&, const BodySpec&, Body<2>&);
template void set_initial_stress<3>(const Scene&, const BodySpec&, Body<3>&);

}  // namespace geodrop
