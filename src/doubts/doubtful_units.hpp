// Values that look as if they were in kN, t, MPa or radians.
#pragma once

#include <geodrop/scene/scene.hpp>

#include <string>
#include <vector>

namespace geodrop {

std::vector<std::string> doubtful_units(const Scene& scene);

}  // namespace geodrop
