// Water that does not fit together, and numerical settings and outputs out of all scale.
#pragma once

#include <geodrop/scene/scene.hpp>

#include <string>
#include <vector>

namespace geodrop {

/// Surfaces of still fluids that are not where the fluid ends; a wave speed too low for the depth.
std::vector<std::string> doubtful_water(const Scene& scene);

/// Blend rate and Courant number; bodies of too few cells.
std::vector<std::string> doubtful_numerics(const Scene& scene);

/// Frames that fill the disk, or none between start and end.
std::vector<std::string> doubtful_output(const Scene& scene);

/// Bytes of all frames, about, if each interval holds a step [byte].
double output_bytes(const Scene& scene);

}  // namespace geodrop
