// Tubes as text, as CSV and as a picture.
#pragma once

#include <geodrop/calculators/geotube.hpp>

#include "calculators/tension_safety.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace geodrop {

enum class ReportLayout { one_tube, table };

struct GeotubeReport {
  GeotubeInput input;          ///< of the first tube; the others differ in its value only
  std::vector<Geotube> tubes;  ///< at least one
  std::optional<TensionStrength> strength;
  ReportLayout layout = ReportLayout::one_tube;
};

/// What was assumed, every result with its unit, the safety if there is a strength.
std::string report_text(const GeotubeReport& report);

/// Throws SceneError unless the directory is new, empty, or one that this command wrote before.
void check_geotube_directory(const std::filesystem::path& directory);

/// geotube.csv with a row a tube, outline.svg, and for one tube outline.csv. Throws RunError if they cannot be written.
void write_geotube_files(const std::filesystem::path& directory, const GeotubeReport& report, int segments);

}  // namespace geodrop
