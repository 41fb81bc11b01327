// history.csv to one picture, each geotube probe to one beside the exact tube, each section probe to one against the
// angle of what opens.
#include "run_charts.hpp"

#include "files/run_record.hpp"
#include "history_chart.hpp"
#include "keys/plain_values.hpp"
#include "panel_unit.hpp"
#include "reference_lines.hpp"

#include <geodrop/base/error.hpp>
#include <geodrop/base/input_file.hpp>
#include <geodrop/reader/scene_reader.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace geodrop {
namespace {

/// Simulated and exact outline, pressure against height, tension along the membrane of the geotube of one probe.
Chart geotube_chart(const std::filesystem::path& directory, const std::string& stem, const std::string& title) {
  const auto table = [&](const std::string& which) { return read_csv(directory / (stem + "_" + which + ".csv")); };
  const auto along_membrane = [](const CsvTable& outline) {  // lengths
    std::vector<double> s{0.0};
    const auto &x = outline.column("x_m"), &y = outline.column("y_m");
    for (std::size_t k = 1; k < x.size(); ++k) s.push_back(s.back() + std::hypot(x[k] - x[k - 1], y[k] - y[k - 1]));
    return s;
  };
  const CsvTable outline = table("outline"), pressure = table("pressure");
  ChartPanel shape{"Outline", "x [m]", "y [m]", {}, Aspect::equal};
  ChartPanel pressures{"Pressure of the fill", "", "y [m]", {}};
  ChartPanel tension{"Tension", "along the membrane [m]", "", {}};
  shape.series.push_back({"simulated", outline.column("x_m"), outline.column("y_m")});
  pressures.series.push_back(
      {"particles", pressure.column("pressure_Pa"), pressure.column("height_m"), SeriesStyle::points});
  tension.series.push_back({"simulated", along_membrane(outline), outline.column("tension_N_m")});
  if (std::filesystem::exists(directory / (stem + "_exact.csv"))) {
    const CsvTable exact = table("exact");
    shape.series.push_back({"exact", exact.column("x_m"), exact.column("y_m"), SeriesStyle::dashed});
    pressures.series.push_back({"exact", exact.column("pressure_Pa"), exact.column("y_m"), SeriesStyle::dashed});
    tension.series.push_back({"exact", along_membrane(exact), exact.column("tension_N_m"), SeriesStyle::dashed});
  }
  set_x_unit(pressures, "pressure", "Pa");
  set_y_unit(tension, "tension", "N/m");
  return {title, {shape, pressures, tension}, 2};
}

/// What the geotube probes of a run have left, as "geotube_PROBE".
std::vector<std::string> geotube_stems(const std::filesystem::path& directory) {
  const std::string ending = "_outline.csv";
  std::vector<std::string> stems;
  for (const auto& entry : std::filesystem::directory_iterator(directory)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("geotube_") && name.ends_with(ending))
      stems.push_back(name.substr(0, name.size() - ending.size()));
  }
  std::sort(stems.begin(), stems.end());
  return stems;
}

// --- Section forces against the opening of a barge -------------------------------------------------------------------

const std::string rotation_ending = ".rotation_deg";

/// Columns that end so, without the ending.
std::vector<std::string> names_of(const CsvTable& table, const std::string& ending) {
  std::vector<std::string> names;
  for (const std::string& column : table.names)
    if (column.ends_with(ending)) names.push_back(column.substr(0, column.size() - ending.size()));
  return names;
}

double turn_of(const CsvTable& table, const std::string& name) {
  const std::vector<double>& angle = table.column(name + rotation_ending);
  const auto [least, most] = std::minmax_element(angle.begin(), angle.end());
  return *most - *least;
}

/// Rigid bodies that turn at least almost as far as the one that turns most.
std::vector<std::string> most_turned(const CsvTable& table) {
  constexpr double almost = 0.99;
  std::vector<std::string> names = names_of(table, ".displacement_x_m");  // which bodies of particles do not have
  std::erase_if(names, [&](const std::string& name) {
    return std::count(table.names.begin(), table.names.end(), name + rotation_ending) == 0;
  });
  double most = 0;
  for (const std::string& name : names) most = std::max(most, turn_of(table, name));
  std::erase_if(names, [&](const std::string& name) { return most == 0 || turn_of(table, name) < almost * most; });
  return names;
}

/// Rows in which an angle differs from that before or after.
std::vector<std::size_t> rows_that_turn(const std::vector<double>& angle) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < angle.size(); ++i) {
    const bool turned = i > 0 && angle[i] != angle[i - 1], will_turn = i + 1 < angle.size() && angle[i] != angle[i + 1];
    if (turned || will_turn) rows.push_back(i);
  }
  return rows;
}

