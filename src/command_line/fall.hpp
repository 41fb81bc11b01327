// `geodrop fall`: the closed-form fall of a container in water, as a calculator beside the simulation.
#pragma once

#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <vector>

namespace geodrop {

/// Options as given; nothing that was not given has a value.
struct FallArguments {
  std::vector<double> semi_axes;  ///< along the fall, across it
  std::optional<double> perimeter, area;
  double density, water_density;
  std::optional<double> air;
  std::optional<double> drag_coefficient, terminal_velocity, width;
  std::optional<double> fall_height, stiffness;
  std::string output;  ///< directory
};

void add_fall_options(CLI::App& command, FallArguments& arguments);

/// Prints, and with --output writes fall.csv and (of a drag) path.csv. Returns the exit code.
int run_fall(const FallArguments& arguments);

}  // namespace geodrop
