// Writes a complete scene as TOML, in the order of the table of keys.
#pragma once

#include "keys/toml.hpp"

#include <string>

namespace geodrop {

/// Reading the text again gives the same scene.
std::string write_scene(const toml::table& complete);

}  // namespace geodrop
