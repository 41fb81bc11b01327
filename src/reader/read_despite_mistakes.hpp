// A scene with mistakes, for what can be said of the rest of it.
#pragma once

#include <geodrop/scene/scene.hpp>

#include <string>
#include <vector>

namespace geodrop {

/// As `read_scene`, but what is wrong keeps its initial value. Throws SceneError if the file cannot be read as TOML.
Scene read_despite_mistakes(const std::string& path, const std::vector<std::string>& overrides);

}  // namespace geodrop
