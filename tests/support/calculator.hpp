// Calls of a calculator: its words, its refusals.
#pragma once

#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

#include "plot/csv_table.hpp"
#include "support/near.hpp"
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

/// The first row of a table, to ten digits.
inline void check_columns(const CsvTable& table, const std::vector<std::pair<std::string, double>>& expected) {
  for (const auto& [name, value] : expected) {
    CAPTURE(name);
    CHECK(table.column(name).at(0) == near(value, 1e-9));
  }
}

}  // namespace geodrop::test
