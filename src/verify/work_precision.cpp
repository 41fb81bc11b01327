#include "work_precision.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <set>

namespace geodrop {
namespace {

/// As many as there are colours that the eye can tell apart.
constexpr std::size_t curves_of_a_chart = 6;

std::size_t spacings_of(const VerifyRow& row) {
  std::set<double> spacings;
  for (std::size_t i = 0; i < row.runs.size(); ++i)
    if (row.errors[i] > 0) spacings.insert(row.runs[i]->spacing);
  return row.control ? 0 : spacings.size();
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

using RowPointers = std::vector<const VerifyRow*>;

Chart chart_of(const RowPointers& rows, const std::string& title) {
  constexpr double megabyte = 1e6;
  return {title,
          {panel(rows, "Wall time", "wall time [s]", [](const VariantRun& run) { return run.wall_seconds; }),
           panel(rows, "Particle-steps", "particles x steps [-]",
                 [](const VariantRun& run) { return run.particle_steps(); }),
           panel(rows, "Memory", "memory of the particles [MB]",
                 [](const VariantRun& run) { return run.bytes / megabyte; })},
          3};
}

}  // namespace

std::vector<WorkPicture> work_precision_pictures(const std::vector<VerifyRow>& rows) {
  std::map<std::string, RowPointers> of_scene;
  std::set<std::string> fine;
  for (const VerifyRow& row : rows) {
    const std::size_t spacings = spacings_of(row);
    if (spacings >= 3) of_scene[row.scene].push_back(&row);
    if (spacings >= 4) fine.insert(row.scene);
  }
  std::vector<WorkPicture> pictures;
  RowPointers others;
  for (const auto& [scene, drawn] : of_scene) {
    if (fine.contains(scene))
      pictures.push_back({"work_precision_" + scene, chart_of(drawn, scene + ": error against work")});
    else
      others.insert(others.end(), drawn.begin(), drawn.end());
  }
  for (std::size_t first = 0, number = 1; first < others.size(); first += curves_of_a_chart, ++number) {
    const auto begin = others.begin() + static_cast<std::ptrdiff_t>(first);
    const auto count = static_cast<std::ptrdiff_t>(std::min(curves_of_a_chart, others.size() - first));
    pictures.push_back(
        {"work_precision_others_" + std::to_string(number), chart_of({begin, begin + count}, "Error against work")});
  }
  return pictures;
}

}  // namespace geodrop
