// `geodrop plot`: pictures of a run directory.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace geodrop {

struct PlotArguments {
  std::string directory;
  std::string format = "svg";  ///< or png
};

void add_plot_options(CLI::App& command, PlotArguments& arguments);

/// Writes history.svg (or .png), geotube_PROBE.svg for each geotube probe, and section_PROBE.svg for each section probe
/// if a rigid body turns, into the directory. Returns the exit code.
int run_plot(const PlotArguments& arguments);

}  // namespace geodrop
