#include "needs.hpp"

#include <geodrop/base/find_named.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace geodrop {

bool any_body_shifts(const Scene& scene) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(), [](const BodySpec& body) { return body.shift; });
}

bool makes_room(const BodySpec& body) { return body.shift && body.shift_speed > 0; }

bool any_body_with(const Scene& scene, PressureSupport pressure) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                     [&](const BodySpec& body) { return body.pressure == pressure; });
}

bool any_contact_of(const Scene& scene, ContactPair::Kind kind) {
  return std::any_of(scene.contacts.begin(), scene.contacts.end(),
                     [&](const ContactSpec& contact) { return contact_pair(scene, contact).kind == kind; });
}

bool any_fluid_at_rigid(const Scene& scene) {
  const auto of_fluid = [&](const ContactSpec& contact) {
    const ContactPair pair = contact_pair(scene, contact);
    if (pair.kind != ContactPair::Kind::body_on_rigid) return false;
    const BodySpec& body = *find_body(scene, pair.touching);
    return body.pressure == PressureSupport::cell && fluid_of(scene, body);
  };
  return scene.dimension == 2 && scene.grid.basis == Basis::bspline2 && std::ranges::any_of(scene.contacts, of_fluid);
}

bool any_membrane_contact(const Scene& scene) {
  return any_contact_of(scene, ContactPair::Kind::membrane_on_rigid) ||
         any_contact_of(scene, ContactPair::Kind::membranes);
}

bool any_model_drag(const Scene& scene) {
  return std::any_of(scene.membranes.begin(), scene.membranes.end(),
                     [](const MembraneSpec& membrane) { return membrane.drag_coefficient > 0; });
}

bool any_membrane_load(const Scene& scene) {
  return any_membrane_contact(scene) || any_model_drag(scene) || !scene.still_fluids.empty() ||
         any_body_with(scene, PressureSupport::enclosed) || any_surface_pressure(scene);
}

bool any_surface_pressure(const Scene& scene) {
  return scene.dimension == 3 &&
         (!scene.still_fluids.empty() || std::any_of(scene.membranes.begin(), scene.membranes.end(), presses_out));
}

bool presses_out(const MembraneSpec& membrane) { return membrane.gauge_pressure != 0; }

bool any_pores(const Scene& scene) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                     [](const BodySpec& body) { return !body.saturated_by.empty(); });
}

bool has_inertial_drag(const Scene& scene, const BodySpec& soil) {
  const MaterialSpec* material = soil.saturated_by.empty() ? nullptr : find_material(scene, soil.material);
  const auto* skeleton = material ? std::get_if<MohrCoulombSpec>(&material->model) : nullptr;
  return skeleton && skeleton->coupled() && skeleton->coupled()->forchheimer_coefficient > 0;
}

bool saturates(const Scene& scene, const std::string& body) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                     [&](const BodySpec& soil) { return soil.saturated_by == body; });
}

std::string body_inside(const Scene& scene, const MembraneSpec& membrane) {
  if (scene.dimension == 2) {
    const auto bagged = [&](const BodySpec& soil) {  // a bag of soil and free water has the outline of the water
      return membrane.interface == Interface::sharp && soil.saturated_by == membrane.body;
    };
    const auto soil = std::ranges::find_if(scene.bodies, bagged);
    return soil == scene.bodies.end() ? membrane.body : soil->name;
  }
  for (const BodySpec& body : scene.bodies)
    if (const auto* inside = std::get_if<InsideShape>(&body.shape);
        inside && inside->membrane == membrane.name && !saturates(scene, body.name))
      return body.name;
  return "";
}

namespace {

bool encloses(const Scene& scene, const MembraneSpec& membrane, const BodySpec& body) {
  return (scene.dimension == 3 || membrane.closed) && body_inside(scene, membrane) == body.name;
}

}  // namespace

bool is_enclosed(const Scene& scene, const BodySpec& body) {
  return std::any_of(scene.membranes.begin(), scene.membranes.end(),
                     [&](const MembraneSpec& membrane) { return encloses(scene, membrane, body); });
}

bool in_geotextile(const Scene& scene, const BodySpec& body) {
  return std::any_of(scene.membranes.begin(), scene.membranes.end(), [&](const MembraneSpec& membrane) {
    return membrane.axial_stiffness > 0 && encloses(scene, membrane, body);
  });
}

