// history.csv: one row of named numbers per output time, kept in memory as well because results are made from it.
#pragma once

#include <geodrop/measure/measure.hpp>
#include <geodrop/scene/scene.hpp>
#include <geodrop/state/state.hpp>
#include <string>
#include <vector>

namespace geodrop {

/// Columns with units in their names; rows as wide as the columns, the first column is time_s.
struct HistoryTable {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;

  /// Index of a column; columns.size() if there is none of this name.
  std::size_t find(const std::string& column) const;
};

/// Names of the columns that a run of this scene writes, in order.
std::vector<std::string> history_columns(const Scene& scene);

/// One row for the present state. `earlier` are the rows so far: rotation is unwrapped against the last one,
/// dissipated energy counts from the first one.
template <int Dim>
std::vector<double> history_row(const Scene& scene, const State<Dim>& state, const HistoryTable& earlier);

}  // namespace geodrop
