// The known name that a misspelt one was probably meant to be.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace geodrop {

/// Edits (insert, delete, replace, swap of neighbours) from one word to the other.
int edit_distance(std::string_view a, std::string_view b);

/// The nearest of `known`, the first of several, if it is near: at most a third of its letters are others, or one of
/// the two is a part of the other. Empty if none is.
std::string nearest_name(std::string_view name, const std::vector<std::string>& known);

/// "one of "a", "b"; the nearest is "a"" (if one is near) or, if nothing is known, "nothing here: the scene has no
/// KIND".
std::string name_advice(std::string_view name, const std::vector<std::string>& known, std::string_view kind);

}  // namespace geodrop
