// Which bodies move with which velocity field.
#pragma once

#include <geodrop/scene/scene.hpp>

#include <vector>

namespace geodrop {

/// Numbers from 0 on, one for each body of the scene. Bodies that a contact lets slip on or part from another body have
/// a field each, and so has a body with a sharp interface, and the water in its pores; all others share one, number 0.
std::vector<int> velocity_fields(const Scene& scene);

/// The first fluid outside of all sharp membranes; null if there is none.
const NewtonianSpec* fluid_around(const Scene& scene);

/// The number of velocity fields, at least 1.
int count_velocity_fields(const Scene& scene);

}  // namespace geodrop
