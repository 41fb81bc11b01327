// The one tree of all sections and keys that a scene may have. Reading, filling the values, checking, "nearest name",
// the scene as run and docs/scene.md all come from it. The rows stand in sections/.
#pragma once

#include "keys/key.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace geodrop {

/// The top level.
const Section& scene_section();

/// All sections in the order of the page.
const std::vector<const Section*>& section_table();
const Section& find_section(std::string_view path);

/// The word of a choice for one of its enumerators.
std::string word_of(std::string_view section, std::string_view name, int enumerator);
template <class Enum>
std::string word_of(std::string_view section, std::string_view name, Enum enumerator) {
  return word_of(section, name, static_cast<int>(enumerator));
}

}  // namespace geodrop
