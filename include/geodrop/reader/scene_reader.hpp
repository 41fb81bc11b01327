// From a TOML file to a checked `Scene`, and the reference page of all its keys.
#pragma once

#include <geodrop/scene/scene.hpp>
#include <string>
#include <vector>

namespace geodrop {

/// Reads and checks the scene file at `path`. Each override is the text of a `--set key=value`: value is TOML (a bare
/// word is a text, nothing removes the key); elements of lists of tables are addressed by name or by index from 0.
/// Throws one SceneError that carries every problem found.
Scene read_scene(const std::string& path, const std::vector<std::string>& overrides = {});

/// The page docs/scene.md, made from the table of keys that `read_scene` checks against.
std::string scene_reference_markdown();

}  // namespace geodrop
