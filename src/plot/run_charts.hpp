// The standard pictures of a run.
#pragma once

#include "calculators/tension_safety.hpp"
#include "chart.hpp"
#include "csv_table.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace geodrop {

/// A picture and the name of its file, without ending.
struct NamedChart {
  std::string stem;
  Chart chart;
};

/// history.csv of a run. Throws SceneError if there is none or it has no row.
CsvTable read_history(const std::filesystem::path& directory);

/// "history", "geotube_PROBE" for each geotube probe, "section_PROBE" for each section probe if a rigid body turns.
/// `factors`: what reduces the strengths of the scene, which are drawn beside tensions. Throws SceneError if there is
/// nothing to draw, or the directory has a scene that cannot be read.
std::vector<NamedChart> run_charts(const std::filesystem::path& directory, const TensionStrength& factors = {});

}  // namespace geodrop
