// From what the user wrote to the constants of the laws, and the numbers that the time step needs of them.
#include <geodrop/materials/materials.hpp>

#include <algorithm>
#include <cmath>

#include "laws.hpp"

namespace geodrop {
namespace {

/// With gas the largest at any pressure, rho0 c^2 <= K + g p_a (Cauchy and Schwarz).
ElasticModuli elastic_moduli(const Newtonian& fluid) { return {fluid.bulk_modulus + fluid.gas * fluid.atmosphere, 0}; }
ElasticModuli elastic_moduli(const NeoHookean& solid) {
  return {solid.lame_lambda + 2.0 / 3.0 * solid.shear_modulus, solid.shear_modulus};
}
/// Of a skeleton, and of the water in its pores.
template <class Solid>
ElasticModuli elastic_moduli(const Solid& solid) {
  double bulk = solid.bulk_modulus;
  if constexpr (requires { solid.pore_stiffness; }) bulk += solid.pore_stiffness;
  return {bulk, solid.shear_modulus};
}

/// The larger root of J/K p^2 + b p + p_a (J - 1 - g) = 0, as of fluid_pressure; the other is below -p_a.
double pressure_with_gas(const Newtonian& fluid, double J, double gas) {
  const double K = fluid.bulk_modulus, atmosphere = fluid.atmosphere;
  const double a = J / K, b = J - 1 + (J - gas) * atmosphere / K, c = atmosphere * (J - 1 - gas);
  const double root = std::sqrt(b * b - 4 * a * c);
  return b > 0 ? -2 * c / (b + root) : (root - b) / (2 * a);  // the other form would cancel
}

}  // namespace

Material make_material(const MaterialSpec& spec) {
  const auto* soil = std::get_if<MohrCoulombSpec>(&spec.model);
  if (soil && soil->void_memory) return MohrCoulombWithVoids{make(*soil)};
  if (soil && soil->undrained() && soil->undrained()->gas)
    return make(*soil, *soil->undrained(), *soil->undrained()->gas);
  if (soil && soil->critical_state) return make(*soil, *soil->critical_state);
  return std::visit([](const auto& model) -> Material { return make(model); }, spec.model);
}

Material blank_law(std::size_t index) {
  return []<class... Law>(std::type_identity<std::variant<Law...>>, std::size_t number) {
    return std::array<Material, sizeof...(Law)>{Law{}...}[number];
  }(std::type_identity<Material>{}, index);
}

const MohrCoulomb* soil_law(const Material& material) {
  const auto as_soil = []<class Law>(const Law& law) -> const MohrCoulomb* {
    if constexpr (std::is_base_of_v<MohrCoulomb, Law>) return &law;
    return nullptr;
  };
  return std::visit(as_soil, material);
}

double reference_density(const Material& material) {
  return std::visit([](const auto& law) { return law.density; }, material);
}

ElasticModuli elastic_moduli(const Material& material) {
  return std::visit([](const auto& law) { return elastic_moduli(law); }, material);
}

double ElasticModuli::of_waves() const { return bulk + 4.0 / 3.0 * shear; }

double wave_modulus(const Material& material) { return elastic_moduli(material).of_waves(); }

double wave_speed(const Material& material) { return std::sqrt(wave_modulus(material) / reference_density(material)); }

double pore_stiffness(const Material& material) {
  const MohrCoulomb* const soil = soil_law(material);
  return soil ? soil->pore_stiffness : 0;
}

double implicit_modulus(const Material& material) {
  const auto* const water = std::get_if<Newtonian>(&material);
  return water ? elastic_moduli(*water).bulk : pore_stiffness(material);
}

double impedance(const Material& material) { return reference_density(material) * wave_speed(material); }

double shear_wave_speed(const Material& material) {
  return std::sqrt(elastic_moduli(material).shear / reference_density(material));
}

double fluid_pressure(const Newtonian& fluid, double J, double gas, double of_weight) {
  const double whole = gas > 0 ? pressure_with_gas(fluid, J, gas) : fluid.bulk_modulus * (1 / J - 1) + of_weight;
  return std::max(whole, -fluid.tension_cutoff);
}

double fluid_stiffness(const Newtonian& fluid, double pressure, double gas) {
  const double K = fluid.bulk_modulus, of_water = fluid_volume_ratio(fluid, pressure),
               absolute = fluid.atmosphere + pressure;
  const double of_gas = gas * fluid.atmosphere / absolute;
  return (of_water + of_gas) / (of_water * of_water / K + of_gas / absolute);
}

double fluid_energy(const Newtonian& fluid, double J, double gas, double of_weight) {
  if (gas > 0) {
    const double p = fluid_pressure(fluid, J, gas), share = fluid.atmosphere / (fluid.atmosphere + p);
    const double of_gas = gas * fluid.atmosphere * (share - 1 - std::log(share));
    return fluid_energy(fluid, fluid_volume_ratio(fluid, p)) + of_gas;
  }
  const double torn = fluid.cavitates() ? fluid_volume_ratio(fluid, -fluid.tension_cutoff - of_weight) : J;
  const double elastic = std::min(J, torn);
  const double stored = fluid.bulk_modulus * ((elastic - 1) - std::log1p(elastic - 1)) - of_weight * (elastic - 1);
  return J > torn ? stored + fluid.tension_cutoff * (J - torn) : stored;
}

double kinematic_viscosity(const Material& material) {
  const auto* fluid = std::get_if<Newtonian>(&material);
  return fluid ? fluid->viscosity / fluid->density : 0.0;
}

double pore_fluid_bulk_modulus(const PoreFluid& fluid) {
  return 1 / (fluid.saturation / fluid.water_bulk_modulus + (1 - fluid.saturation) / fluid.gas_pressure);
}

double mixture_density(const GrainsAndWater& soil) {
  return (1 - soil.porosity) * soil.grain_density + soil.porosity * soil.saturation * soil.fluid_density;
}

double skempton_b(const MohrCoulomb& soil) { return soil.pore_stiffness / (soil.pore_stiffness + soil.bulk_modulus); }

double still_pressure(const Newtonian& fluid, double gravity, double depth) {
  if (depth <= 0) return 0;
  if (fluid.has_still_level()) return fluid.density * gravity * depth;
  return fluid.bulk_modulus * std::expm1(fluid.density * gravity * depth / fluid.bulk_modulus);
}

}  // namespace geodrop
