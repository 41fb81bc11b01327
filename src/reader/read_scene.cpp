#include <geodrop/reader/scene_reader.hpp>

#include "complete_scene.hpp"
#include "former_words.hpp"
#include "overrides.hpp"
#include "parse_scene.hpp"
#include "read_despite_mistakes.hpp"
#include "reader/checks/check_scene.hpp"
#include "setup/draw_surface.hpp"
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

/// Surfaces of membranes in space, and the bodies inside them.
void draw_surfaces(const std::string& path, Scene& scene, Report& report) {
  if (scene.dimension != 3 || !report.healthy("dimension") || !report.healthy("grid") || !report.healthy("walls"))
    return;
  for (std::size_t m = 0; m < scene.membranes.size(); ++m) {
    MembraneSpec& membrane = scene.membranes[m];
    const std::string& key = report.element("membranes", m);
    if (!report.healthy(key + ".surface") || !report.healthy(key + ".segments_per_cell")) continue;
    const SurfaceFault fault = draw_surface(scene.grid, scene.walls, path, membrane);
    if (!fault.found.empty()) report.add(key + fault.key, fault.found, fault.allowed);
    for (BodySpec& body : scene.bodies)
      if (auto* inside = std::get_if<InsideShape>(&body.shape); inside && inside->membrane == membrane.name)
        inside->region = membrane.drawn.region;
  }
}

/// The scene as run is read again from another directory.
void make_paths_absolute(const std::string& path, toml::table& complete) {
  toml::array* membranes = complete["membranes"].as_array();
  for (std::size_t m = 0; membranes && m < membranes->size(); ++m) {
    toml::table& membrane = *membranes->get(m)->as_table();
    toml::table* surface = membrane["surface"].as_table();
    if (!surface) continue;
    if (const auto file = (*surface)["file"].value<std::string>())
      surface->insert_or_assign("file", surface_path(path, *file));
  }
}

/// What the values of a file and overrides are filled into, and what is wrong with them.
struct Reading {
  Scene scene;
  toml::table complete;  ///< with all defaults
  Report report;
  ParsedScene parsed;
};

Reading read_values(const std::string& path, const std::vector<std::string>& overrides) {
  Reading reading{{}, {}, {}, parse_scene(path)};
  toml::table& written = reading.parsed.table;
  rename_former_words(written, reading.report);
  apply_overrides(written, overrides, reading.report);
  rename_former_words(written, reading.report);  // in the values of overrides
  if (written.empty()) reading.report.add("", "a scene without keys", "a scene, such as `geodrop new NAME` writes");
  reading.complete = complete_scene(written, reading.scene, reading.report);
  return reading;
}

}  // namespace

Scene read_despite_mistakes(const std::string& path, const std::vector<std::string>& overrides) {
  return read_values(path, overrides).scene;
}

Scene read_scene(const std::string& path, const std::vector<std::string>& overrides) {
  auto [scene, complete, report, parsed] = read_values(path, overrides);
  make_paths_absolute(path, complete);
  draw_surfaces(path, scene, report);
  check_scene(scene, report);
  std::vector<SceneProblem> problems = parsed.slips;
  for (const SceneProblem& problem : without(report.problems(), parsed.lost)) problems.push_back(problem);
  std::ranges::stable_sort(problems, {}, [](const SceneProblem& each) { return each.at.line; });
  if (!problems.empty()) throw SceneError(path, problems);
  scene.file = path;
  scene.notes = notes_of(path, report);
  scene.as_run = write_scene(complete);
  return std::move(scene);
}

}  // namespace geodrop
