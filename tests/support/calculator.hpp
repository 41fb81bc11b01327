// Calls of a calculator: its words, its lines, its refusals.
#pragma once

#include <doctest/doctest.h>

#include <sstream>
#include <string>
#include <vector>

#include "support/program.hpp"

namespace geodrop::test {

using Words = std::vector<std::string>;

inline Words operator+(Words a, const Words& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// The words of the line that begins so, joined by single spaces; empty if there is none.
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

inline void check_refused(const Outcome& outcome, const std::string& says) {
  CAPTURE(outcome.err);
  CHECK(outcome.code == 2);
  CHECK(outcome.out.empty());
  CHECK(contains(outcome.err, says));
}

}  // namespace geodrop::test
