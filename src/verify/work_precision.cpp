#include "work_precision.hpp"

#include <algorithm>
#include <functional>
#include <set>

namespace geodrop {
namespace {

/// As many as there are colours that the eye can tell apart.
constexpr std::size_t curves_of_a_chart = 6;

bool is_drawn(const VerifyRow& row) {
  std::set<double> spacings;
  for (std::size_t i = 0; i < row.runs.size(); ++i)
    if (row.errors[i] > 0) spacings.insert(row.runs[i]->spacing);
  return !row.control && spacings.size() >= 3;
}

ChartPanel panel(const std::vector<const VerifyRow*>& rows, const std::string& title, const std::string& label,
                 const std::function<double(const VariantRun&)>& work) {
  ChartPanel panel{title, label, "error [-]", {}};
  panel.axes = Axes::logarithmic;
  for (const VerifyRow* row : rows) {
    ChartSeries series{row->scene + ", " + row->result, {}, row->errors, SeriesStyle::marked_line};
    for (const VariantRun* run : row->runs) series.x.push_back(work(*run));
    panel.series.push_back(series);
  }
  return panel;
}

Chart chart_of(const std::vector<const VerifyRow*>& rows) {
  constexpr double megabyte = 1e6;
  return {"Error against work",
          {panel(rows, "Wall time", "wall time [s]", [](const VariantRun& run) { return run.wall_seconds; }),
           panel(rows, "Particle-steps", "particles x steps [-]",
                 [](const VariantRun& run) { return run.particle_steps(); }),
           panel(rows, "Memory", "memory of the particles [MB]",
                 [](const VariantRun& run) { return run.bytes / megabyte; })},
          3};
}

}  // namespace

std::vector<Chart> work_precision_charts(const std::vector<VerifyRow>& rows) {
  std::vector<Chart> charts;
  std::vector<const VerifyRow*> drawn;
  for (const VerifyRow& row : rows)
    if (is_drawn(row)) drawn.push_back(&row);
  for (std::size_t first = 0; first < drawn.size(); first += curves_of_a_chart) {
    const std::size_t end = std::min(drawn.size(), first + curves_of_a_chart);
    charts.push_back(chart_of(
        {drawn.begin() + static_cast<std::ptrdiff_t>(first), drawn.begin() + static_cast<std::ptrdiff_t>(end)}));
  }
  return charts;
}

}  // namespace geodrop
