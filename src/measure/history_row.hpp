// A row of history.csv while it is made.
#pragma once

#include <string>
#include <vector>

namespace geodrop {

/// Names with values, in the order of the columns.
struct HistoryRow {
  std::vector<std::string> names;
  std::vector<double> values;

  void add(const std::string& name, double value) {
    names.push_back(name);
    values.push_back(value);
  }
  /// One column per axis: `before` + "_x_" + `unit`, ...
  template <class Vector>
  void add_vector(const std::string& before, const std::string& unit, const Vector& vector, int dimension) {
    constexpr const char* axis_names[] = {"x", "y", "z"};
    for (int a = 0; a < dimension; ++a) add(before + "_" + axis_names[a] + "_" + unit, vector[a]);
  }
};

}  // namespace geodrop
