// `geodrop release`: the design formulas of a container that leaves a split barge, as a calculator.
#pragma once

#include <CLI/CLI.hpp>

#include <optional>
#include <string>

namespace geodrop {

/// Options as given, angles in degrees; nothing that was not given has a value.
struct ReleaseArguments {
  double perimeter, area, density, water_density;
  std::optional<double> hinge_radius, wall_slope, friction;
  std::optional<double> opening_angle, opening_width;
  std::optional<double> fall_height, strength;
  std::optional<double> volume, frontal_area, drag_coefficient;
  std::string output;  ///< directory
};

void add_release_options(CLI::App& command, ReleaseArguments& arguments);

/// Prints, and with --output writes release.csv and (of a barge) wall_force.csv. Returns the exit code.
int run_release(const ReleaseArguments& arguments);

}  // namespace geodrop
