#include "open_fluid.hpp"

namespace geodrop {

const NewtonianSpec* fluid_of(const Scene& scene, const BodySpec& body) {
  return std::get_if<NewtonianSpec>(&find_material(scene, body.material)->model);
}

double strength_of_gravity(const Scene& scene) { return -scene.gravity.back(); }

}  // namespace geodrop
