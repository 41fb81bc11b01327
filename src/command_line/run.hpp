// geodrop run: a scene from its file to its run directory.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace geodrop {

struct RunArguments {
  std::string scene;
  std::vector<std::string> overrides;
  std::string output;
  int threads = 0;
  bool exact_threads = false;
  double until = 0;
  bool resume = false;
  bool overwrite = false;
  bool verify = false;
  std::string parts;
};

/// A scene file and --set.
void add_scene(CLI::App& command, std::string& scene, std::vector<std::string>& overrides);

void add_run_options(CLI::App& command, RunArguments& arguments);

/// `command`: as it was typed, the program first. Returns the exit code.
int start_run(const RunArguments& arguments, const std::vector<std::string>& command);

}  // namespace geodrop
