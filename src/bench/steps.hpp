// `bench --steps`: a fixed number of steps of each benchmark, told in lines that programs read.
#pragma once

#include "measure_speed.hpp"

#include <geodrop/bench/bench.hpp>

#include <optional>

namespace geodrop {

/// What another process said of its steps.
struct StepReport {
  std::string build;  ///< compiler and instruction set of the kernels
  std::vector<StepTime> times;
};

/// Whether a benchmark is among those that --only asks for: part of its name, or = and its whole name.
bool selected(const BenchOptions& options, const std::string& name);

/// Says that --only asks for none, with the nearest; the exit code.
int no_benchmark(const BenchOptions& options);

/// Whether the row of a scene benchmark can be had; if its file is missing, says so.
std::optional<Scene> scene_of(const SceneBenchmark& bench, const BenchOptions& options);

/// Compiler of this program, and the instruction set that its kernels have chosen.
std::string build_name();

/// Reads what `run_steps` prints; throws std::runtime_error with the line that it does not understand.
StepReport parse_steps(const std::string& text);

}  // namespace geodrop
