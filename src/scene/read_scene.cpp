#include <geodrop/scene_reader.hpp>

#include "bind_scene.hpp"
#include "check_scene.hpp"
#include "complete_scene.hpp"
#include "overrides.hpp"
#include "write_scene.hpp"

#include <fstream>
#include <sstream>
#include <utility>

namespace geodrop {
namespace {

std::string read_text(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  // An empty file leaves `text` in a failed state, a directory leaves `file` in one.
  if (!file || (file.peek() != std::ifstream::traits_type::eof() && !(text << file.rdbuf())) || file.bad()) {
    throw SceneError(path, {{{}, "", "no readable file", "a scene in TOML"}});
  }
  return text.str();
}

toml::table parse(const std::string& path) {
  const std::string text = read_text(path);
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
  const toml::table complete = complete_scene(written, report);
  Scene scene = bind_scene(complete, report);
  check_scene(scene, report);
  if (!report.problems().empty()) throw SceneError(path, report.problems());
  scene.file = path;
  scene.as_run = write_scene(complete);
  return scene;
}

}  // namespace geodrop
