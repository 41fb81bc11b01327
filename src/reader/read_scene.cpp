#include <geodrop/reader/scene_reader.hpp>

#include "complete_scene.hpp"
#include "former_words.hpp"
#include "overrides.hpp"
#include "parse_scene.hpp"
#include "reader/checks/check_scene.hpp"
#include "write_scene.hpp"

#include <algorithm>
#include <utility>

namespace geodrop {
namespace {

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
  ParsedScene parsed = parse_scene(path);
  toml::table& written = parsed.table;
  rename_former_words(written, report);
  apply_overrides(written, overrides, report);
  rename_former_words(written, report);  // in the values of overrides
  Scene scene;
  const toml::table complete = complete_scene(written, scene, report);
  check_scene(scene, report);
  std::vector<SceneProblem> problems = parsed.slips;
  for (const SceneProblem& problem : without(report.problems(), parsed.lost)) problems.push_back(problem);
  std::ranges::stable_sort(problems, {}, [](const SceneProblem& each) { return each.at.line; });
  if (!problems.empty()) throw SceneError(path, problems);
  scene.file = path;
  scene.notes = notes_of(path, report);
  scene.as_run = write_scene(complete);
  return scene;
}

}  // namespace geodrop
