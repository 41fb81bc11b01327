#include "needs.hpp"

#include <algorithm>

namespace geodrop {

bool any_body_shifts(const Scene& scene) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(), [](const BodySpec& body) { return body.shift; });
}

bool any_body_with(const Scene& scene, PressureSupport pressure) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                     [&](const BodySpec& body) { return body.pressure == pressure; });
}

bool any_contact_of(const Scene& scene, ContactPair::Kind kind) {
  return std::any_of(scene.contacts.begin(), scene.contacts.end(),
                     [&](const ContactSpec& contact) { return contact_pair(scene, contact).kind == kind; });
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
         any_body_with(scene, PressureSupport::enclosed);
}

bool any_pores(const Scene& scene) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                     [](const BodySpec& body) { return !body.saturated_by.empty(); });
}

bool saturates(const Scene& scene, const std::string& body) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                     [&](const BodySpec& soil) { return soil.saturated_by == body; });
}

}  // namespace geodrop
