// Questions about fluids that no membrane holds.
#pragma once

#include <geodrop/scene/scene.hpp>

namespace geodrop {

/// Downwards [m/s2].
double strength_of_gravity(const Scene& scene);

}  // namespace geodrop