/// Of several barges the one that opens the container of the probe: its geotextile is tightest meanwhile.
std::string barge_of(const CsvTable& table, const std::string& probe, const std::vector<std::string>& rigids) {
  const std::vector<double>& force = table.column(probe + ".membrane_force_N_m");
  std::string found = rigids.front();
  double most = 0;
  for (const std::string& rigid : rigids)
    for (const std::size_t i : rows_that_turn(table.column(rigid + rotation_ending)))
      if (force[i] > most) {
        found = rigid;
        most = force[i];
      }
  return found;
}

/// Force of the soil, of the geotextile, and their difference, which the walls bear.
Chart section_chart(const CsvTable& table, const std::string& probe, const std::string& rigid,
                    const std::string& title) {
  const std::vector<double>& angle = table.column(rigid + rotation_ending);
  ChartSeries soil{"soil", {}, {}}, geotextile{"geotextile", {}, {}}, difference{"difference", {}, {}};
  difference.style = SeriesStyle::dashed;
  for (const std::size_t i : rows_that_turn(angle)) {
    for (ChartSeries* series : {&soil, &geotextile, &difference}) series->x.push_back(std::abs(angle[i]));
    soil.y.push_back(table.column(probe + ".soil_force_N_m")[i]);
    geotextile.y.push_back(table.column(probe + ".membrane_force_N_m")[i]);
    difference.y.push_back(soil.y.back() - geotextile.y.back());
  }
  ChartPanel panel{
      "Forces across the section " + probe, "angle of " + rigid + " [deg]", "", {soil, geotextile, difference}};
  set_y_unit(panel, "force", "N/m");
  return {title, {panel}, 1};
}

/// Probes of which both forces were recorded.
std::vector<std::string> section_probes(const CsvTable& table) {
  std::vector<std::string> probes = names_of(table, ".soil_force_N_m");
  std::erase_if(probes, [&](const std::string& probe) {
    return std::count(table.names.begin(), table.names.end(), probe + ".membrane_force_N_m") == 0;
  });
  return probes;
}

/// What the scene of a run tells of its charts; a history alone has its directory for a title.
struct About {
  std::string title;
  std::vector<ReferenceLine> references;
};
About about_run(const std::filesystem::path& directory, const TensionStrength& factors) {
  const std::filesystem::path file = directory / "scene.toml";
  if (!std::filesystem::exists(file)) return {directory.string(), {}};
  const Scene scene = read_scene(file);
  const std::optional<RunRecord> record = find_run_record(directory);
  const auto time_of = [&](const std::string& result) {
    return record ? record->result(result) : std::numeric_limits<double>::quiet_NaN();
  };
  return {scene.title, reference_lines(scene, factors, time_of)};
}

}  // namespace

CsvTable read_history(const std::filesystem::path& directory) {
  const std::filesystem::path history = directory / "history.csv";
  const auto refuse = [&](const std::string& found) {
    throw SceneError(history.string(), {{{}, "", found, "the history of a run", ProblemSource::elsewhere}});
  };
  if (const std::string fault = open_input(history).fault; !fault.empty()) refuse(fault);
  CsvTable table = read_csv(history, LastRow::whole);
  if (table.rows() == 0) refuse("no row of numbers");
  return table;
}

std::vector<NamedChart> run_charts(const std::filesystem::path& directory, const TensionStrength& factors) {
  const CsvTable table = read_history(directory);
  std::vector<NamedChart> charts;
  const About about = about_run(directory, factors);
  const Chart chart = history_chart(table, about.title, about.references);
  const std::vector<std::string> rigids = most_turned(table);
  const std::vector<std::string> probes = rigids.empty() ? std::vector<std::string>{} : section_probes(table);
  const auto refuse = [&](const std::string& found) {
    throw SceneError(table.file, {{{}, "", found, "the history of a run", ProblemSource::elsewhere}});
  };
  if (chart.panels.empty() && probes.empty()) refuse("no column that is drawn");
  for (const std::string& probe : probes)  // a part of the name of a file
    if (!is_identifier(probe)) refuse("a probe named \"" + probe + '"');
  if (!chart.panels.empty()) charts.push_back({"history", chart});
  for (const std::string& probe : probes)
    charts.push_back({"section_" + probe, section_chart(table, probe, barge_of(table, probe, rigids), about.title)});
  for (const std::string& stem : geotube_stems(directory))
    charts.push_back({stem, geotube_chart(directory, stem, about.title)});
  return charts;
}

}  // namespace geodrop
