#include "sweep_chart.hpp"

#include "base/nearest_name.hpp"
#include "base/units.hpp"
#include "csv_table.hpp"
#include "files/run_record.hpp"
#include "panel_unit.hpp"
#include "reader/key_units.hpp"

#include <geodrop/base/error.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace geodrop {
namespace {

using Names = std::vector<std::string>;

[[noreturn]] void refuse(const TextTable& table, const std::string& option, const std::string& found,
                         const std::string& allowed) {
  throw SceneError(table.file, {{{}, option, found, allowed, ProblemSource::elsewhere}});
}

/// Where a name stands among the columns from `first` to `last`, exclusive.
std::size_t find(const TextTable& table, const std::string& option, const std::string& name,
                 std::pair<std::size_t, std::size_t> part) {
  const auto begin = table.names.begin();
  const Names known(begin + static_cast<std::ptrdiff_t>(part.first), begin + static_cast<std::ptrdiff_t>(part.second));
  const auto found = std::ranges::find(known, name);
  if (found == known.end()) refuse(table, option, '"' + name + '"', name_advice(name, known, "columns"));
  return part.first + static_cast<std::size_t>(found - known.begin());
}

double number(const TextTable& table, const std::string& text, const std::string& option) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0') refuse(table, option, '"' + text + '"', "a key with numbers, or it as the second");
  return value;
}

void sort_by_x(ChartSeries& series) {
  std::vector<std::pair<double, double>> points;
  for (std::size_t i = 0; i < series.x.size(); ++i) points.emplace_back(series.x[i], series.y[i]);
  std::ranges::sort(points);
  for (std::size_t i = 0; i < points.size(); ++i) std::tie(series.x[i], series.y[i]) = points[i];
}

/// Large numbers along x in thousands or millions, so that they stand side by side; of a key without a unit.
void scale_x(ChartPanel& panel) {
  constexpr double long_number = 1e5, kilo = 1e3, mega = 1e6;
  double largest = 0;
  for (const ChartSeries& series : panel.series)
    for (const double x : series.x) largest = std::max(largest, std::abs(x));
  if (largest < long_number) return;
  const double unit = largest < mega ? kilo : mega;
  for (ChartSeries& series : panel.series)
    for (double& x : series.x) x /= unit;
  panel.x_label += unit == kilo ? " [1e3]" : " [1e6]";
}

void name_axes(ChartPanel& panel, const SweepChartOptions& options) {
  const std::string& key = options.over[0];
  const std::string unit(unit_of_path(key));
  if (unit.empty()) {
    panel.x_label = key;
    scale_x(panel);
  } else {
    set_x_unit(panel, key, unit);
  }
  set_y_unit(panel, in_words(options.result), unit_of_name(options.result));
}

/// "grid.spacing = 0.25 m"
std::string with_unit(const std::string& key, const std::string& value) {
  const std::string unit(unit_of_path(key));
  return key + " = " + value + (unit.empty() || unit == "-" ? "" : " " + unit);
}

/// That of the scene, where a run has told it; else the directory.
std::string title_of(const std::filesystem::path& directory, const TextTable& manifest) {
  for (const Names& row : manifest.rows)
    if (const auto record = find_run_record(directory / row[0]); record && !record->title.empty()) return record->title;
  return directory.string();
}

}  // namespace

Chart sweep_chart(const SweepChartOptions& options) {
  const TextTable table = read_text_table(options.directory / "manifest.csv", "the manifest of a sweep");
  const auto state = static_cast<std::size_t>(std::ranges::find(table.names, "state") - table.names.begin());
  if (state + 2 > table.names.size()) refuse(table, "", "no column \"state\"", "the manifest of a sweep");
  const std::size_t x = find(table, "--over", options.over.at(0), {1, state});
  const std::size_t curve = options.over.size() > 1 ? find(table, "--over", options.over[1], {1, state}) : state;
  const std::size_t y = find(table, "--result", options.result, {state + 2, table.names.size()});

  Names order;
  std::map<std::string, ChartSeries> curves;
  std::set<std::string> varies;  // values of what is not drawn
  for (const Names& row : table.rows) {
    if (row[state] != "done") continue;
    if (!curves.contains(row[curve])) order.push_back(row[curve]);
    ChartSeries& series = curves[row[curve]];
    series.x.push_back(number(table, row[x], "--over"));
    series.y.push_back(number(table, row[y], "--result"));
    std::string rest;
    for (std::size_t key = 1; key < state; ++key)
      if (key != x && key != curve) rest += row[key] + ',';
    varies.insert(rest);
  }
  if (order.empty()) refuse(table, "", "no run that is done", "a sweep with results");
  constexpr std::size_t most_curves = 12;
  const bool scattered = varies.size() > 1 || order.size() > most_curves;
  ChartPanel panel{"", "", "", {}};
  for (const std::string& value : order) {
    ChartSeries& series = curves[value];
    sort_by_x(series);
    if (order.size() > 1 && order.size() <= most_curves) series.label = with_unit(options.over[1], value);
    series.style = scattered ? SeriesStyle::points : SeriesStyle::marked_line;
    panel.series.push_back(series);
  }
  name_axes(panel, options);
  return {title_of(options.directory, table), {panel}, 1};
}

}  // namespace geodrop
