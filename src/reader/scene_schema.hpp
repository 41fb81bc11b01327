// The keys of scene files for editors, from the table of keys.
#pragma once

#include <string>

namespace geodrop {

/// A JSON schema (draft 7), which editors for TOML understand (taplo, Even Better TOML): names, types, words, units,
/// defaults and meanings. Conditions between keys are left to `geodrop check`.
std::string scene_schema();

}  // namespace geodrop
