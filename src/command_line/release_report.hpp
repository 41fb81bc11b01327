// A release as text and as CSV.
#pragma once

#include "result_list.hpp"

#include <geodrop/calculators/release.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace geodrop {

struct ReleaseCase {
  ContainerSection section;
  double perimeter;  ///< [m]
  std::optional<SplitBarge> barge = {};
  std::optional<double> opening_width = {};  ///< [m]; without one the best
  double opening_angle = 0;                  ///< of each half of the barge, if there is one [rad]
  std::optional<double> fall_height = {};    ///< in air [m]
  std::optional<double> strength = {};       ///< [N/m]
  std::optional<SinkingContainer> sinking = {};
};

enum class OpeningRule { met, not_met };

struct ReleaseReport {
  ReleaseCase given;
  OpeningRule rule;
  ResultList inputs, results;
  std::vector<ResultList> wall_forces;  ///< against the angle, from closed to open; empty without a barge
};

/// Throws SceneError as the formulas do.
ReleaseReport make_release_report(const ReleaseCase& given);

std::string release_text(const ReleaseReport& report);

/// Throws SceneError unless the directory is new, empty, or one that this command wrote before.
void check_release_directory(const std::filesystem::path& directory);

/// release.csv, and wall_force.csv of a barge. Throws RunError if they cannot be written.
void write_release_files(const std::filesystem::path& directory, const ReleaseReport& report);

}  // namespace geodrop
