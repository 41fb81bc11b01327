#include <geodrop/scene/velocity_fields.hpp>

#include <algorithm>

#include "needs.hpp"

namespace geodrop {
namespace {

/// The body that a membrane lies on; empty if there is no such membrane.
std::string body_of_membrane(const Scene& scene, const std::string& name) {
  for (const MembraneSpec& membrane : scene.membranes)
    if (membrane.name == name) return body_inside(scene, membrane);
  return {};
}

bool parts(const Scene& scene, const std::string& body) {
  if (in_sharp_membrane(scene, body)) return true;
  return std::any_of(scene.contacts.begin(), scene.contacts.end(), [&](const ContactSpec& contact) {
    const std::string one = body_of_membrane(scene, contact.between[0]);
    const std::string other = body_of_membrane(scene, contact.between[1]);
    return !one.empty() && !other.empty() && one != other && (one == body || other == body);
  });
}

/// Whether a body is the water in the pores of a soil in a sharp membrane.
bool flows_in_bag(const Scene& scene, const std::string& body) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(), [&](const BodySpec& soil) {
    return soil.saturated_by == body && in_sharp_membrane(scene, soil.name);
  });
}

}  // namespace

std::vector<int> velocity_fields(const Scene& scene) {
  std::vector<int> field(scene.bodies.size(), 0);
  const auto part = [&](const BodySpec& body) { return parts(scene, body.name) || flows_in_bag(scene, body.name); };
  const bool none_around = std::all_of(scene.bodies.begin(), scene.bodies.end(), part);
  int next = none_around && !has_sharp_interface(scene) ? 0 : 1;  // air around a sharp interface is number 0, too
  for (std::size_t b = 0; b < field.size(); ++b)
    if (part(scene.bodies[b])) field[b] = next++;
  // Soils through whose pores water flows touch each other in one field, beside that of the water.
  for (std::size_t b = 0; b < field.size(); ++b)
    if (!scene.bodies[b].saturated_by.empty() && !part(scene.bodies[b])) field[b] = next;
  return field;
}

const NewtonianSpec* fluid_around(const Scene& scene) {
  const std::vector<int> fields = velocity_fields(scene);
  for (std::size_t b = 0; b < fields.size(); ++b) {
    const MaterialSpec* material = find_material(scene, scene.bodies[b].material);
    const auto* fluid = material ? std::get_if<NewtonianSpec>(&material->model) : nullptr;
    if (fluid && fields[b] == 0) return fluid;
  }
  return nullptr;
}

int count_velocity_fields(const Scene& scene) {
  const std::vector<int> field = velocity_fields(scene);
  return field.empty() ? 1 : 1 + *std::max_element(field.begin(), field.end());
}

}  // namespace geodrop
