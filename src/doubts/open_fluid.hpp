// Questions about fluids that no membrane holds.
#pragma once

#include <geodrop/scene/scene.hpp>

namespace geodrop {

/// The law of a body of fluid; null if it is none.
const NewtonianSpec* fluid_of(const Scene& scene, const BodySpec& body);

/// Downwards [m/s2].
double strength_of_gravity(const Scene& scene);

}  // namespace geodrop