bool in_sharp_membrane(const Scene& scene, const std::string& body) {
  return std::any_of(scene.membranes.begin(), scene.membranes.end(), [&](const MembraneSpec& membrane) {
    return membrane.interface == Interface::sharp && body_inside(scene, membrane) == body;
  });
}

double water_unit_weight(const Scene& scene, const BodySpec& water) {
  constexpr double standard_gravity = 9.81;  // of the conductivity, where the scene has none
  const double g = scene.gravity.back() < 0 ? -scene.gravity.back() : standard_gravity;
  return std::get<NewtonianSpec>(find_material(scene, water.material)->model).density * g;
}

const CoupledSpec* pores_of(const Scene& scene, const BodySpec& body) {
  const MaterialSpec* material = find_material(scene, body.material);
  const auto* soil = material ? std::get_if<MohrCoulombSpec>(&material->model) : nullptr;
  return soil ? soil->coupled() : nullptr;
}

Material law_of(const Scene& scene, const BodySpec& body) {
  Material law = make_material(*find_material(scene, body.material));
  for (const BodySpec& soil : scene.bodies) {
    if (soil.saturated_by != body.name) continue;
    const CoupledSpec* const pores = pores_of(scene, soil);
    auto* const water = std::get_if<Newtonian>(&law);
    if (!pores || !water || pores->gas_ratio() == 0) continue;
    water->gas = std::max(water->gas, pores->gas_ratio());
    water->atmosphere = pores->gas.atmospheric_pressure;
  }
  return law;
}

const HydrostaticSpec* still_fluid_of(const InitialStress& stress) {
  if (const auto* fluid = std::get_if<HydrostaticSpec>(&stress)) return fluid;
  if (const auto* pressure = std::get_if<FluidPressureSpec>(&stress)) return &pressure->fluid;
  const auto* k0 = std::get_if<K0StressSpec>(&stress);
  return k0 && k0->fluid ? &*k0->fluid : nullptr;
}

double contents_friction(const Scene& scene, const MembraneSpec& membrane) {
  constexpr double share_of_angle = 2.0 / 3;  // of soil on geotextile, as is usual in design
  if (membrane.contents_friction >= 0) return membrane.contents_friction;
  const MaterialSpec& material = *find_material(scene, find_named(scene.bodies, body_inside(scene, membrane)).material);
  if (std::holds_alternative<NewtonianSpec>(material.model)) return 0;
  const auto* soil = std::get_if<MohrCoulombSpec>(&material.model);
  return soil ? std::tan(share_of_angle * soil->friction_angle_deg * std::numbers::pi / 180)
              : std::numeric_limits<double>::infinity();
}

bool slides(const Scene& scene, const MembraneSpec& membrane) {
  return scene.dimension == 2 && membrane.axial_stiffness > 0 && std::isfinite(contents_friction(scene, membrane));
}

bool any_membrane_slides(const Scene& scene) {
  return std::any_of(scene.membranes.begin(), scene.membranes.end(),
                     [&](const MembraneSpec& membrane) { return slides(scene, membrane); });
}

bool any_sharp_skin(const Scene& scene) {
  return std::any_of(scene.membranes.begin(), scene.membranes.end(), [](const MembraneSpec& membrane) {
    return membrane.interface == Interface::sharp && membrane.axial_stiffness == 0 && membrane.mass_per_area == 0;
  });
}

bool rubs_sharply(const MembraneSpec& membrane) {
  return membrane.interface == Interface::sharp && (membrane.shear != Shear::none || !membrane.bed.empty());
}

bool lies_on_grains(const Scene& scene, const MembraneSpec& membrane) {
  const BodySpec* bed = find_body(scene, membrane.bed);
  return membrane.interface == Interface::sharp && bed && !bed->saturated_by.empty();
}

const NewtonianSpec* fluid_of(const Scene& scene, const BodySpec& body) {
  const MaterialSpec* material = find_material(scene, body.material);
  return material ? std::get_if<NewtonianSpec>(&material->model) : nullptr;
}

bool any_fluid(const Scene& scene) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                     [&](const BodySpec& body) { return fluid_of(scene, body) != nullptr; });
}

bool any_mixing_length(const Scene& scene) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(), [&](const BodySpec& body) {
    const NewtonianSpec* fluid = fluid_of(scene, body);
    return fluid && fluid->mixing_length > 0;
  });
}

}  // namespace geodrop
