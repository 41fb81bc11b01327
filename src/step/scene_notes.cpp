// What is no mistake in a scene, but what its results must not be believed without.
#include <geodrop/geometry/shapes.hpp>
#include <geodrop/step/run.hpp>

#include "pores/pore_soils.hpp"
#include "scene/needs.hpp"
#include "solutions/initial_stress.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace geodrop {
namespace {

/// The still fluid around a body at the start, if its stress, a still fluid or a body of fluid around it tells of one.
std::optional<HydrostaticSpec> fluid_around(const Scene& scene, const BodySpec& body) {
  if (const auto* still = std::get_if<HydrostaticSpec>(&body.initial_stress)) return *still;
  if (const auto* around = std::get_if<FluidPressureSpec>(&body.initial_stress)) return around->fluid;
  if (const auto* soil = std::get_if<K0StressSpec>(&body.initial_stress); soil && soil->fluid) return soil->fluid;
  for (const StillFluidSpec& still : scene.still_fluids)
    for (const MembraneSpec& membrane : scene.membranes)
      if (membrane.name == still.membrane && membrane.body == body.name)
        return HydrostaticSpec{still.fluid, still.surface};
  for (const BodySpec& other : scene.bodies) {
    const bool cut_out = std::find(other.minus.begin(), other.minus.end(), body.name) != other.minus.end();
    const auto* still = std::get_if<HydrostaticSpec>(&other.initial_stress);
    if (cut_out && still) return *still;
  }
  return std::nullopt;
}

/// A body of fluid that no membrane encloses, where soil may get; null if there is none.
const BodySpec* open_fluid(const Scene& scene) {
  for (const BodySpec& body : scene.bodies) {
    const bool enclosed = std::any_of(scene.membranes.begin(), scene.membranes.end(),
                                      [&](const MembraneSpec& membrane) { return membrane.body == body.name; });
    if (!enclosed && std::holds_alternative<NewtonianSpec>(find_material(scene, body.material)->model)) return &body;
  }
  return nullptr;
}

/// Drained soil under water has no pore water that would carry the water's pressure: its skeleton does.
std::string drained_under_water(const Scene& scene, const BodySpec& body) {
  const auto* soil = std::get_if<MohrCoulombSpec>(&find_material(scene, body.material)->model);
  if (!soil || soil->undrained() || soil->coupled()) return {};
  const std::optional<HydrostaticSpec> fluid = fluid_around(scene, body);
  const BodySpec* open = open_fluid(scene);
  const std::string drained =
      "body \"" + body.name + "\" is drained: without pore water its effective stress includes ";
  const double tangent = std::tan(soil->friction_angle_deg * std::numbers::pi / 180);
  if (!fluid && open)
    return drained + fmt::format(
                         "the pressure of \"{}\" wherever it gets into it; its shear strength is higher by "
                         "{:.3g} (tan phi) of that",
                         open->name, tangent);
  if (!fluid) return {};
  const Bounds box = bounds_within(body.shape, {scene.grid.lower, scene.grid.upper});
  const double lowest = still_fluid_pressure(scene, *fluid, box.lower.back()) / 1e3;
  const double highest = still_fluid_pressure(scene, *fluid, box.upper.back()) / 1e3;
  if (lowest <= 0) return {};
  return drained + fmt::format(
                       "the pressure of the \"{}\" around, {:.3g} kPa at its highest and {:.3g} kPa at its "
                       "lowest point at the start; its shear strength is higher by {:.3g} (tan phi) of that",
                       fluid->fluid, highest, lowest, tangent);
}

/// What floats or sinks in a fluid of reduced stiffness meets another density than the scene names: with c = 60 m/s
/// under 10 m of water 2.7 %, which is 4 % of the weight of sand in it.
std::string denser_below(const Scene& scene, const BodySpec& body) {
  constexpr double little = 0.01;
  const auto* fluid = std::get_if<NewtonianSpec>(&find_material(scene, body.material)->model);
  const auto* still = std::get_if<HydrostaticSpec>(&body.initial_stress);
  const auto is_sharp = [](const MembraneSpec& membrane) { return membrane.interface == Interface::sharp; };
  const bool around_bags = std::ranges::any_of(scene.membranes, is_sharp) && !in_sharp_membrane(scene, body.name);
  if (!fluid || !still || !around_bags || saturates(scene, body.name) || fluid->still_level) return {};
  const Bounds box = bounds_within(body.shape, {scene.grid.lower, scene.grid.upper});
  const double rise = still_fluid_pressure(scene, *still, box.lower.back()) / fluid->bulk_modulus;
  if (rise < little) return {};
  return fmt::format(
      "\"{}\" is {:.2g} % denser at its lowest point than its density says: what sinks in it is too light; with "
      "materials.{}.still_level = {} it has that density at every depth",
      body.name, 100 * rise, body.material, still->surface);
}

/// Soil inside a closed membrane that opens where the bag is shaken keeps that volume, and stretches the bag. It is no
/// default: a material may be that of soil outside, too, void memory is for soil without dilatancy only, and published
/// comparisons are without.
std::string soil_that_swells(const Scene& scene, const BodySpec& body) {
  const auto* soil = std::get_if<MohrCoulombSpec>(&find_material(scene, body.material)->model);
  if (!soil || soil->void_memory || soil->dilatancy_angle_deg != 0 || soil->critical_state) return {};
  for (const MembraneSpec& membrane : scene.membranes)
    if (membrane.body == body.name && membrane.closed && membrane.axial_stiffness > 0)
      return "soil of body \"" + body.name + "\" keeps the volume by which it opens inside membrane \"" +
             membrane.name + "\": a bag that is dropped swells; void_memory = true lets its soil close again";
  return {};
}

/// Terzaghi's column has 11 % of its consolidation at T_v = 0.01 and 99.4 % at 2.
std::string drainage_in_words(double time_factor) {
  constexpr double hardly = 0.01, all = 2;
  if (time_factor < hardly) return "as good as undrained";
  return time_factor > all ? "drained in the end" : "neither drained nor undrained";
}

/// The cell at the surface of a soil is filled at one moment and open at the next: its particles went past their final
/// stress (a fifth of the height lost: settlement 3.5 % off, with the pressure of particles 0.3 %). A sharp membrane
/// cuts the cells of its soil exactly; with the pressure of particles a bag that was torn fell 19 % too fast.
std::string pressure_of_coupled_soil(const Scene& scene, const BodySpec& body) {
  if (body.saturated_by.empty()) return {};
  const bool bagged = in_sharp_membrane(scene, body.name), of_particles = body.pressure == PressureSupport::particle;
  if (bagged != of_particles) return {};
  const std::string start = "coupled soil of body \"" + body.name + "\" has the pressure of ";
  return start + (bagged ? "particles: in a bag that shakes it their stresses drift apart, and their mean grows; take "
                           "pressure = \"cell\" in a sharp membrane"
                         : "cells: where it loses much of its height take pressure = \"particle\"; the water in its "
                           "pores keeps it from locking");
}

std::string drainage_of(const Scene& scene, const PoreSoil& soil) {
  const Consolidation drains = consolidation(scene, soil);
  const std::string start = "coupled soil of body \"" + scene.bodies[soil.body].name + "\": ";
  if (!std::isfinite(drains.path)) return start + "walls on all sides, no water leaves";
  return start + fmt::format("c_v = {:.3g} m2/s, drainage over {:.3g} m, T_v = {:.3g} over the run: {}",
                             drains.coefficient, drains.path, drains.time_factor,
                             drainage_in_words(drains.time_factor));
}

}  // namespace

std::vector<std::string> scene_notes(const Scene& scene) {
  std::vector<std::string> notes = scene.notes;
  for (const BodySpec& body : scene.bodies)
    for (const std::string& note : {drained_under_water(scene, body), soil_that_swells(scene, body),
                                    pressure_of_coupled_soil(scene, body), denser_below(scene, body)})
      if (!note.empty()) notes.push_back(note);
  for (const PoreSoil& soil : pore_soils(scene)) notes.push_back(drainage_of(scene, soil));
  return notes;
}

}  // namespace geodrop
