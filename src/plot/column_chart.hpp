// Columns of the histories of one or several runs in one picture.
#pragma once

#include "chart.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace geodrop {

struct ColumnChartOptions {
  std::vector<std::filesystem::path> runs;
  std::vector<std::string> columns;               ///< of history.csv
  std::string against = "time_s";                 ///< the column along x
  std::vector<std::filesystem::path> references;  ///< tables (CSV) with the column along x and others to compare with
};

/// A panel for each unit; a line for each column of each run, dashed ones for the columns of a reference with that
/// unit. Throws SceneError that names the nearest column if a run has none of that name.
Chart column_chart(const ColumnChartOptions& options);

}  // namespace geodrop
