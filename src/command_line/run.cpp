#include "run.hpp"

#include <geodrop/step/run.hpp>

#include <omp.h>

#include <charconv>
#include <optional>

#include "asked_scene.hpp"
#include "base/shell_command.hpp"
#include "only_if.hpp"
#include "scene_file.hpp"
#include "threads.hpp"

namespace geodrop {
namespace {

CLI::Validator positive_time() {
  return only_if<double>([](double t) { return t > 0; }, "a time > 0 [s]");
}

/// "FIRST:LAST" as two whole numbers in order; empty if it is anything else.
std::optional<StepWindow> step_window(const std::string& text) {
  StepWindow window;
  const char* const end = text.data() + text.size();
  const auto [colon, first] = std::from_chars(text.data(), end, window.first);
  if (first != std::errc() || colon == end || *colon != ':') return std::nullopt;
  const auto [after, last] = std::from_chars(colon + 1, end, window.last);
  if (last != std::errc() || after != end || window.last < window.first) return std::nullopt;
  return window;
}

CLI::Validator steps() {
  return only_if<std::string>([](const std::string& text) { return step_window(text).has_value(); },
                              "FIRST:LAST, two steps");
}

}  // namespace

void add_scene(CLI::App& command, std::string& scene, std::vector<std::string>& overrides) {
  add_scene_argument(command, scene)->required();
  command
      .add_option(
          "--set", overrides,
          "override a key of the scene, e.g. --set grid.spacing=0.125; several: --set a=1 b=2 or --set a=1 --set b=2")
      ->take_all()
      ->expected(1);
}

void add_run_options(CLI::App& command, RunArguments& arguments) {
  add_scene(command, arguments.scene, arguments.overrides);
  add_most_threads(command, arguments.threads);
  command.add_flag(exact_threads, arguments.exact_threads, "as many threads in each step, also where fewer are faster");
  command.add_option("--output", arguments.output, "run directory (default: runs/<scene>)");
  command.add_option("--until", arguments.until, "stop at this simulated time [s], with a checkpoint")
      ->check(positive_time());
  auto* resume =
      command.add_flag("--resume", arguments.resume, "go on from the newest checkpoint in the run directory");
  command
      .add_flag("--overwrite", arguments.overwrite,
                "replace an earlier run in the run directory (default: it becomes NAME.1, NAME.2, ...)")
      ->excludes(resume);
  command.add_flag("--verify", arguments.verify, "exit with 1 if an expectation of the scene is not met");
  command
      .add_option("--record-parts", arguments.parts,
                  "write a hash after each row of the steps FIRST:LAST to parts.csv, for replay")
      ->check(steps());
}

int start_run(const RunArguments& arguments, const std::vector<std::string>& command) {
  RunOptions options;
  options.directory = arguments.output;
  options.threads = choose_threads(arguments.threads);
  options.fewer_threads = !arguments.exact_threads;
  options.resume = arguments.resume;
  options.end = arguments.until;
  options.earlier = arguments.overwrite ? EarlierRun::overwrite : EarlierRun::move_aside;
  options.command = shell_command(command);
  options.resume_command = resume_command(command);
  options.parts = step_window(arguments.parts);
  omp_set_num_threads(options.threads);
  return run_scene(asked_scene(arguments.scene, arguments.overrides), options, arguments.verify);
}

}  // namespace geodrop
