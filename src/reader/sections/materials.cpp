// Materials.
#include "sections.hpp"

#include <geodrop/materials/materials.hpp>

namespace geodrop {
namespace {

constexpr Range poisson{"> -1 and < 0.5", [](double x) { return x > -1 && x < 0.5; }};
constexpr Range angle{">= 0 and <= 89", [](double x) { return x >= 0 && x <= 89; }};
constexpr Range share_of_water{"> 0 and <= 1", [](double x) { return x > 0 && x <= 1; }};
constexpr Range suction_range{">= 0; inf: any tension", [](double x) { return x >= 0; }, true};

/// What follows from the content of the pores: the density of the mixture, and the stiffness of what fills them.
void derive_mixture(MaterialSpec& material, const toml::table& written) {
  auto* soil = std::get_if<MohrCoulombSpec>(&material.model);
  if (!soil) return;
  const auto value = [&](const char* name) { return written.contains(name) ? to_number(*written.get(name)) : 0.0; };
  if (written.contains("grain_density"))  // without a saturation, of a coupled soil, the skeleton alone
    soil->density =
        mixture_density({value("grain_density"), value("porosity"), value("saturation"), value("fluid_density")});
  if (soil->critical_state) soil->critical_state->porosity = value("porosity");
  if (auto* coupled = std::get_if<CoupledSpec>(&soil->pores); coupled && written.contains("saturation")) {
    coupled->saturation = value("saturation");
    coupled->gas = {0, value("gas_pressure"), value("atmospheric_pressure")};
  }
  auto* undrained = std::get_if<UndrainedSpec>(&soil->pores);
  if (!undrained || !written.contains("saturation")) return;
  undrained->saturation = value("saturation");
  if (written.contains("atmospheric_pressure"))
    undrained->gas = PoreGasSpec{value("water_bulk_modulus"), value("gas_pressure"), value("atmospheric_pressure")};
  undrained->fluid_bulk_modulus =
      pore_fluid_bulk_modulus({value("saturation"), value("water_bulk_modulus"), value("gas_pressure")});
}

}  // namespace

// clang-format off
SectionOf<MaterialSpec> materials_section() {
  constexpr RowsOf<MaterialSpec, &MaterialSpec::model> key;
  return {
      "[materials.NAME]", "",
      "One table for each material; NAME is what bodies refer to.",
      R"([materials.slurry]
model = "newtonian"
density = 1200.0
sound_speed = 60.0  # about ten times the fastest motion
viscosity = 1.0

[materials.dredged_sand]
model = "mohr_coulomb"
grain_density = 2650.0
porosity = 0.4
saturation = 1.0
fluid_density = 1000.0
youngs_modulus = 5.0e6
poissons_ratio = 0.3
cohesion = 0.0
friction_angle_deg = 32.0
dilatancy_angle_deg = 0.0
tension_cutoff = 0.0
void_memory = true  # torn apart in the fall, closed again on the bed
drainage = "undrained"
water_bulk_modulus = 40.0e6  # reduced: 20 times the skeleton's is enough
gas_pressure = 1.0e5)", {
      key("model", &MaterialSpec::model, {{"newtonian", NewtonianSpec{}}, {"linear_elastic", LinearElasticSpec{}}, {"mohr_coulomb", MohrCoulombSpec{}}, {"neo_hookean", NeoHookeanSpec{}}}, required, "constitutive law"),
      key("density", Either(&NewtonianSpec::density, &LinearElasticSpec::density, &NeoHookeanSpec::density), "kg/m3", required, positive, "of a fluid: at zero pressure; neo_hookean: unstrained").only("model=newtonian|linear_elastic|neo_hookean"),
      key("density", &MohrCoulombSpec::density, "kg/m3", instead_of("grain_density"), positive, "of the mixture of grains and what fills the pores, at the start; coupled: of the skeleton alone, (1 - n) rho_s").only("model=mohr_coulomb"),
      key.given("grain_density", "kg/m3", instead_of("density"), positive, "rho_s of the grains: the mixture has (1 - n) rho_s + n S rho_f, a coupled skeleton (1 - n) rho_s").only("model=mohr_coulomb"),
      key("bulk_modulus", &NewtonianSpec::bulk_modulus, "Pa", instead_of("sound_speed"), positive, "K in p = K (rho / rho0 - 1)").only("model=newtonian"),
      key("sound_speed", [](NewtonianSpec& fluid, double c) { fluid.bulk_modulus = fluid.density * c * c; }, "m/s", instead_of("bulk_modulus"), positive, "c, gives K = rho0 c^2; may be reduced where its error is known").only("model=newtonian"),
      key("viscosity", &NewtonianSpec::viscosity, "Pa s", required, not_negative, "dynamic viscosity").only("model=newtonian"),
      key("mixing_length", &NewtonianSpec::mixing_length, "m", standard("0.0"), not_negative, "l of eddies that the grid does not resolve: they add rho l^2 sqrt(2 D:D) to the viscosity; 0: none. A length of the flow, not of the grid").only("model=newtonian"),
      key("still_level", [](NewtonianSpec& fluid, double y) { fluid.still_level = y; }, "m", derived("nothing: the fluid is denser below, by rho g z / K"), any, "height y0 of its surface at rest: p = K (rho / rho0 - 1) + rho0 g (y0 - y), so that still water has its density at every depth, however its stiffness is reduced. With c = 60 m/s water 10 m deep is 2.7 % too heavy else, and sand in it too light by 4 %. Gravity straight down; not for the water in pores, bodies with pressure = \"enclosed\" or \"nodal\", pumps and exact solutions").only("model=newtonian"),
      key("tension_cutoff", &NewtonianSpec::tension_cutoff, "Pa", standard("inf"), suction_range, "largest suction that the fluid bears, p >= -tension_cutoff: beyond it voids open, which close again without a loss of volume; inf: it is never torn. Not for bodies with pressure = \"enclosed\", beside an absorbing layer or, outside of pores, a sharp interface").only("model=newtonian"),
      key("youngs_modulus", Either(&LinearElasticSpec::youngs_modulus, &MohrCoulombSpec::youngs_modulus, &NeoHookeanSpec::youngs_modulus), "Pa", required, positive, "Young's modulus (of the skeleton; neo_hookean: at small strain)").only("model=linear_elastic|mohr_coulomb|neo_hookean"),
      key("poissons_ratio", Either(&LinearElasticSpec::poissons_ratio, &MohrCoulombSpec::poissons_ratio, &NeoHookeanSpec::poissons_ratio), "", required, poisson, "Poisson's ratio (of the skeleton)").only("model=linear_elastic|mohr_coulomb|neo_hookean"),
      key("cohesion", &MohrCoulombSpec::cohesion, "Pa", required, not_negative, "c").only("model=mohr_coulomb"),
      key("friction_angle_deg", &MohrCoulombSpec::friction_angle_deg, "degree", required, angle, "phi; with critical_porosity that of the critical state").only("model=mohr_coulomb"),
      key("dilatancy_angle_deg", &MohrCoulombSpec::dilatancy_angle_deg, "degree", instead_of("critical_porosity"), angle, "psi, at most phi").only("model=mohr_coulomb"),
      key("tension_cutoff", &MohrCoulombSpec::tension_cutoff, "Pa", required, not_negative, "largest principal effective stress, at most c cot(phi)").only("model=mohr_coulomb"),
      key("void_memory", &MohrCoulombSpec::void_memory, standard("false"), "the volume by which the soil opens at the apex or the tension cut-off is kept, and closes again without stress; to be used where soil is torn apart and falls together again (any bag that falls and lands), or it grows; with dilatancy_angle_deg = 0 only").only("model=mohr_coulomb"),
      key("drainage", &MohrCoulombSpec::pores, {{"drained", std::monostate{}}, {"undrained", UndrainedSpec{}}, {"coupled", CoupledSpec{}}}, required, "undrained: pore water moves with the skeleton; drained: there is none, so that under water the pressure of the water is part of the effective stress (`geodrop check` names such bodies and says by how much); coupled: pore water is a body of a fluid that flows through the skeleton (`saturated_by` of the body)").only("model=mohr_coulomb"),
      key("porosity", [](MohrCoulombSpec& soil, double n) { std::get<UndrainedSpec>(soil.pores).porosity = n; }, "", required, fraction, "n").only("drainage=undrained"),
      key("porosity", [](MohrCoulombSpec& soil, double n) { std::get<CoupledSpec>(soil.pores).porosity = n; }, "", required, fraction, "n at the start; 1 - n = (1 - n0) / J goes with the skeleton").only("drainage=coupled"),
      key("hydraulic_conductivity", [](MohrCoulombSpec& soil, double k) { std::get<CoupledSpec>(soil.pores).hydraulic_conductivity = k; }, "m/s", required, positive, "k of Darcy's law at the porosity of the start").only("drainage=coupled"),
      key("permeability_law", [](MohrCoulombSpec& soil, CoupledSpec::Permeability law) { std::get<CoupledSpec>(soil.pores).permeability = law; }, {{"kozeny_carman", CoupledSpec::Permeability::kozeny_carman}, {"constant", CoupledSpec::Permeability::constant}}, standard("\"kozeny_carman\""), "how k follows the porosity: as n^3 / (1 - n)^2, or not at all").only("drainage=coupled"),
      key("forchheimer_coefficient", [](MohrCoulombSpec& soil, double b) { std::get<CoupledSpec>(soil.pores).forchheimer_coefficient = b; }, "s2/m2", standard("0.0"), not_negative, "b in i = q / k + b q^2 at the porosity of the start, for fast flow through coarse soil; Ergun (1952): 1.75 (1 - n) / (g n^3 d); it follows the porosity as (1 - n) / n^3, unless permeability_law = \"constant\"; 0: Darcy's law. Not in a sharp membrane").only("drainage=coupled"),
      key.given("porosity", "", required, fraction, "n, for the density of the mixture").only("grain_density&drainage=drained"),
      key.given("saturation", "", required, share, "S, share of the pores that water fills (0: dry); the rest is gas").only("grain_density&drainage=drained|undrained"),
      key.given("saturation", "", instead_of("fluid_bulk_modulus"), share, "S, share of the pores that water fills; the rest is gas. The density is as given").only("density&drainage=undrained"),
      key.given("saturation", "", derived("nothing: no gas"), share_of_water, "S, share of the pores that water fills where the gas has gas_pressure; the rest is gas, in the body of the pore water, which follows Boyle's law. It has no weight and moves with the water; what flows in through a geotextile brings none").only("drainage=coupled"),
      key.given("fluid_density", "kg/m3", required, positive, "rho_f of the water in the pores").only("grain_density&drainage=drained|undrained"),
      key("fluid_bulk_modulus", [](MohrCoulombSpec& soil, double modulus) { std::get<UndrainedSpec>(soil.pores).fluid_bulk_modulus = modulus; }, "Pa", instead_of("saturation"), positive, "K_f of the pore fluid; K_f / n is at least 20 times the bulk modulus of the skeleton").only("density&drainage=undrained"),
      key("critical_porosity", [](MohrCoulombSpec& soil, double n) { soil.critical_state.emplace().critical_porosity = n; }, "", instead_of("dilatancy_angle_deg"), fraction, "n_c, at which the soil is sheared without a change of volume: tan(psi) = dilatancy_slope (n_c - n), tan(phi) = tan(friction_angle) + tan(psi) >= 0 (Roux & Radjai 1998; Pailha & Pouliquen 2009), 1 - n = (1 - n0) / J; loose soil contracts and raises the pressure of the water in its pores, dense soil dilates and lowers it; not with void_memory").only("drainage=drained|coupled"),
      key("dilatancy_slope", [](MohrCoulombSpec& soil, double slope) { soil.critical_state->dilatancy_slope = slope; }, "", required, positive, "K of critical_porosity; 4.09 for glass beads (Pailha & Pouliquen 2009)").only("critical_porosity"),
      key.given("porosity", "", required, fraction, "n at the start, for critical_porosity").only("critical_porosity&density&drainage=drained"),
      key.given("water_bulk_modulus", "Pa", required, positive, "K_w of the water in the pores: 1 / K_f = S / K_w + (1 - S) / gas_pressure (Verruijt 1969)").only("saturation&drainage=undrained"),
      key.given("gas_pressure", "Pa", required, positive, "absolute pressure at which the gas has its share of the pores; K_f is that of small changes around it (isothermal, nothing dissolves) and stays, unless an atmospheric_pressure is given").only("saturation&drainage=undrained"),
      key.given("gas_pressure", "Pa", required, positive, "absolute pressure at which the gas has its share of the pores").only("saturation&drainage=coupled"),
      key.given("atmospheric_pressure", "Pa", required, positive, "absolute pressure where the pore pressure is 0").only("saturation&drainage=coupled"),
      key.given("atmospheric_pressure", "Pa", derived("nothing: K_f stays"), positive, "absolute pressure where the pore pressure is 0: the gas follows Boyle's law, half as much at twice the absolute pressure; not with void_memory, S > 0").only("saturation&drainage=undrained"),
  }, derive_mixture};
}
// clang-format on

}  // namespace geodrop
