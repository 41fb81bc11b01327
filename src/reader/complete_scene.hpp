// Checks a scene as written against the rows of its sections, and fills its values and defaults.
#pragma once

#include "keys/report.hpp"
#include "keys/toml.hpp"

#include <geodrop/scene/scene.hpp>

namespace geodrop {

/// Fills `scene` and returns it as TOML with every key that is right and all defaults; everything that is wrong goes to
/// the report, and its members stay as they are by default.
toml::table complete_scene(const toml::table& written, Scene& scene, Report& report);

}  // namespace geodrop
