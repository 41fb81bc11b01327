#include <geodrop/input_file.hpp>
#include <geodrop/scene_reader.hpp>

#include "check_scene.hpp"
#include "complete_scene.hpp"
#include "overrides.hpp"
#include "write_scene.hpp"

#include <utility>

namespace geodrop {
namespace {

toml::table parse(const std::string& path) {
  const std::string text = read_input(path, "", "a scene in TOML");
  try {
    return toml::parse(text, std::string_view(path));
  } catch (const toml::parse_error& error) {
    const SceneProblem problem{to_ref(error.source()), "syntax", std::string(error.description()),
                               "TOML 1.0, each key once"};
    throw SceneError(path, {problem});
  }
}

}  // namespace

Scene read_scene(const std::string& path, const std::vector<std::string>& overrides) {
  Report report;
  toml::table written = parse(path);
  apply_overrides(written, overrides, report);
  Scene scene;
  const toml::table complete = complete_scene(written, scene, report);
  check_scene(scene, report);
  if (!report.problems().empty()) throw SceneError(path, report.problems());
  scene.file = path;
  scene.as_run = write_scene(complete);
  return scene;
}

}  // namespace geodrop
