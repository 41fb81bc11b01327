// Checks one value (not a table) against its row of the table of keys.
#pragma once

#include "keys/key.hpp"
#include "keys/toml.hpp"

#include <string>

namespace geodrop {

struct ValueCheck {
  bool ok = true;
  std::string found;  ///< what is wrong with it, for the message
};
ValueCheck check_value(const Key& key, const toml::node& node, int dimension);

/// "a number > 0 [Pa]", "a list of 2 numbers (dimension = 2)", ...; `dimension` 0: of a scene of either.
std::string describe_allowed(const Key& key, int dimension);

/// When a row applies: "type=box|ellipse" as "type = "box" or "ellipse"", and its dimension.
std::string readable_condition(const Key& key);

}  // namespace geodrop
