// Checks of materials: likely units, limits of plasticity, the stiffness of pore water.
#include "check_scene.hpp"

#include <cmath>
#include <numbers>

namespace geodrop {
namespace {

/// Skempton's B = s / (s + 1) of 0.95; a softer pore fluid would not be undrained any more, unless it has gas in it.
constexpr double kLeastPoreStiffness = 20;  // of the skeleton's bulk modulus
constexpr double kRoundOff = 1e-9;

double cot_deg(double angle_deg) { return 1 / std::tan(angle_deg * std::numbers::pi / 180); }

/// A soil looser than any packing has no friction; and softening that is faster than elastic unloading has no return:
/// plastic flow keeps its direction where 1 + (1 + lambda / G) sin(phi) sin(psi) > 0. The least value of the product is
/// that of tan(psi) = -tan(phi_c) / 2; half of the limit keeps the edges of the yield surface away from it, too.
void check_critical_state(const MohrCoulombSpec& soil, const std::string& key, Report& report) {
  if (!soil.critical_state || !report.healthy(key)) return;
  const CriticalStateSpec& state = *soil.critical_state;
  const double tangent = 1 / cot_deg(soil.friction_angle_deg);
  const double loosest = state.critical_porosity + tangent / state.dilatancy_slope;
  if (soil.void_memory)
    report.add(key + ".void_memory", "true with critical_porosity",
               "false: what opens there closes again by contraction");
  if (state.porosity >= loosest)
    report.add(key + ".porosity", to_text(state.porosity) + ", which leaves no friction",
               "less than critical_porosity + tan(friction angle) / dilatancy_slope = " + to_text(loosest));
  const double nu = soil.poissons_ratio, most = 1 / (2 + tangent * tangent);
  if (nu > most)
    report.add(key + ".poissons_ratio", to_text(nu), "at most " + to_text(most) + " for soil that contracts");
}

void check_pore_gas(const MohrCoulombSpec& soil, const std::string& key, Report& report) {
  const UndrainedSpec* const pores = soil.undrained();
  if (!pores || !pores->gas || !report.healthy(key)) return;
  if (soil.void_memory) report.add(key + ".void_memory", "true with atmospheric_pressure", "false, or K_f that stays");
  if (*pores->saturation == 0)
    report.add(key + ".saturation", "0 with atmospheric_pressure", "more than 0: some water in the pores");
}

void check_plasticity(const MohrCoulombSpec& soil, const std::string& key, Report& report) {
  const bool angles = report.healthy(key + ".friction_angle_deg") && report.healthy(key + ".dilatancy_angle_deg");
  if (angles && soil.dilatancy_angle_deg > soil.friction_angle_deg) {
    report.add(key + ".dilatancy_angle_deg", to_text(soil.dilatancy_angle_deg),
               "at most friction_angle_deg = " + to_text(soil.friction_angle_deg) + " [degree]");
  }
  if (angles && soil.void_memory && soil.dilatancy_angle_deg > 0) {
    report.add(key + ".void_memory", "true with dilatancy_angle_deg = " + to_text(soil.dilatancy_angle_deg),
               "true with dilatancy_angle_deg = 0, where all plastic volume is that of voids, or false");
  }
  const bool cutoff = report.healthy(key + ".tension_cutoff") && report.healthy(key + ".cohesion") &&
                      report.healthy(key + ".friction_angle_deg");
  if (!cutoff || soil.friction_angle_deg <= 0) return;
  const double apex = soil.cohesion * cot_deg(soil.friction_angle_deg);
  if (soil.tension_cutoff > apex * (1 + kRoundOff)) {
    report.add(key + ".tension_cutoff", to_text(soil.tension_cutoff),
               "at most cohesion cot(friction angle) = " + to_text(apex) + " [Pa]");
  }
}

/// Catches a modulus in MPa or GPa, or a density in g/cm3: the sound speed is then off by a factor of 30 or more.
void check_wave_speed(double modulus, double density, const std::string& key, const std::string& modulus_name,
                      Report& report) {
  constexpr double kSlowest = 1, kFastest = 1e4;  // [m/s]
  const double speed = std::sqrt(modulus / density);
  if (speed >= kSlowest && speed <= kFastest) return;
  report.add(key + modulus_name, "a sound speed of " + to_text(speed) + " m/s",
             "a modulus in Pa and a density in kg/m3 that give a sound speed from 1 to 10000 m/s");
}

void check_units(const MaterialSpec& material, const std::string& key, Report& report) {
  if (!report.healthy(key)) return;
  if (const auto* fluid = std::get_if<NewtonianSpec>(&material.model)) {
    check_wave_speed(fluid->bulk_modulus, fluid->density, key, "", report);
    return;
  }
  const auto check_solid = [&](const auto& solid) {
    const double nu = solid.poissons_ratio;
    const double compression = solid.youngs_modulus * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
    check_wave_speed(compression, solid.density, key, ".youngs_modulus", report);
  };
  if (const auto* solid = std::get_if<LinearElasticSpec>(&material.model)) check_solid(*solid);
  if (const auto* soil = std::get_if<MohrCoulombSpec>(&material.model)) check_solid(*soil);
  if (const auto* rubber = std::get_if<NeoHookeanSpec>(&material.model)) check_solid(*rubber);
}

void check_pore_fluid(const MohrCoulombSpec& soil, const std::string& key, Report& report) {
  const UndrainedSpec* const pores = soil.undrained();
  if (!pores || pores->saturation) return;
  for (const char* name : {".porosity", ".fluid_bulk_modulus", ".youngs_modulus", ".poissons_ratio"}) {
    if (!report.healthy(key + name)) return;
  }
  const double skeleton = soil.youngs_modulus / (3 * (1 - 2 * soil.poissons_ratio));
  const double least = kLeastPoreStiffness * skeleton * pores->porosity;
  if (pores->fluid_bulk_modulus >= least * (1 - kRoundOff)) return;
  const double stiffness = pores->fluid_bulk_modulus / pores->porosity;
  report.add(
      key + ".fluid_bulk_modulus",
      to_text(pores->fluid_bulk_modulus) + " (Skempton's B = " + to_text(stiffness / (stiffness + skeleton)) + ")",
      "at least " + to_text(least) +
          " [Pa], so that K_f / n is 20 times the bulk modulus of the skeleton and B at least 0.95");
}

}  // namespace

void check_materials(const Scene& scene, Report& report) {
  for (const MaterialSpec& material : scene.materials) {
    check_units(material, "materials." + material.name, report);
    const auto* soil = std::get_if<MohrCoulombSpec>(&material.model);
    if (!soil) continue;
    check_plasticity(*soil, "materials." + material.name, report);
    check_pore_gas(*soil, "materials." + material.name, report);
    check_critical_state(*soil, "materials." + material.name, report);
    check_pore_fluid(*soil, "materials." + material.name, report);
  }
}

}  // namespace geodrop
