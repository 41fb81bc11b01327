// The scene as a value, and what the names in it refer to.
#include <geodrop/scene/scene.hpp>

#include <algorithm>

namespace geodrop {
namespace {

template <class Element>
const Element* find_by(std::string Element::*member, const std::vector<Element>& list, const std::string& name) {
  const auto found = std::find_if(list.begin(), list.end(), [&](const Element& each) { return each.*member == name; });
  return found == list.end() ? nullptr : &*found;
}

}  // namespace

const MaterialSpec* find_material(const Scene& scene, const std::string& name) {
  return find_by(&MaterialSpec::name, scene.materials, name);
}
const BodySpec* find_body(const Scene& scene, const std::string& name) {
  return find_by(&BodySpec::name, scene.bodies, name);
}
const ExactSpec* find_exact(const Scene& scene, const std::string& body) {
  return find_by(&ExactSpec::body, scene.exact, body);
}

bool has_sharp_interface(const Scene& scene) {
  return std::any_of(scene.membranes.begin(), scene.membranes.end(),
                     [](const MembraneSpec& membrane) { return membrane.interface == Interface::sharp; });
}

ContactPair contact_pair(const Scene& scene, const ContactSpec& contact) {
  const auto& [a, b] = contact.between;
  const auto is_membrane = [&](const std::string& name) {
    return find_by(&MembraneSpec::name, scene.membranes, name) != nullptr;
  };
  if (is_membrane(a) && is_membrane(b)) return {ContactPair::Kind::membranes, a, b};
  const bool b_is_rigid = find_by(&RigidSpec::name, scene.rigid, b) != nullptr;
  const std::string &touching = b_is_rigid ? a : b, &other = b_is_rigid ? b : a;
  if (!find_by(&RigidSpec::name, scene.rigid, other)) return {};
  if (is_membrane(touching)) return {ContactPair::Kind::membrane_on_rigid, touching, other};
  const bool covered = find_by(&MembraneSpec::body, scene.membranes, touching) != nullptr;
  if (find_body(scene, touching) && !covered) return {ContactPair::Kind::body_on_rigid, touching, other};
  return {};
}

}  // namespace geodrop
