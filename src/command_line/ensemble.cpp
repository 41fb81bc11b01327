#include "ensemble.hpp"

#include <omp.h>

#include "only_if.hpp"
#include "scene_file.hpp"

namespace geodrop {

void add_ensemble_options(CLI::App& command, EnsembleArguments& arguments) {
  EnsembleOptions& options = arguments.options;
  add_scene_argument(command, options.scene)->required();
  command.add_option("--samples", options.samples, "number of runs")->required()->check(whole_number(100000));
  command
      .add_option(
          "--vary", arguments.vary,
          "KEY=LOW:HIGH, a key of the scene and its range, e.g. --vary bodies.container.shape.tilt_deg=2.0:10.0; "
          "whole numbers are drawn whole; KEY=LOW:HIGH:log draws the logarithm evenly; KEY+KEY=... gives both the same "
          "value")
      ->required()
      ->take_all()
      ->expected(1);
  command.add_option("--set", options.overrides, "override a key of the scene for all runs")->take_all()->expected(1);
  command.add_option("--seed", options.seed, "of the random order of the samples (default: 0)");
  command.add_option("--jobs", options.jobs, "runs at a time, each on one thread (default: all cores)")
      ->check(whole_number(1024));
  command.add_option("--output", options.output, "directory (default: runs/<scene>_ensemble)");
  options.jobs = omp_get_num_procs();
}

int run_ensemble(EnsembleArguments arguments) {
  EnsembleOptions& options = arguments.options;
  for (const std::string& text : arguments.vary) options.variations.push_back(parse_variation(text));
  if (options.output.empty())
    options.output =
        std::filesystem::path("runs") / (std::filesystem::path(options.scene).stem().string() + "_ensemble");
  return run_ensemble(options);
}

}  // namespace geodrop
