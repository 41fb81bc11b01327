// `geodrop replay`: a run made again from its scene, and where its states differ from the recorded ones.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace geodrop {

struct ReplayArguments {
  std::string run;  ///< directory
};

void add_replay_options(CLI::App& command, ReplayArguments& arguments);

/// Returns the exit code: 0 all hashes equal, 1 one differs. Throws SceneError if the directory has no recorded run.
int run_replay(const ReplayArguments& arguments);

}  // namespace geodrop
