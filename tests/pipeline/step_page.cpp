// docs/step.md has a heading for each row of the step, and under it what the row says that it reads and writes.
#include <doctest/doctest.h>

#include <fstream>
#include <map>
#include <sstream>

#include "support/scene_files.hpp"

#include <geodrop/pipeline.hpp>

using namespace geodrop;

namespace {

/// All rows that scenes of every feature have: name, and what the page says of it.
std::map<std::string, std::string> rows_of_scenes() {
  std::map<std::string, std::string> rows;
  const auto add = [&](const Scene& scene) {
    const auto list = [&](const auto& pipeline) {
      for (const auto& row : pipeline) {
        const std::string reads = names_of(row.reads);
        rows[row.name] = (reads.empty() ? "" : reads + " ") + "→ " + names_of(row.writes);
      }
    };
    if (scene.dimension == 2)
      list(build_pipeline<2>(scene));
    else
      list(build_pipeline<3>(scene));
  };
  add(read_scene(source_path("cases/dump_barge_underwater.toml")));
  std::ifstream file(source_path("tests/golden/hashes.csv"));
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    std::string name, scene, overrides, setting;
    std::getline(std::getline(std::getline(cells, name, ','), scene, ','), overrides, ',');
    std::vector<std::string> settings;
    for (std::istringstream text(overrides); std::getline(text, setting, ';');) settings.push_back(setting);
    add(read_scene(source_path(scene), settings));
  }
  return rows;
}

/// The line of fields below the heading that names the row; empty if there is none.
std::string fields_below(const std::string& page, const std::string& row) {
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("## ")) continue;
    std::istringstream names(line.substr(3));
    for (std::string name; std::getline(names >> std::ws, name, ',');)
      if (name == row && std::getline(lines, line)) return line;
  }
  return "";
}

}  // namespace

TEST_CASE("Each row has its heading in docs/step.md, with the fields that it reads and writes") {
  std::stringstream page;
  page << std::ifstream(source_path("docs/step.md")).rdbuf();
  const std::map<std::string, std::string> rows = rows_of_scenes();
  CHECK(rows.size() == 40);
  for (const auto& [name, fields] : rows) {
    CAPTURE(name);
    CAPTURE(fields);
    CHECK(fields_below(page.str(), name).find(fields) != std::string::npos);
  }
}
