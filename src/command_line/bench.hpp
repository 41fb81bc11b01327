// geodrop bench: speed, instructions, growth.
#pragma once

#include <geodrop/bench/bench.hpp>

#include <CLI/CLI.hpp>

#include <string>

namespace geodrop {

struct BenchArguments {
  BenchOptions options;
  std::string output;
  int threads = 0;
  bool growth = false;
  bool instructions = false;
};

void add_bench_options(CLI::App& command, BenchArguments& arguments);

/// Returns the exit code.
int run_bench_command(const BenchArguments& arguments);

}  // namespace geodrop
