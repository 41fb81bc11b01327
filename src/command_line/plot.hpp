// `geodrop plot`: pictures of runs and of sweeps.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace geodrop {

struct PlotArguments {
  std::vector<std::string> directories;
  std::vector<std::string> columns;     ///< of history.csv; empty: the standard pictures
  std::string against = "time_s";       ///< the column along x
  std::vector<std::string> references;  ///< tables to compare columns with
  std::vector<std::string> over;        ///< keys of a sweep
  std::string result;                   ///< of a sweep
  bool outlines = false;                ///< of membranes at the ends of runs, or of those of a sweep
  std::string output;                   ///< of a picture of columns or of a sweep
  std::string format = "svg";           ///< or png
};

void add_plot_options(CLI::App& command, PlotArguments& arguments);

/// Writes the standard pictures of each run into its directory (history.svg, geotube_PROBE.svg, section_PROBE.svg); or
/// columns.svg of chosen columns of all runs, outlines.svg of their ends, or RESULT_over_KEY.svg of a sweep, into the
/// first directory. Returns the exit code.
int run_plot(const PlotArguments& arguments);

}  // namespace geodrop
