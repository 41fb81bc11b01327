// Identifiers and numbers as a scene may write them.
#pragma once

#include "toml.hpp"

#include <string_view>

namespace geodrop {

inline constexpr std::string_view kIdentifierText = "letters, digits and '_', beginning with a letter";
bool is_identifier(std::string_view word);

/// A whole number counts too, rounded if it is beyond 2^53 (toml++ gives nothing then); 0 if the node is no number.
double to_number(const toml::node& node);

}  // namespace geodrop
