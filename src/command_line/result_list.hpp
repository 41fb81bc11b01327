// Numbers with a name and a unit, for the terminal and for a CSV, so that the two cannot fall out of step.
#pragma once

#include <string>
#include <vector>

namespace geodrop {

/// Not the Result of a run (results.hpp).
struct ListedNumber {
  std::string name, column, unit;  ///< for people, for the CSV
  double value;
};

using ResultList = std::vector<ListedNumber>;

/// Name, value and unit, a line each. Throws SceneError, as row_table does, if a value is infinite; here also if it is
/// NaN.
std::vector<std::vector<std::string>> result_lines(const ResultList& results);

/// A header of names, one of units and a line for each list; all have the names of the first. `no_number` stands where
/// a value is NaN.
std::string row_table(const std::vector<ResultList>& rows, const std::string& no_number);

/// A header of columns and a row for each list; all have the columns of the first.
std::string results_csv(const std::vector<ResultList>& rows);

}  // namespace geodrop
