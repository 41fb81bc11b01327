#include "plain_values.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace geodrop {

bool is_identifier(std::string_view word) {
  const auto allowed = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  return !word.empty() && std::isalpha(static_cast<unsigned char>(word[0])) &&
         std::all_of(word.begin(), word.end(), allowed);
}

double to_number(const toml::node& node) {
  if (const auto* integer = node.as_integer()) return static_cast<double>(integer->get());
  const auto* real = node.as_floating_point();
  return real ? real->get() : 0.0;
}

}  // namespace geodrop
