// Speed of the whole step: measured, compared with another version of the program, counted in instructions.
#pragma once

#include <filesystem>
#include <string>

namespace geodrop {

struct BenchOptions {
  std::filesystem::path directory;  ///< results go here
  int threads = 1;                  ///< also those of OpenMP
  bool quick = false;               ///< 1e5 instead of 1e6 particles, fewer repeats
  std::string only;                 ///< part of a name, or = and a whole name; empty: all
  double particles = 0;             ///< of each block; 0: what the command takes
  std::filesystem::path scene;      ///< of the main case; empty: cases/dump_kekerdom.toml of the source tree
  int steps = 0;                    ///< for run_steps
  bool update = false;              ///< for run_instructions: write the table instead of comparing with it
  std::string against;              ///< for run_against: a program, or a commit of this source tree
};

/// Runs all benchmarks in turn with reference kernels, prints a table, writes bench.csv. Returns the exit code: 0 done,
/// 2 nothing to run.
int run_bench(const BenchOptions& options);

/// Cost per particle-step against the number of particles and against the size of the domain, on one thread and on
/// `threads`; writes growth.csv. Returns the exit code as `run_bench` does.
int run_growth(const BenchOptions& options);

/// Makes so many steps of each benchmark on one thread and prints a line for each, for programs to read: name,
/// particles, steps, processor time [s].
int run_steps(const BenchOptions& options);

/// Counts the instructions of a particle-step of each benchmark by valgrind and compares them with
/// perf/instructions.csv. Returns the exit code: 0 none has more, 1 one has, 2 nothing to count or to compare with.
int run_instructions(const BenchOptions& options);

/// Compares processor times with those of another version in pairs in turn. Returns the exit code: 0 none is slower, 1
/// one is, 2 nothing to compare.
int run_against(const BenchOptions& options);

}  // namespace geodrop
