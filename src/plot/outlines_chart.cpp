#include "outlines_chart.hpp"

#include "base/text.hpp"
#include "csv_table.hpp"
#include "files/read_frames.hpp"

#include <geodrop/base/error.hpp>
#include <geodrop/reader/scene_reader.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <set>
#include <string>

namespace geodrop {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& where, const std::string& found, const std::string& allowed) {
  throw SceneError(where.string(), {{{}, "--outlines", found, allowed, ProblemSource::elsewhere}});
}

/// The run of a directory, or those of its manifest that are done.
std::vector<fs::path> runs_of(const fs::path& directory) {
  if (!fs::exists(directory / "manifest.csv")) return {directory};
  const TextTable table = read_text_table(directory / "manifest.csv", "the manifest of a sweep");
  const auto state = static_cast<std::size_t>(std::ranges::find(table.names, "state") - table.names.begin());
  std::vector<fs::path> runs;
  for (const auto& row : table.rows)
    if (state < row.size() && row[state] == "done") runs.push_back(directory / row.front());
  if (runs.empty()) refuse(directory, "no run that is done", "a sweep or an ensemble with runs that are done");
  return runs;
}

/// Membranes of a scene that bear tension: a skin only marks a surface.
std::set<std::uint32_t> geotextiles(const Scene& scene) {
  std::set<std::uint32_t> found;
  for (std::size_t m = 0; m < scene.membranes.size(); ++m)
    if (scene.membranes[m].axial_stiffness > 0) found.insert(static_cast<std::uint32_t>(m));
  return found;
}

/// Segments in their order, with a gap where the next one does not go on from the last.
ChartSeries outline_of(const MembraneSnapshot& lines, const std::set<std::uint32_t>& drawn) {
  constexpr double gap = std::numeric_limits<double>::quiet_NaN();
  ChartSeries series;
  const auto add = [&](std::uint32_t node) {
    series.x.push_back(lines.points[3 * node]);
    series.y.push_back(lines.points[3 * node + 1]);
  };
  for (std::size_t s = 0, last = lines.points.size(); s < lines.membrane.size(); ++s) {
    if (!drawn.contains(lines.membrane[s])) continue;
    const std::uint32_t from = lines.connectivity[2 * s], to = lines.connectivity[2 * s + 1];
    if (from != last && !series.x.empty()) series.x.push_back(gap), series.y.push_back(gap);
    if (from != last) add(from);
    add(to);
    last = to;
  }
  return series;
}

/// Where an outline is, for a point in the picture: the mean of its nodes.
void add_middle(const ChartSeries& outline, ChartSeries& middles) {
  double x = 0, y = 0, count = 0;
  for (std::size_t i = 0; i < outline.x.size(); ++i) {
    if (std::isnan(outline.x[i])) continue;
    x += outline.x[i];
    y += outline.y[i];
    ++count;
  }
  middles.x.push_back(x / count);
  middles.y.push_back(y / count);
}

}  // namespace

Chart outlines_chart(const std::vector<fs::path>& directories) {
  ChartPanel panel{"", "x [m]", "y [m]", {}, Aspect::equal};
  ChartSeries middles{"middle of an outline", {}, {}, SeriesStyle::points};
  std::string title;
  double first = std::numeric_limits<double>::infinity(), last = -first;
  for (const fs::path& directory : directories) {
    for (const fs::path& run : runs_of(directory)) {
      const Scene scene = read_scene(run / "scene.toml");
      if (scene.dimension != 2) refuse(run, "a scene in space", "scenes in the plane; snapshot draws those in space");
      const std::set<std::uint32_t> drawn = geotextiles(scene);
      if (drawn.empty()) refuse(run, "no membrane with a stiffness", "runs with a geotextile");
      const std::vector<double> times = frame_times(run);
      panel.series.push_back(outline_of(read_frame(run, times.size() - 1).membranes, drawn));
      add_middle(panel.series.back(), middles);
      if (title.empty()) title = scene.title;
      first = std::min(first, times.back());
      last = std::max(last, times.back());
    }
  }
  panel.series.push_back(middles);
  const auto text = [](double t) { return format_number(t, 3); };
  Chart chart{title, {panel}, 1};
  chart.notes.push_back(std::to_string(panel.series.size() - 1) + " runs, outlines at t = " + text(first) +
                        (text(first) != text(last) ? " to " + text(last) : "") + " s");
  return chart;
}

}  // namespace geodrop
