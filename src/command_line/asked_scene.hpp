// The scene that a command is asked about.
#pragma once

#include <geodrop/scene/scene.hpp>

#include <string>
#include <vector>

namespace geodrop {

/// Units that are doubted in what can be read of a scene; none if it cannot be read as TOML.
std::vector<std::string> doubts_beside_mistakes(const std::string& file, const std::vector<std::string>& overrides);

/// Reads and checks a scene. If it has mistakes, tells on stderr which of its units are doubted, as these may be the
/// cause, and throws SceneError.
Scene asked_scene(const std::string& file, const std::vector<std::string>& overrides);

}  // namespace geodrop
