#include "open_fluid.hpp"

namespace geodrop {

double strength_of_gravity(const Scene& scene) { return -scene.gravity.back(); }

}  // namespace geodrop
