// The bounds are wide: soils have 1000 to 2700 kg/m3, fluids 600 to 2000; geotextiles 50 kN/m to 20 MN/m of stiffness
// and 10 to 1600 kN/m of strength at 0.1 to 2 kg/m2 (Bezuijen & Vastenburg 2013); soils moduli of 0.5 MPa to 1 GPa.
#include "doubtful_units.hpp"

#include <algorithm>
#include <numbers>

#include "base/text.hpp"
#include "doubts.hpp"

namespace geodrop {
namespace {

constexpr double kilo = 1e3, gravity = 9.81;
constexpr int unit_digits = 4;

/// A number between these ends is doubtful: what it probably is in.
struct Suspect {
  double above, below;
  std::string unit;  ///< of what was probably meant
  double factor;     ///< to SI
};

std::string sentence(const std::string& key, double value, const std::string& unit, const Suspect& suspect) {
  return key + " = " + format_number(value, unit_digits) + " " + unit + " is unusual; in " + suspect.unit +
         " it would be " + format_number(value * suspect.factor, unit_digits) + " " + unit;
}

/// The first of the suspects that the value lies in; empty if none.
std::string look(const std::string& key, double value, const std::string& unit, const std::vector<Suspect>& suspects) {
  for (const Suspect& suspect : suspects)
    if (value > suspect.above && value < suspect.below) return sentence(key, value, unit, suspect);
  return {};
}

std::vector<std::string> material_doubts(const MaterialSpec& material) {
  const std::string at = "materials." + material.name + ".";
  std::vector<std::string> found;
  const auto soil_modulus = [&](double E) {
    found.push_back(look(at + "youngs_modulus", E, "Pa", {{0, 500, "MPa", 1e6}, {500, 1e5, "kPa", kilo}}));
    constexpr double stiffest_soil = 2e9;
    if (E > stiffest_soil)
      found.push_back(at + "youngs_modulus = " + format_number(E, unit_digits) +
                      " Pa is that of rock; soils have 0.5 MPa to 1 GPa");
  };
  if (const auto* soil = std::get_if<MohrCoulombSpec>(&material.model)) {
    found.push_back(doubt_density(at + "density", soil->density));
    soil_modulus(soil->youngs_modulus);
    found.push_back(look(at + "cohesion", soil->cohesion, "Pa", {{0, 100, "kPa", kilo}}));
    const double half_turn = 180;
    found.push_back(look(at + "friction_angle_deg", soil->friction_angle_deg, "degree",
                         {{0, 1.2, "radians", half_turn / std::numbers::pi}}));
    found.push_back(look(at + "dilatancy_angle_deg", soil->dilatancy_angle_deg, "degree",
                         {{0, 0.6, "radians", half_turn / std::numbers::pi}}));
  }
  if (const auto* fluid = std::get_if<NewtonianSpec>(&material.model)) {
    found.push_back(doubt_density(at + "density", fluid->density));
    constexpr double stiff_as_pitch = 1000;
    if (fluid->viscosity > stiff_as_pitch)
      found.push_back(at + "viscosity = " + format_number(fluid->viscosity, unit_digits) +
                      " Pa s is out of all scale: water has 1e-3, slurries up to 10 Pa s");
  }
  return found;
}

std::vector<std::string> membrane_doubts(const MembraneSpec& membrane) {
  const std::string at = "membranes." + membrane.name + ".";
  std::vector<std::string> found{
      doubt_stiffness(at + "axial_stiffness", membrane.axial_stiffness),
      doubt_strength(at + "strength", membrane.strength),
      look(at + "mass_per_area", membrane.mass_per_area, "kg/m2", {{30, 1e5, "g/m2", 1 / kilo}})};
  constexpr double most_slack = 0.2;
  if (membrane.slack > most_slack || membrane.slack < -most_slack)
    found.push_back(at + "slack = " + format_number(membrane.slack, unit_digits) + " is " +
                    format_number(100 * membrane.slack, unit_digits) +
                    " % of the drawn length; a share is asked for, 0.05 for 5 %");
  return found;
}

}  // namespace

std::string doubt_density(const std::string& name, double value) {
  return look(name, value, "kg/m3",
              {{0, 4, "t/m3", kilo}, {4, 40, "kN/m3", kilo / gravity}, {4000, 4e4, "N/m3", 1 / gravity}});
}

std::string doubt_stiffness(const std::string& name, double value) {
  return look(name, value, "N/m", {{0, 1e4, "kN/m", kilo}});
}

std::string doubt_strength(const std::string& name, double value) {
  return look(name, value, "N/m", {{0, 2e3, "kN/m", kilo}});
}

std::string doubt_unit_weight(const std::string& name, double value) {
  return look(name, value, "N/m3",
              {{0, 3, "t/m3", kilo * gravity}, {3, 100, "kN/m3", kilo}, {500, 3000, "kg/m3", gravity}});
}

std::vector<std::string> doubtful_units(const Scene& scene) {
  const bool weightless = std::ranges::all_of(scene.gravity, [](double g) { return g == 0; });
  if (weightless) return {};
  std::vector<std::string> found;
  double square = 0;
  for (const double g : scene.gravity) square += g * g;
  constexpr double far_more = 2;
  if (scene.gravity.back() > 0 || square > far_more * far_more * gravity * gravity)
    found.push_back("gravity = " + format_number(scene.gravity.back(), unit_digits) +
                    " m/s2 along the vertical; on earth it is -9.81");
  for (const MaterialSpec& material : scene.materials)
    for (std::string& each : material_doubts(material)) found.push_back(std::move(each));
  for (const MembraneSpec& membrane : scene.membranes)
    for (std::string& each : membrane_doubts(membrane)) found.push_back(std::move(each));
  std::erase(found, "");
  return found;
}

}  // namespace geodrop
