// `geodrop ensemble`: many runs of a scene with inputs drawn at random.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

#include "ensemble/ensemble.hpp"

namespace geodrop {

struct EnsembleArguments {
  EnsembleOptions options;
  std::vector<std::string> vary;
};

void add_ensemble_options(CLI::App& command, EnsembleArguments& arguments);

/// Returns the exit code: 0, or 1 if a run failed. Throws SceneError, see run_ensemble.
int run_ensemble(EnsembleArguments arguments);

}  // namespace geodrop
