#include "pore_soils.hpp"

#include <geodrop/geometry/shapes.hpp>
#include <geodrop/scene/velocity_fields.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/needs.hpp"

namespace geodrop {

double PoreSoil::resistance(double n) const {
  if (law == CoupledSpec::Permeability::constant) return water_unit_weight / conductivity;
  return water_unit_weight / (conductivity * kozeny(n) / kozeny_at_start);
}

double PoreSoil::inertial_resistance(double n) const {
  if (law == CoupledSpec::Permeability::constant) return water_unit_weight * forchheimer;
  return water_unit_weight * forchheimer * (ergun(n) / ergun_at_start);
}

std::vector<PoreSoil> pore_soils(const Scene& scene) {
  const std::vector<int> fields = velocity_fields(scene);
  const auto number = [&](const BodySpec& body) { return static_cast<int>(&body - scene.bodies.data()); };
  std::vector<PoreSoil> soils;
  for (const BodySpec& body : scene.bodies) {
    if (body.saturated_by.empty()) continue;
    const auto& soil = std::get<MohrCoulombSpec>(find_material(scene, body.material)->model);
    const BodySpec& water = *find_body(scene, body.saturated_by);
    const CoupledSpec& pores = *soil.coupled();
    soils.push_back({number(body), fields[number(body)], fields[number(water)], soil.density / (1 - pores.porosity),
                     pores.porosity, pores.hydraulic_conductivity, pores.permeability, water_unit_weight(scene, water),
                     pores.forchheimer_coefficient});
  }
  return soils;
}

Consolidation consolidation(const Scene& scene, const PoreSoil& soil) {
  const BodySpec& body = scene.bodies[soil.body];
  const Material skeleton = make_material(*find_material(scene, body.material));
  Consolidation out;
  const double modulus = reference_density(skeleton) * std::pow(wave_speed(skeleton), 2);
  out.coefficient = soil.conductivity * modulus / soil.water_unit_weight;
  const Bounds box = bounds_within(body.shape, {scene.grid.lower, scene.grid.upper});
  out.path = std::numeric_limits<double>::infinity();
  for (int a = 0; a < scene.dimension; ++a) {
    const double near = scene.grid.spacing / 2;
    const int walls = (box.lower[a] < scene.grid.lower[a] + near) + (box.upper[a] > scene.grid.upper[a] - near);
    if (walls < 2) out.path = std::min(out.path, (box.upper[a] - box.lower[a]) / (2 - walls));
  }
  out.time_factor = out.coefficient * scene.time.end / std::pow(out.path, 2);
  return out;
}

std::map<std::size_t, PoreWaves> pore_waves(const Scene& scene) {
  std::map<std::size_t, PoreWaves> waves;
  for (const PoreSoil& soil : pore_soils(scene)) {
    const BodySpec& body = scene.bodies[soil.body];
    const BodySpec& filled_by = *find_body(scene, body.saturated_by);
    const Material water = law_of(scene, filled_by);
    const double n = soil.porosity;
    waves[soil.body] = {static_cast<std::size_t>(&filled_by - scene.bodies.data()),
                        wave_modulus(water) / n * ((1 - n) / soil.grain_density + n / reference_density(water))};
  }
  return waves;
}

}  // namespace geodrop
