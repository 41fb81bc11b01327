// `geodrop sweep`: many runs of a scene over values of its keys.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

#include "ensemble/sweep.hpp"

namespace geodrop {

struct SweepArguments {
  SweepOptions options;
  std::vector<std::string> vary;
  int only = 0;  ///< number of the one case to run; 0: all
  bool no_run = false;
};

void add_sweep_options(CLI::App& command, SweepArguments& arguments);

/// Returns the exit code, see run_sweep. `typed`: the command, for the job array.
int run_sweep(SweepArguments arguments, const std::vector<std::string>& typed);

}  // namespace geodrop
