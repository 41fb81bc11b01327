// What stands in a text that the program wrote.
#pragma once

#include <sstream>
#include <string>

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

}  // namespace geodrop::test
