#include "bench.hpp"

#include <omp.h>

#include <array>

#include "only_if.hpp"
#include "scene_file.hpp"
#include "threads.hpp"

namespace geodrop {
namespace {

/// What is measured instead of the table of speeds; one of them.
void add_bench_modes(CLI::App& command, BenchArguments& arguments) {
  auto* growth = command.add_flag("--growth", arguments.growth,
                                  "cost against number of particles and size of the domain, on 1 and on all threads");
  auto* against =
      command.add_option("--against", arguments.options.against,
                         "exit with 1 if a benchmark is slower than with this program or commit, in pairs in "
                         "turn on one thread (perf/README.md)");
  auto* instructions =
      command.add_flag("--instructions", arguments.instructions,
                       "count instructions by valgrind; exit with 1 if a benchmark has over 2 % more than "
                       "perf/instructions.csv says");
  command.add_flag("--update", arguments.options.update, "with --instructions: write that table")->needs(instructions);
  auto* steps = command.add_option("--steps", arguments.options.steps,
                                   "make so many steps of each on one thread; prints lines for programs to read: name, "
                                   "particles, steps, processor time [s]");
  steps->check(only_if<int>([](int n) { return n >= 1; }, "a whole number > 0"));
  const std::array<CLI::Option*, 4> modes{growth, against, instructions, steps};
  for (CLI::Option* mode : modes)
    for (CLI::Option* other : modes)
      if (mode != other) mode->excludes(other);
}

}  // namespace

void add_bench_options(CLI::App& command, BenchArguments& arguments) {
  BenchOptions& bench = arguments.options;
  command.add_flag("--quick", bench.quick, "1e5 instead of 1e6 particles, fewer repeats");
  add_threads(command, arguments.threads);
  command.add_option("--output", arguments.output, "directory for bench.csv or growth.csv (default: runs/bench)");
  command.add_option("--only", bench.only, "only benchmarks whose name contains this; =NAME: only this one");
  command.add_option("--particles", bench.particles, "particles of a block; with --growth, at most")
      ->check(only_if<double>([](double n) { return n >= 1e3 && n <= 1e8; }, "a number from 1e3 to 1e8"));
  names_scene(command.add_option("--scene", bench.scene, "main case (default: cases/dump_kekerdom.toml)"));
  add_bench_modes(command, arguments);
}

int run_bench_command(const BenchArguments& arguments) {
  BenchOptions options = arguments.options;
  options.directory = arguments.output.empty() ? "runs/bench" : arguments.output;
  options.threads = options.steps > 0 ? 1 : choose_threads(arguments.threads);
  omp_set_num_threads(options.threads);
  if (arguments.growth) return run_growth(options);
  if (options.steps > 0) return run_steps(options);
  if (arguments.instructions) return run_instructions(options);
  return options.against.empty() ? run_bench(options) : run_against(options);
}

}  // namespace geodrop
