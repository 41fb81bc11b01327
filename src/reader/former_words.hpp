// Words that scenes had for a key earlier: they still hold, and a note names the word of today.
#pragma once

#include "keys/report.hpp"
#include "keys/toml.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace geodrop {

/// Renames the former words in a scene as written, before anything else looks at it. Both words at once are a mistake.
void rename_former_words(toml::table& written, Report& report);

/// The parts of a key given by --set, in the words of today.
std::vector<std::string> present_words(std::vector<std::string> parts, Report& report);

/// What stands in place of a key that there is no more, for the message; empty if there never was one.
std::string_view gone_word(std::string_view section, std::string_view key);

}  // namespace geodrop
