// docs/step.md has a heading for each row of the step, and under it what the row says that it reads and writes.
#include <doctest/doctest.h>

#include <map>
#include <sstream>

#include "support/golden.hpp"

#include <geodrop/step/pipeline.hpp>

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
  add(read_scene(source_path("cases/verification/seepage_through_fabric.toml")));
  for (const test::Golden& golden : test::golden_scenes())
    add(read_scene(source_path(golden.scene()), test::settings_of(golden)));
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
  const std::string page = read_file(source_path("docs/step.md"));
  const std::map<std::string, std::string> rows = rows_of_scenes();
  CHECK(rows.size() == 61);
  for (const auto& [name, fields] : rows) {
    CAPTURE(name);
    CAPTURE(fields);
    CHECK(fields_below(page, name).find(fields) != std::string::npos);
  }
}
