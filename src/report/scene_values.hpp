// The values of a scene as run, as tables and as a list.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace geodrop {

/// Tables of grid, solver, materials, bodies and membranes with their units. `scene`: scene.toml of a run.
std::string scene_values_html(const std::filesystem::path& scene);

/// All keys with their values, numbers as short as they read back the same, texts without quotes; elements of lists by
/// their names: {"materials.water.density", "1000"}.
std::vector<std::pair<std::string, std::string>> flat_scene(const std::filesystem::path& scene);

}  // namespace geodrop
