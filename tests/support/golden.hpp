// The table of golden scenes, tests/golden/hashes.csv: each feature is in one of them.
#pragma once

#include <array>
#include <sstream>
#include <string>
#include <vector>

#include "support/scene_files.hpp"

namespace geodrop::test {

inline std::string golden_path() { return source_path("tests/golden/hashes.csv"); }

/// A line of the file; `sums` is what the hash depends on besides the source, see docs/reproducibility.md.
struct Golden {
  std::array<std::string, 5> cells;

  std::string name() const { return cells[0]; }
  std::string scene() const { return cells[1]; }
  std::string overrides() const { return cells[2]; }
  std::string sums() const { return cells[3]; }
  std::string hash() const { return cells[4]; }
};

inline std::vector<Golden> read_golden() {
  std::istringstream lines(read_file(golden_path()));
  std::vector<Golden> all;
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::istringstream text(line);
    Golden golden;
    for (std::string& cell : golden.cells) std::getline(text, cell, ',');
    all.push_back(golden);
  }
  return all;
}

inline std::vector<std::string> settings_of(const Golden& golden) {
  std::istringstream text(golden.overrides());
  std::vector<std::string> settings;
  for (std::string setting; std::getline(text, setting, ';');) settings.push_back(setting);
  return settings;
}

/// One line of each scene: those for other sums follow it.
inline std::vector<Golden> golden_scenes() {
  std::vector<Golden> scenes;
  for (const Golden& golden : read_golden())
    if (scenes.empty() || scenes.back().name() != golden.name()) scenes.push_back(golden);
  return scenes;
}

}  // namespace geodrop::test
