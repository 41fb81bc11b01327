// Checks a scene as written against the table of keys and fills in the defaults.
#pragma once

#include "report.hpp"
#include "toml.hpp"

namespace geodrop {

/// Returns the scene with every key that is right and all defaults; everything that is wrong goes to the report.
toml::table complete_scene(const toml::table& written, Report& report);

}  // namespace geodrop
