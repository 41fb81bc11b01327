// Speed of the whole step, as million particle-steps per second, beside what the machine can do at the same moment.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace geodrop {

struct BenchOptions {
  std::filesystem::path directory;             ///< results go here
  int threads = 1;                             ///< also those of OpenMP
  bool quick = false;                          ///< 1e5 instead of 1e6 particles, fewer repeats
  std::string only;                            ///< part of a name; empty: all
  double particles = 0;                        ///< of each block; 0: as `quick` says
  std::filesystem::path scene;                 ///< of the main case; empty: cases/dump_kekerdom.toml of the source tree
  std::optional<std::filesystem::path> check;  ///< judge by these ratios; empty path: those of perf/results
};

/// Runs all benchmarks, prints a table, writes bench.csv. With `check`, also compares each with its committed ratio.
/// Returns the exit code: 0 done, 1 a benchmark lost speed, 2 nothing to run or to compare with.
int run_bench(const BenchOptions& options);

/// Cost per particle-step against the number of particles and against the size of the domain, on one thread and on
/// `threads`; writes growth.csv. Returns the exit code as `run_bench` does.
int run_growth(const BenchOptions& options);

}  // namespace geodrop
