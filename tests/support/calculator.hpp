// Calls of a calculator: its words, its refusals.
#pragma once

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "support/program.hpp"
#include "support/text.hpp"

namespace geodrop::test {

using Words = std::vector<std::string>;

inline Words operator+(Words a, const Words& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

inline void check_refused(const Outcome& outcome, const std::string& says) {
  CAPTURE(outcome.err);
  CHECK(outcome.code == 2);
  CHECK(outcome.out.empty());
  CHECK(contains(outcome.err, says));
}

}  // namespace geodrop::test
