// What an option may be, in the words of all messages: what was found, what is allowed.
#pragma once

#include <CLI/CLI.hpp>

#include <cmath>
#include <string>

namespace geodrop {

/// CLI's own validators would answer with their whole range, up to 1.8e308.
template <class Number, class Condition>
CLI::Validator only_if(const Condition& good, const std::string& allowed) {
  const auto complaint = [good, allowed](const std::string& text) {
    Number value{};
    const bool fits = CLI::detail::lexical_cast(text, value) && good(value);
    return fits ? std::string() : "found " + text + "; allowed: " + allowed;
  };
  return CLI::Validator(complaint, "", "only_if");
}

/// From 1 to `most`.
inline CLI::Validator whole_number(int most) {
  return only_if<int>([most](int n) { return n >= 1 && n <= most; },
                      "a whole number from 1 to " + std::to_string(most));
}

inline CLI::Validator positive(const std::string& allowed) {
  return only_if<double>([](double value) { return value > 0 && std::isfinite(value); }, allowed);
}

}  // namespace geodrop
