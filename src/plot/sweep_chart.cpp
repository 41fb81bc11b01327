#include "sweep_chart.hpp"

#include "base/nearest_name.hpp"
#include "base/units.hpp"
#include "csv_table.hpp"

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

/// Large numbers along x in thousands or millions, so that they stand side by side.
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
  const std::string unit = unit_of_name(options.result);
  ChartPanel panel{"", options.over[0], options.result + (unit.empty() ? "" : " [" + unit + "]"), {}};
  for (const std::string& value : order) {
    ChartSeries& series = curves[value];
    sort_by_x(series);
    if (order.size() > 1 && order.size() <= most_curves) series.label = options.over[1] + " = " + value;
    series.style = scattered ? SeriesStyle::points : SeriesStyle::marked_line;
    panel.series.push_back(series);
  }
  scale_x(panel);
  return {options.directory.string(), {panel}, 1};
}

}  // namespace geodrop
