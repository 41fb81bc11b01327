// The scene that an argument names: a file, or a case that comes with the program.
#pragma once

#include <CLI/CLI.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace geodrop {

/// The argument "scene", as find_scene reads it.
CLI::Option* add_scene_argument(CLI::App& command, std::string& scene);

/// The same reading of any other option that names a scene, or of each of several.
CLI::Option* names_scene(CLI::Option* option);

/// What is there stays as it was typed. Else NAME is NAME.toml of the current directory; else NAME, NAME.toml and
/// cases/NAME.toml are cases that come with the program. Else it stays as well, to be refused by whoever reads it.
std::string find_scene(const std::string& typed);

/// Scenes that come with the program, sorted by name.
std::vector<std::filesystem::path> shipped_cases();

}  // namespace geodrop
