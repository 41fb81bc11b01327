// geodrop check, stages and info: what is known of a scene before it runs.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace geodrop {

struct CheckArguments {
  std::string scene;  ///< info: none if empty
  std::vector<std::string> overrides;
  bool json = false;
};

void add_check_options(CLI::App& command, CheckArguments& arguments);
void add_info_options(CLI::App& command, CheckArguments& arguments);

/// These return the exit code.
int run_check(const CheckArguments& arguments);
int run_stages(const CheckArguments& arguments);
int run_info(const CheckArguments& arguments);

}  // namespace geodrop
