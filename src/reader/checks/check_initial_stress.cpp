// Checks of the stress at the start: it fits the material, the fluid exists, soil at rest does not yield.
#include "check_scene.hpp"

#include <geodrop/geometry/shapes.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/needs.hpp"

namespace geodrop {
namespace {

struct BodyView {
  const Scene& scene;
  const BodySpec& body;
  std::string key;  ///< "bodies.NAME"
  Report& report;

  std::string stress() const { return key + ".initial_stress"; }
  /// Nothing if the material is unknown or its model is wrong.
  const MaterialSpec* material() const {
    const MaterialSpec* found = find_material(scene, body.material);
    return found && report.healthy("materials." + found->name) ? found : nullptr;
  }
};

bool is_fluid(const MaterialSpec& material) { return std::holds_alternative<NewtonianSpec>(material.model); }

void check_type(const BodyView& view) {
  const MaterialSpec* material = view.material();
  if (!material || !view.report.healthy(view.stress())) return;
  const std::string of = " for a body of \"" + material->name + '"';
  if (std::holds_alternative<HydrostaticSpec>(view.body.initial_stress) && !is_fluid(*material)) {
    view.report.add(view.stress() + ".type", "\"hydrostatic\"" + of,
                    "\"zero\", \"k0\" or \"fluid_pressure\" for a body that is no fluid");
  }
  if (std::holds_alternative<NeoHookeanSpec>(material->model) &&
      !std::holds_alternative<ZeroStressSpec>(view.body.initial_stress) &&
      !std::holds_alternative<FromExactSpec>(view.body.initial_stress)) {
    view.report.add(view.stress() + ".type", "a stress without strain" + of,
                    "\"zero\" or \"exact\", as the stress of a neo_hookean material follows from its strain");
    return;
  }
  const bool solid_only = std::holds_alternative<K0StressSpec>(view.body.initial_stress) ||
                          std::holds_alternative<FluidPressureSpec>(view.body.initial_stress);
  if (solid_only && is_fluid(*material)) {
    const bool k0 = std::holds_alternative<K0StressSpec>(view.body.initial_stress);
    view.report.add(view.stress() + ".type", (k0 ? "\"k0\"" : "\"fluid_pressure\"") + of,
                    "\"zero\" or \"hydrostatic\" for a fluid");
  }
}

void check_still_fluid(const BodyView& view) {
  const HydrostaticSpec* still = still_fluid_of(view.body.initial_stress);
  if (!still || !view.report.healthy(view.stress())) return;
  const std::string key = view.stress() + ".fluid";
  if (!check_fluid(view.scene, key, still->fluid, view.report)) return;
  const MaterialSpec* material = view.material();
  const bool own = std::holds_alternative<HydrostaticSpec>(view.body.initial_stress) && material && is_fluid(*material);
  if (own && still->fluid != view.body.material) {
    view.report.add(key, '"' + still->fluid + '"', "the body's own material, \"" + view.body.material + '"');
  }
}

/// The stress of a coupled soil is effective stress; that from K0 is less by the buoyancy of the water in its pores.
void check_pore_pressure(const BodyView& view) {
  const MaterialSpec* material = view.material();
  const auto* soil = material ? std::get_if<MohrCoulombSpec>(&material->model) : nullptr;
  const BodySpec* water = find_body(view.scene, view.body.saturated_by);
  if (!soil || !soil->coupled() || !water || !view.report.healthy(view.stress())) return;
  if (std::holds_alternative<FluidPressureSpec>(view.body.initial_stress))
    view.report.add(view.stress() + ".type", "\"fluid_pressure\" for the coupled soil \"" + material->name + '"',
                    "\"zero\", \"k0\" or \"uniform\": the pressure of the water is that of \"" + water->name + '"');
  const auto* k0 = std::get_if<K0StressSpec>(&view.body.initial_stress);
  const auto* still = std::get_if<HydrostaticSpec>(&water->initial_stress);
  if (!k0 || !view.report.healthy("bodies." + water->name)) return;
  if (!k0->fluid && still)
    view.report.add(view.stress() + ".under",
                    "\"air\" with the hydrostatic pressure of \"" + water->name + "\" in the pores",
                    "\"fluid\" with fluid_surface = " + to_text(still->surface));
  if (k0->fluid && (!still || still->fluid != k0->fluid->fluid || still->surface != k0->fluid->surface))
    view.report.add(
        view.stress() + ".fluid_surface",
        to_text(k0->fluid->surface) + " of \"" + k0->fluid->fluid + "\", with " +
            (still ? "the level " + to_text(still->surface) + " of \"" + still->fluid + "\"" : "another pressure") +
            " in the pores",
        "the fluid and level of the initial_stress of \"" + water->name + "\", a hydrostatic one");
}

void check_gravity(const BodyView& view) {
  if (std::holds_alternative<ZeroStressSpec>(view.body.initial_stress) ||
      std::holds_alternative<FromExactSpec>(view.body.initial_stress) ||
      std::holds_alternative<UniformPressureSpec>(view.body.initial_stress) || !view.report.healthy("gravity") ||
      !view.report.healthy(view.stress()))
    return;
  const Point& gravity = view.scene.gravity;
  const bool level = std::all_of(gravity.begin(), gravity.end() - 1, [](double g) { return g == 0; });
  if (!level || gravity.back() > 0) {
    view.report.add(view.stress() + ".type", "a stress over depth with gravity = " + to_text(gravity),
                    "gravity straight down, or \"zero\"");
  }
}

double density(const MaterialSpec& material) {
  return std::visit([](const auto& model) { return model.density; }, material.model);
}

/// Effective stress at the foot of a body at rest: what K0 acts on, and the isotropic rest [Pa], compression positive.
struct FootStress {
  double vertical = 0;  ///< from the weight of the soil, less buoyancy
  double ambient = 0;   ///< pressure of the fluid around, carried by the skeleton of a drained soil
};

FootStress foot_stress(const BodyView& view, const K0StressSpec& k0, const MohrCoulombSpec& soil) {
  const Bounds box = bounds_within(view.body.shape, {view.scene.grid.lower, view.scene.grid.upper});
  const double g = -view.scene.gravity.back();
  const double depth = std::max(0.0, k0.surface - box.lower.back());
  const MaterialSpec* fluid = k0.fluid ? find_material(view.scene, k0.fluid->fluid) : nullptr;
  const BodySpec* water = find_body(view.scene, view.body.saturated_by);
  const MaterialSpec* in_pores = water && soil.coupled() ? find_material(view.scene, water->material) : nullptr;
  const double mixture = soil.density + (in_pores ? soil.coupled()->porosity * density(*in_pores) : 0.0);
  if (!fluid) return {mixture * g * depth, 0};
  const double pressure = density(*fluid) * g * (std::max(0.0, k0.fluid->surface - k0.surface) + depth);
  return {(mixture - density(*fluid)) * g * depth, soil.undrained() || soil.coupled() ? 0 : pressure};
}

/// Soil under isotropic tension is torn from the first step on.
void check_tension(const BodyView& view) {
  const auto* uniform = std::get_if<UniformPressureSpec>(&view.body.initial_stress);
  const MaterialSpec* material = view.material();
  const auto* soil = uniform && material ? std::get_if<MohrCoulombSpec>(&material->model) : nullptr;
  if (!soil || !view.report.healthy(view.stress()) || uniform->pressure >= -soil->tension_cutoff) return;
  view.report.add(
      view.stress() + ".pressure", to_text(uniform->pressure),
      "at least -tension_cutoff of \"" + material->name + "\" = " + to_text(0 - soil->tension_cutoff) + " [Pa]");
}

/// Strength and stress grow in proportion to depth, cohesion does not: the foot of the body yields first.
void check_yield(const BodyView& view) {
  const auto* k0 = std::get_if<K0StressSpec>(&view.body.initial_stress);
  const MaterialSpec* material = view.material();
  const bool ready = k0 && material && view.report.healthy(view.stress()) && view.report.healthy(view.key + ".shape") &&
                     view.report.healthy("grid") && view.report.healthy("gravity") && shape_is_sound(view.body.shape);
  const auto* soil = ready ? std::get_if<MohrCoulombSpec>(&material->model) : nullptr;
  if (!soil) return;
  constexpr double kRounding = 1e-9;
  const FootStress foot = foot_stress(view, *k0, *soil);
  if (foot.vertical < 0) {
    view.report.add(view.stress() + ".type", "\"k0\" for a soil that is lighter than the fluid over it",
                    "a soil denser than the fluid");
    return;
  }
  const double sine = std::sin(soil->friction_angle_deg * std::numbers::pi / 180);
  const double strength = 2 * soil->cohesion * std::sqrt(1 - sine * sine) + 2 * foot.ambient * sine;
  // |s1 - s3| <= (s1 + s3) sin(phi) + 2 c cos(phi) with s1 = vertical + ambient and s3 = K0 vertical + ambient
  const double shear = std::abs(1 - k0->k0) * foot.vertical;
  if (shear <= ((1 + k0->k0) * foot.vertical * sine + strength) * (1 + kRounding)) return;
  const double relative = strength / foot.vertical;
  const double least = std::max(0.0, (1 - sine - relative) / (1 + sine));
  const double most = (1 + sine + relative) / (1 - sine);
  view.report.add(view.stress() + ".k0", to_text(k0->k0),
                  "a value within the yield surface of \"" + material->name + "\", from " + to_text(least) + " to " +
                      to_text(most));
}

}  // namespace

void check_initial_stress(const Scene& scene, Report& report) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const BodyView view{scene, scene.bodies[i], report.element("bodies", i), report};
    check_type(view);
    check_gravity(view);
    check_still_fluid(view);
    check_pore_pressure(view);
    check_yield(view);
    check_tension(view);
  }
}

}  // namespace geodrop
