// What a run left behind in its summary.json, read back.
#pragma once

#include <geodrop/files/output.hpp>
#include <geodrop/measure/results.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "summary.hpp"

namespace geodrop {

struct RunRecord {
  std::string status, message, version, scene, title;
  RunIdentity run;
  double wall_seconds = 0;  ///< of its last process
  std::vector<std::string> warnings;
  std::vector<StageTime> stages;
  std::vector<Fact> facts;
  std::vector<Result> results;
  std::vector<Expectation> expectations;
  std::string state_hash;

  /// Time, steps and results are not known: the run is at work, or was killed.
  bool is_running() const { return status == "running"; }
  /// NaN if there is none of this name.
  double result(const std::string& name) const;
};

/// Empty if the directory has no summary.json that can be read.
std::optional<RunRecord> find_run_record(const std::filesystem::path& directory);

/// Throws SceneError if the directory has no summary.json that can be read.
RunRecord read_run_record(const std::filesystem::path& directory);

}  // namespace geodrop
