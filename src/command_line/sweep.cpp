#include "sweep.hpp"

#include <omp.h>

#include "only_if.hpp"
#include "scene_file.hpp"

namespace geodrop {

void add_sweep_options(CLI::App& command, SweepArguments& arguments) {
  SweepOptions& options = arguments.options;
  add_scene_argument(command, options.scene)->required();
  command
      .add_option("--vary", arguments.vary,
                  "a key of the scene and its values: KEY=FROM:TO:COUNT, KEY=FROM:TO:COUNT:log (equal factors) or "
                  "KEY=A,B,C; several make all combinations. With --sample KEY=LOW:HIGH, also with :log. KEY+KEY=... "
                  "gives both "
                  "the same value")
      ->required()
      ->take_all()
      ->expected(1);
  command
      .add_option("--sample", options.samples, "instead of combinations so many samples of ranges (Latin hypercube)")
      ->check(whole_number(100000));
  command.add_option("--set", options.overrides, "override a key of the scene for all cases")->take_all()->expected(1);
  command.add_option("--seed", options.seed, "of the random order of samples (default: 0)");
  command.add_option("--jobs", options.jobs, "runs at a time, each on one thread (default: all cores)")
      ->check(whole_number(1024));
  command.add_option("--output", options.output, "directory (default: runs/<scene>_sweep)");
  auto* no_run = command.add_flag("--no-run", arguments.no_run,
                                  "run nothing: write array.sbatch, and manifest.csv of the cases that are there");
  command.add_option("--case", arguments.only, "run this case only, as a job array does")
      ->check(whole_number(100000))
      ->excludes(no_run);
  options.jobs = omp_get_num_procs();
}

int run_sweep(SweepArguments arguments, const std::vector<std::string>& typed) {
  SweepOptions& options = arguments.options;
  for (const std::string& text : arguments.vary) {
    if (options.samples > 0)
      options.variations.push_back(parse_variation(text));
    else
      options.axes.push_back(parse_axis(text));
  }
  if (options.output.empty())
    options.output = std::filesystem::path("runs") / (std::filesystem::path(options.scene).stem().string() + "_sweep");
  options.command = typed;
  if (!typed.empty() && typed.front().find('/') != std::string::npos)
    options.command.front() = std::filesystem::absolute(typed.front()).string();
  if (arguments.only > 0) return become_case(options, arguments.only);
  return arguments.no_run ? prepare_sweep(options) : run_sweep(options);
}

}  // namespace geodrop
