// JSON of runs, checks and the scene's schema (nlohmann-json).
#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace geodrop {

/// Members keep the order in which they were added.
using Json = nlohmann::ordered_json;

/// Two spaces a level, a line feed at the end; text that is no UTF-8 as U+FFFD, numbers that are not finite as null.
std::string json_text(const Json& json);

}  // namespace geodrop
