// What the names in a scene refer to.
#include <geodrop/scene.hpp>

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

}  // namespace geodrop
