// history.csv to one picture with a panel for each kind of column.
#include "plot.hpp"

#include "plot/chart.hpp"
#include "plot/csv_table.hpp"

#include <geodrop/error.hpp>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <vector>

namespace geodrop {
namespace {

enum class Measure { value, change };  ///< as it is, or since the first row

/// The columns that a panel shows: their names begin so and end in one of these, the unit stripped in the legend.
struct Kind {
  std::string title, y_label, unit, beginning;
  std::vector<std::string> endings;
  Measure measure;
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all{
      {"Position", "position [m]", "_m", "", {".position_x_m", ".position_y_m", ".position_z_m"}, Measure::value},
      {"Velocity",
       "velocity [m/s]",
       "_m_s",
       "",
       {".velocity_x_m_s", ".velocity_y_m_s", ".velocity_z_m_s"},
       Measure::value},
      {"Membrane tension", "tension [N/m]", "_N_m", "", {".tension_max_N_m", ".tension_mean_N_m"}, Measure::value},
      // Of a deep basin all would be flat lines beside its potential energy.
      {"Energy since the start", "change of energy [J]", "_J", "energy.", {"_J"}, Measure::change}};
  return all;
}

bool shows(const Kind& kind, const std::string& column) {
  return column.starts_with(kind.beginning) &&
         std::any_of(kind.endings.begin(), kind.endings.end(),
                     [&](const std::string& ending) { return column.ends_with(ending); });
}

ChartSeries make_series(const CsvTable& table, const std::string& name, const Kind& kind) {
  const std::size_t begin = kind.beginning.size();
  ChartSeries series{name.substr(begin, name.size() - kind.unit.size() - begin), table.column("time_s"),
                     table.column(name)};
  if (kind.measure == Measure::value) return series;
  const double first = series.y.front();
  for (double& value : series.y) value -= first;
  return series;
}

/// A panel for every kind that the run has columns of.
Chart history_chart(const CsvTable& table, const std::string& title) {
  Chart chart{title, {}, 2};
  for (const Kind& kind : kinds()) {
    ChartPanel panel{kind.title, "time [s]", kind.y_label, {}};
    for (const std::string& name : table.names)
      if (shows(kind, name)) panel.series.push_back(make_series(table, name, kind));
    if (!panel.series.empty()) chart.panels.push_back(panel);
  }
  return chart;
}

}  // namespace

void add_plot_options(CLI::App& command, PlotArguments& arguments) {
  command.add_option("directory", arguments.directory, "run directory, with a history.csv in it")->required();
  command.add_option("--format", arguments.format, "svg or png (default: svg)")->check(CLI::IsMember({"svg", "png"}));
}

int run_plot(const PlotArguments& arguments) {
  const std::filesystem::path directory = arguments.directory, history = directory / "history.csv";
  const auto refuse = [&](const std::string& found) {
    throw SceneError(history.string(), {{{}, "", found, "the history of a run", ProblemSource::elsewhere}});
  };
  if (!std::filesystem::is_regular_file(history)) refuse("no such file");
  const CsvTable table = read_csv(history);
  if (table.rows() == 0) refuse("no row of numbers");
  const Chart chart = history_chart(table, directory.string());
  if (chart.panels.empty()) refuse("no column that is drawn");
  const std::filesystem::path picture = directory / ("history." + arguments.format);
  write_chart(chart, picture);
  std::cout << picture.string() << '\n';
  return 0;
}

}  // namespace geodrop
