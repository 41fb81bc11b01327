#include "scene_file.hpp"

#include <algorithm>

#include "bench/machine.hpp"

namespace geodrop {
namespace {

namespace fs = std::filesystem;

constexpr const char* ending = ".toml";

/// A case by its path, cases/..., or by its name alone; empty if there is none.
fs::path shipped_case(const fs::path& typed) {
  if (*typed.begin() == "cases") return find_beside_program(typed);
  if (typed.has_parent_path() || (typed.has_extension() && typed.extension() != ending)) return {};
  const std::vector<fs::path> cases = shipped_cases();
  const auto found = std::ranges::find(cases, typed.stem(), [](const fs::path& file) { return file.stem(); });
  return found == cases.end() ? fs::path() : *found;
}

}  // namespace

CLI::Option* add_scene_argument(CLI::App& command, std::string& scene) {
  return names_scene(command.add_option("scene", scene, "scene file (TOML, see docs/scene.md), or the name of a case"));
}

CLI::Option* names_scene(CLI::Option* option) {
  return option->transform(CLI::Validator(
      [](std::string& scene) {
        scene = find_scene(scene);
        return std::string();
      },
      "", "scene"));
}

std::string find_scene(const std::string& typed) {
  std::error_code none;
  if (typed.empty() || fs::exists(typed, none)) return typed;
  if (std::string here = typed + ending; fs::exists(here, none)) return here;
  const fs::path found = shipped_case(typed);
  return found.empty() ? typed : found.string();
}

std::vector<fs::path> shipped_cases() {
  std::vector<fs::path> files;
  const fs::path cases = find_beside_program("cases");
  if (!cases.empty())
    for (const auto& entry : fs::recursive_directory_iterator(cases))
      if (entry.path().extension() == ending) files.push_back(entry.path());
  std::ranges::sort(files, {}, [](const fs::path& file) { return file.stem(); });
  return files;
}

}  // namespace geodrop
