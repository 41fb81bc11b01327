#include "column_chart.hpp"

#include "base/nearest_name.hpp"
#include "base/units.hpp"
#include "csv_table.hpp"
#include "panel_unit.hpp"
#include "run_charts.hpp"

#include <geodrop/base/error.hpp>

#include <algorithm>

namespace geodrop {
namespace {

const std::vector<double>& column_of(const CsvTable& table, const std::string& name) {
  if (std::ranges::find(table.names, name) != table.names.end()) return table.column(name);
  const std::string nearest = nearest_name(name, table.names);
  throw SceneError(table.file,
                   {{{},
                     "--columns",
                     "no column \"" + name + '"',
                     nearest.empty() ? "a column of it" : "a column of it; the nearest is \"" + nearest + '"',
                     ProblemSource::elsewhere}});
}

std::string label(const std::string& quantity, const std::string& unit) {
  return quantity + " [" + (unit.empty() ? "-" : unit == "1" ? "-" : unit) + "]";
}

/// The panel of a unit, made when it is first asked for.
ChartPanel& panel_of(Chart& chart, const std::string& unit, const std::string& x_label) {
  const std::string y_label = label("value", unit);
  const auto found = std::ranges::find(chart.panels, y_label, &ChartPanel::y_label);
  if (found != chart.panels.end()) return *found;
  return chart.panels.emplace_back(ChartPanel{"", x_label, y_label, {}});
}

/// "RUN: QUANTITY" as "RUN" where all curves are of one quantity, which the axis names then.
void name_by_run(ChartPanel& panel) {
  const auto split = [](const std::string& label) {
    const std::size_t colon = label.find(": ");
    return colon == std::string::npos ? std::pair{std::string(), label}
                                      : std::pair{label.substr(0, colon), label.substr(colon + 2)};
  };
  const std::string quantity = split(panel.series.front().label).second;
  for (const ChartSeries& series : panel.series)
    if (split(series.label).second != quantity) return;
  for (ChartSeries& series : panel.series) series.label = split(series.label).first;
  panel.y_label = quantity + panel.y_label.substr(panel.y_label.find(" ["));
}

}  // namespace

Chart column_chart(const ColumnChartOptions& options) {
  Chart chart;
  const std::string x_label = label(in_words(options.against), unit_of_name(options.against));
  for (const auto& run : options.runs) {
    const CsvTable table = read_history(run);
    const std::string name = std::filesystem::path(run / "").parent_path().filename().string();
    for (const std::string& column : options.columns)
      panel_of(chart, unit_of_name(column), x_label)
          .series.push_back({(options.runs.size() > 1 ? name + ": " : "") + in_words(column),
                             column_of(table, options.against), column_of(table, column)});
  }
  for (const auto& file : options.references) {
    const CsvTable table = read_csv(file);
    for (const std::string& column : table.names) {
      const std::string y_label = label("value", unit_of_name(column));
      const auto panel = std::ranges::find(chart.panels, y_label, &ChartPanel::y_label);
      if (column == options.against || panel == chart.panels.end()) continue;
      panel->series.push_back({file.stem().string() + ": " + in_words(column), column_of(table, options.against),
                               table.column(column), SeriesStyle::dashed});
    }
  }
  for (ChartPanel& panel : chart.panels) {
    name_by_run(panel);
    const std::size_t unit = panel.y_label.find(" [");
    set_y_unit(panel, panel.y_label.substr(0, unit), panel.y_label.substr(unit + 2, panel.y_label.size() - unit - 3));
  }
  chart.columns = chart.panels.size() > 1 ? 2 : 1;
  return chart;
}

}  // namespace geodrop
