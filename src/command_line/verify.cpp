#include "verify.hpp"

#include "result_directory.hpp"
#include "scene_file.hpp"

#include <geodrop/verify/verify.hpp>

namespace geodrop {

void add_verify_options(CLI::App& command, VerifyArguments& arguments) {
  names_scene(command.add_option("scenes", arguments.scenes, "scene files with a [[verify]] (default: all of cases/)"));
  auto* quick = command.add_flag("--quick", arguments.quick, "only the quick runs of each case (default)");
  command.add_flag("--full", arguments.full, "the runs of all resolutions")->excludes(quick);
  command.add_option("--only", arguments.only, "only cases whose name contains this");
  command.add_option("--output", arguments.output, "directory for verification.csv, pictures and runs")
      ->capture_default_str();
  command.add_option("--page", arguments.page,
                     "page whose part between the verify marks is written anew, its pictures beside it");
}

int run_verify(const VerifyArguments& arguments, int threads) {
  check_result_directory({arguments.output, "geodrop verify", "verification.csv"});
  VerifyOptions options;
  options.directory = arguments.output;
  options.threads = threads;
  options.mode = arguments.full ? VerifyMode::full : VerifyMode::quick;
  options.only = arguments.only;
  options.scenes.assign(arguments.scenes.begin(), arguments.scenes.end());
  options.page = arguments.page;
  return run_verify(options);
}

}  // namespace geodrop
