// Many runs of one scene with inputs drawn at random: what scatters, by how much, and because of which input.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "samples.hpp"

namespace geodrop {

struct EnsembleOptions {
  std::string scene;
  std::vector<std::string> overrides;  ///< for all runs
  std::vector<Variation> variations;
  int samples = 0;
  int jobs = 1;  ///< runs at a time, each on one thread
  std::uint64_t seed = 0;
  std::filesystem::path output;
};

/// Makes the runs in OUTPUT/run_001 and so on, one that is done already is not made again and one that was stopped goes
/// on; writes manifest.csv (inputs, exit code, results of each run) after each of them, and at the end bands.csv and
/// correlations.csv, which it prints. Returns 0, or 1 if a run failed. Throws SceneError for a mistake in the scene at
/// either end of a range, or if the directory holds an ensemble of another design.
int run_ensemble(const EnsembleOptions& options);

}  // namespace geodrop
