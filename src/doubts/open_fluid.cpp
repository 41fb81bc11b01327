#include "open_fluid.hpp"

#include <algorithm>

#include "scene/needs.hpp"

namespace geodrop {

const NewtonianSpec* fluid_of(const Scene& scene, const BodySpec& body) {
  return std::get_if<NewtonianSpec>(&find_material(scene, body.material)->model);
}

bool is_enclosed(const Scene& scene, const BodySpec& body) {
  return std::ranges::any_of(scene.membranes,
                             [&](const MembraneSpec& each) { return each.body == body.name && each.closed; });
}

double strength_of_gravity(const Scene& scene) { return -scene.gravity.back(); }

}  // namespace geodrop
