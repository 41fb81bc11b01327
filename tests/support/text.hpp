// What stands in a text that the program wrote.
#pragma once

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "support/scene_files.hpp"

namespace geodrop::test {

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// The words of the first line that begins so, joined by single spaces; empty if there is none.
inline std::string line(const std::string& text, const std::string& beginning) {
  std::istringstream lines(text);
  for (std::string found; std::getline(lines, found);) {
    std::istringstream words(found);
    std::string joined;
    for (std::string word; words >> word;) joined += (joined.empty() ? "" : " ") + word;
    if (joined.starts_with(beginning)) return joined;
  }
  return {};
}

/// Lines and cells of a table without quotes.
inline std::vector<std::vector<std::string>> csv(const std::filesystem::path& path) {
  std::istringstream lines(geodrop::read_file(path));
  std::vector<std::vector<std::string>> table;
  for (std::string line, cell; std::getline(lines, line);) {
    table.emplace_back();
    std::istringstream cells(line);
    while (std::getline(cells, cell, ',')) table.back().push_back(cell);
  }
  return table;
}

}  // namespace geodrop::test
