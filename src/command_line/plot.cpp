#include "plot.hpp"

#include <geodrop/base/error.hpp>

#include "plot/column_chart.hpp"
#include "plot/outlines_chart.hpp"
#include "plot/run_charts.hpp"
#include "plot/sweep_chart.hpp"
#include "unfinished_runs.hpp"

#include <filesystem>
#include <iostream>

namespace geodrop {
namespace {

namespace fs = std::filesystem;

void draw(const Chart& chart, const fs::path& picture) {
  write_chart(chart, picture);
  std::cout << picture.string() << '\n';
}

/// The file that was asked for, or this one in the first directory.
fs::path picture_of(const PlotArguments& arguments, const std::string& stem) {
  if (!arguments.output.empty()) return arguments.output;
  return fs::path(arguments.directories.front()) / (stem + "." + arguments.format);
}

int plot_sweep(const PlotArguments& arguments) {
  const SweepChartOptions options{arguments.directories.front(), arguments.over, arguments.result};
  std::string stem = arguments.result + "_over_" + arguments.over.front();
  if (arguments.over.size() > 1) stem += "_and_" + arguments.over[1];
  draw(sweep_chart(options), picture_of(arguments, stem));
  return 0;
}

std::vector<fs::path> paths(const std::vector<std::string>& texts) { return {texts.begin(), texts.end()}; }

int plot_columns(const PlotArguments& arguments) {
  draw(column_chart({paths(arguments.directories), arguments.columns, arguments.against, paths(arguments.references)}),
       picture_of(arguments, "columns"));
  return 0;
}

int plot_outlines(const PlotArguments& arguments) {
  draw(outlines_chart(paths(arguments.directories)), picture_of(arguments, "outlines"));
  return 0;
}

}  // namespace

void add_plot_options(CLI::App& command, PlotArguments& arguments) {
  command.add_option("directory", arguments.directories, "run directories, or one of a sweep or an ensemble")
      ->required();
  auto* columns = command
                      .add_option("--columns", arguments.columns,
                                  "columns of history.csv, separated by commas; of all runs in one picture")
                      ->delimiter(',');
  command.add_option("--against", arguments.against, "with --columns: the column along x (default: time_s)")
      ->needs(columns);
  command
      .add_option("--reference", arguments.references,
                  "with --columns: a table (CSV) whose columns of the same unit are drawn beside, dashed")
      ->needs(columns);
  auto* over = command
                   .add_option("--over", arguments.over,
                               "of a sweep: the key along x, and after a comma one with a curve for each value")
                   ->delimiter(',')
                   ->expected(1, 2)
                   ->excludes(columns);
  auto* result = command.add_option("--result", arguments.result, "of a sweep: the result along y")->needs(over);
  over->needs(result);
  command
      .add_flag("--outlines", arguments.outlines,
                "outlines of geotextiles at the ends of runs, or of all runs of a sweep or an ensemble, in one picture")
      ->excludes(columns)
      ->excludes(over);
  command.add_option("--output", arguments.output, "with --columns, --over or --outlines: the picture, .svg or .png")
      ->check(CLI::Validator(
          [](const std::string& file) {
            const bool fits = file.ends_with(".svg") || file.ends_with(".png");
            return fits ? std::string() : "found " + file + "; allowed: a file .svg or .png";
          },
          "", "picture"));
  command.add_option("--format", arguments.format, "svg or png (default: svg)")->check(CLI::IsMember({"svg", "png"}));
}

int run_plot(const PlotArguments& arguments) {
  if (!arguments.over.empty()) return plot_sweep(arguments);
  if (arguments.outlines) return plot_outlines(arguments);
  tell_unfinished_runs(arguments.directories);
  if (!arguments.columns.empty()) return plot_columns(arguments);
  if (!arguments.output.empty())
    throw SceneError("geodrop plot", {{{},
                                       "--output " + arguments.output,
                                       "none of --columns, --over and --outlines",
                                       "one of them; without, the pictures of a run go to its directory",
                                       ProblemSource::elsewhere}});
  for (const fs::path directory : arguments.directories)
    for (const NamedChart& chart : run_charts(directory))
      draw(chart.chart, directory / (chart.stem + "." + arguments.format));
  return 0;
}

}  // namespace geodrop
