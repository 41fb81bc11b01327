// `geodrop verify`: the cases that know their reference, beside it.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace geodrop {

struct VerifyArguments {
  std::vector<std::string> scenes;
  bool quick = false;  ///< the default
  bool full = false;
  std::string only, output = "runs/verify", page;
};

void add_verify_options(CLI::App& command, VerifyArguments& arguments);

/// Returns the exit code: 0 all met or known to be missed, 1 a target missed, 2 no case, 75 stopped.
int run_verify(const VerifyArguments& arguments, int threads);

}  // namespace geodrop
