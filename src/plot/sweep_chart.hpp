// A result of a sweep over one or two of its keys.
#pragma once

#include "chart.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace geodrop {

struct SweepChartOptions {
  std::filesystem::path directory;  ///< with a manifest.csv
  std::vector<std::string> over;    ///< one or two keys: along x, and a curve for each value
  std::string result;
};

/// Of the runs that are done. Points where further keys vary or values were drawn, else lines. Throws SceneError that
/// names what the manifest has.
Chart sweep_chart(const SweepChartOptions& options);

}  // namespace geodrop
