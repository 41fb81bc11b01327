// Values as text, for messages and for the scene as run.
#pragma once

#include "toml.hpp"

#include <geodrop/scene/scene.hpp>

#include <string>

namespace geodrop {

/// The shortest text that reads back as the same number: "-1000", "0.25", "2.13e+09".
std::string to_text(double value);
std::string to_text(const Point& point);

/// A value as TOML in one line; "a table" for a table.
std::string to_text(const toml::node& node);

}  // namespace geodrop
