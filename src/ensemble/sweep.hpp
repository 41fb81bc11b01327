// Many runs of one scene with inputs that are set: all combinations of some values, or samples of ranges.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "axes.hpp"
#include "samples.hpp"

namespace geodrop {

struct SweepOptions {
  std::string scene;
  std::vector<std::string> overrides;  ///< for all cases
  std::vector<Axis> axes;              ///< all combinations of them, or
  std::vector<Variation> variations;   ///< ranges that `samples` are drawn from
  int samples = 0;
  std::uint64_t seed = 0;
  int jobs = 1;  ///< runs at a time, each on one thread
  std::filesystem::path output;
  std::vector<std::string> command;  ///< as it was typed, for array.sbatch
};

/// Makes the runs in OUTPUT/case_001 and so on and writes manifest.csv, see Batch; prints a table of inputs and
/// results. Writes array.sbatch, by which a Slurm queue makes them instead. Throws SceneError for a mistake in any
/// case, or if the directory holds something else. Returns 0, 1 if a run failed, 75 if it was stopped.
int run_sweep(const SweepOptions& options);

/// The same without a run: array.sbatch, and manifest.csv of what is there.
int prepare_sweep(const SweepOptions& options);

/// This process becomes the run of case NUMBER, counted from 1; returns 0 if that is done already.
int become_case(const SweepOptions& options, int number);

}  // namespace geodrop
