// The texts of --set key=value, applied to a parsed scene before it is checked.
#pragma once

#include "keys/report.hpp"
#include "keys/toml.hpp"

#include <string>
#include <vector>

namespace geodrop {

/// Values are TOML; a bare word is a text; an empty value removes the key. Elements of lists of tables are addressed
/// by name or by index from 0.
void apply_overrides(toml::table& scene, const std::vector<std::string>& overrides, Report& report);

}  // namespace geodrop
