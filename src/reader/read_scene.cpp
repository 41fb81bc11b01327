#include <geodrop/base/input_file.hpp>
#include <geodrop/reader/scene_reader.hpp>

#include "complete_scene.hpp"
#include "former_words.hpp"
#include "overrides.hpp"
#include "reader/checks/check_scene.hpp"
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

std::vector<std::string> notes_of(const std::string& path, const Report& report) {
  std::vector<std::string> notes;
  for (const auto& [at, text] : report.notes()) {
    const std::string place = std::to_string(at.line) + ":" + std::to_string(at.column);
    notes.push_back(path + ":" + (at.line == 0 ? " --set" : place) + ": " + text);
  }
  return notes;
}

}  // namespace

Scene read_scene(const std::string& path, const std::vector<std::string>& overrides) {
  Report report;
  toml::table written = parse(path);
  rename_former_words(written, report);
  apply_overrides(written, overrides, report);
  rename_former_words(written, report);  // in the values of overrides
  Scene scene;
  const toml::table complete = complete_scene(written, scene, report);
  check_scene(scene, report);
  if (!report.problems().empty()) throw SceneError(path, report.problems());
  scene.file = path;
  scene.notes = notes_of(path, report);
  scene.as_run = write_scene(complete);
  return scene;
}

}  // namespace geodrop
