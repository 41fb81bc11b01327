#include "column_chart.hpp"

#include "base/nearest_name.hpp"
#include "base/units.hpp"
#include "csv_table.hpp"
#include "panel_unit.hpp"
#include "run_charts.hpp"

#include <geodrop/base/error.hpp>

#include <algorithm>
#include <iterator>

namespace geodrop {
namespace {

/// The nearest column, or some that have the name in theirs.
std::string column_advice(const CsvTable& table, const std::string& name) {
  constexpr std::size_t most = 6;
  const std::string nearest = nearest_name(name, table.names);
  if (!nearest.empty()) return "a column of it; the nearest is \"" + nearest + '"';
  std::vector<std::string> with;
  std::ranges::copy_if(table.names, std::back_inserter(with),
                       [&](const std::string& column) { return column.find(name) != std::string::npos; });
  if (with.empty()) return "a column of it: its first line names them";
  std::string text = "a column of it, as " + with.front();
  for (std::size_t i = 1; i < std::min(with.size(), most); ++i) text += ", " + with[i];
  return with.size() > most ? text + ", ..." : text;
}

const std::vector<double>& column_of(const CsvTable& table, const std::string& name) {
  if (table.has(name)) return table.column(name);
  throw SceneError(
      table.file,
      {{{}, "--columns", "no column \"" + name + '"', column_advice(table, name), ProblemSource::elsewhere}});
}

/// "-" for numbers without unit.
std::string unit_of_axis(const std::string& column) {
  const std::string unit = unit_of_name(column);
  return unit.empty() || unit == "1" ? "-" : unit;
}

/// The curves of columns of one unit.
struct PanelOfUnit {
  std::string unit;
  ChartPanel panel;
};

/// The panel of a unit, made when it is first asked for.
ChartPanel& panel_of(std::vector<PanelOfUnit>& panels, const std::string& unit, const std::string& x_label) {
  const auto found = std::ranges::find(panels, unit, &PanelOfUnit::unit);
  if (found != panels.end()) return found->panel;
  return panels.emplace_back(PanelOfUnit{unit, {"", x_label, "", {}}}).panel;
}

/// "RUN: QUANTITY" as "RUN" where all curves are of one quantity, which is what the axis then has; else it has values.
std::string name_by_run(ChartPanel& panel) {
  const auto split = [](const std::string& label) {
    const std::size_t colon = label.find(": ");
    return colon == std::string::npos ? std::pair{std::string(), label}
                                      : std::pair{label.substr(0, colon), label.substr(colon + 2)};
  };
  std::string quantity = split(panel.series.front().label).second;
  for (const ChartSeries& series : panel.series)
    if (split(series.label).second != quantity) return "value";
  for (ChartSeries& series : panel.series) series.label = split(series.label).first;
  return quantity;
}

}  // namespace

Chart column_chart(const ColumnChartOptions& options) {
  std::vector<PanelOfUnit> panels;
  const std::string x_label = in_words(options.against) + " [" + unit_of_axis(options.against) + "]";
  for (const auto& run : options.runs) {
    const CsvTable table = read_history(run);
    const std::string name = std::filesystem::path(run / "").parent_path().filename().string();
    for (const std::string& column : options.columns)
      panel_of(panels, unit_of_axis(column), x_label)
          .series.push_back({(options.runs.size() > 1 ? name + ": " : "") + in_words(column),
                             column_of(table, options.against), column_of(table, column)});
  }
  for (const auto& file : options.references) {
    const CsvTable table = read_csv(file);
    for (const std::string& column : table.names) {
      const auto found = std::ranges::find(panels, unit_of_axis(column), &PanelOfUnit::unit);
      if (column == options.against || found == panels.end()) continue;
      found->panel.series.push_back({file.stem().string() + ": " + in_words(column), column_of(table, options.against),
                                     table.column(column), SeriesStyle::dashed});
    }
  }
  Chart chart;
  for (auto& [unit, panel] : panels) {
    set_y_unit(panel, name_by_run(panel), unit);
    chart.panels.push_back(panel);
  }
  chart.columns = chart.panels.size() > 1 ? 2 : 1;
  return chart;
}

}  // namespace geodrop
