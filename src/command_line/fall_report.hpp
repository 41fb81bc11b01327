// A fall as text and as CSV.
#pragma once

#include "result_list.hpp"

#include <geodrop/calculators/fall.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace geodrop {

struct FallCase {
  SinkingEllipse ellipse;          ///< with its air
  double density;                  ///< without [kg/m3]
  std::optional<double> air = {};  ///< share of the volume
  std::optional<Drag> drag = {};
  std::optional<double> fall_height = {};  ///< [m]
  std::optional<double> stiffness = {};    ///< [N/m]; needs the two above
};

struct FallReport {
  ResultList inputs, results;
  std::vector<ResultList> short_path, path;  ///< for people and for the CSV; empty without drag
};

/// Throws SceneError as the formulas do.
FallReport make_fall_report(const FallCase& given);

std::string fall_text(const FallReport& report);

/// Throws SceneError unless the directory is new, empty, or one that this command wrote before.
void check_fall_directory(const std::filesystem::path& directory);

/// fall.csv, and path.csv of a drag. Throws RunError if they cannot be written.
void write_fall_files(const std::filesystem::path& directory, const FallReport& report);

}  // namespace geodrop
