// The known name that a misspelt one was probably meant to be.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace geodrop {

/// Edits (insert, delete, replace, swap of neighbours) from one word to the other.
int edit_distance(std::string_view a, std::string_view b);

/// The nearest of `known`, the first of several; empty if `known` is.
std::string nearest_name(std::string_view name, const std::vector<std::string>& known);

/// "one of "a", "b"; nearest to "x": "a"" or, if nothing is known, "none: the scene has no KIND".
std::string name_advice(std::string_view name, const std::vector<std::string>& known, std::string_view kind);

}  // namespace geodrop
