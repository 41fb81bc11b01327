// Checks of materials: limits of plasticity, and the stiffness of pore water.
#include <cmath>
#include <numbers>

#include "check_scene.hpp"

namespace geodrop {
namespace {

/// Skempton's B = s / (s + 1) of 0.95; a softer pore fluid would not be undrained any more.
constexpr double kLeastPoreStiffness = 20;  // of the skeleton's bulk modulus
constexpr double kRounding = 1e-9;

double cot_deg(double angle_deg) { return 1 / std::tan(angle_deg * std::numbers::pi / 180); }

void check_plasticity(const MohrCoulombSpec& soil, const std::string& key, Report& report) {
  const bool angles = report.healthy(key + ".friction_angle_deg") && report.healthy(key + ".dilatancy_angle_deg");
  if (angles && soil.dilatancy_angle_deg > soil.friction_angle_deg) {
    report.add(key + ".dilatancy_angle_deg", to_text(soil.dilatancy_angle_deg),
               "at most friction_angle_deg = " + to_text(soil.friction_angle_deg) + " [degree]");
  }
  const bool cutoff = report.healthy(key + ".tension_cutoff") && report.healthy(key + ".cohesion") &&
                      report.healthy(key + ".friction_angle_deg");
  if (!cutoff || soil.friction_angle_deg <= 0) return;
  const double apex = soil.cohesion * cot_deg(soil.friction_angle_deg);
  if (soil.tension_cutoff > apex * (1 + kRounding)) {
    report.add(key + ".tension_cutoff", to_text(soil.tension_cutoff),
               "at most cohesion cot(friction angle) = " + to_text(apex) + " [Pa]");
  }
}

void check_pore_fluid(const MohrCoulombSpec& soil, const std::string& key, Report& report) {
  if (!soil.undrained) return;
  for (const char* name : {".porosity", ".fluid_bulk_modulus", ".youngs_modulus", ".poissons_ratio"}) {
    if (!report.healthy(key + name)) return;
  }
  const double skeleton = soil.youngs_modulus / (3 * (1 - 2 * soil.poissons_ratio));
  const double least = kLeastPoreStiffness * skeleton * soil.undrained->porosity;
  if (soil.undrained->fluid_bulk_modulus >= least * (1 - kRounding)) return;
  const double stiffness = soil.undrained->fluid_bulk_modulus / soil.undrained->porosity;
  report.add(key + ".fluid_bulk_modulus",
             to_text(soil.undrained->fluid_bulk_modulus) +
                 " (Skempton's B = " + to_text(stiffness / (stiffness + skeleton)) + ")",
             "at least " + to_text(least) +
                 " [Pa], so that K_f / n is 20 times the bulk modulus of the skeleton and B at least 0.95");
}

}  // namespace

void check_materials(const Scene& scene, Report& report) {
  for (const MaterialSpec& material : scene.materials) {
    const auto* soil = std::get_if<MohrCoulombSpec>(&material.model);
    if (!soil) continue;
    check_plasticity(*soil, "materials." + material.name, report);
    check_pore_fluid(*soil, "materials." + material.name, report);
  }
}

}  // namespace geodrop
