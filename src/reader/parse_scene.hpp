// A scene file as TOML. A slip of syntax does not hide the other mistakes: its line is left out and parsing goes on.
#pragma once

#include "keys/toml.hpp"

#include <geodrop/base/error.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace geodrop {

struct ParsedScene {
  toml::table table;
  std::vector<SceneProblem> slips;  ///< of syntax
  std::vector<std::string> lost;  ///< keys of lines that were left out: what is said of them is no mistake of the user
};

/// Throws SceneError if the file cannot be read, or a slip leaves nothing sure behind it, such as an open bracket.
ParsedScene parse_scene(const std::string& path);

/// What is wrong with a value as it is written: "25cm", "0,25", "8.9 MPa"; empty if nothing is known. `key`: the last
/// word of its key, whose unit is named.
std::string advice_on_value(std::string_view value, std::string_view key);

/// Without the problems of these keys.
std::vector<SceneProblem> without(std::vector<SceneProblem> problems, const std::vector<std::string>& keys);

}  // namespace geodrop
