// A list of results for the terminal and the CSV, an outline for the picture.
#include "geotube_report.hpp"

#include "base/atomic_file.hpp"
#include "base/text.hpp"
#include "plot/chart.hpp"
#include "result_directory.hpp"
#include "result_list.hpp"

#include <cmath>

namespace geodrop {
namespace {

namespace fs = std::filesystem;

constexpr int digits = 10;

ResultList list_results(const Geotube& tube, const std::optional<TensionStrength>& strength) {
  ResultList list{{"area", "area_m2", "m2", tube.area},
                  {"height", "height_m", "m", tube.height},
                  {"width", "width_m", "m", tube.width},
                  {"height / width", "height_to_width_ratio", "-", tube.height / tube.width},
                  {"base width", "base_width_m", "m", tube.base_width},
                  {"level of the width", "width_level_m", "m", tube.width_level},
                  {"membrane length", "length_m", "m", tube.length},
                  {"membrane strain", "strain_ratio", "-", tube.strain},
                  {"top pressure", "pressure_top_Pa", "Pa", tube.top_pressure},
                  {"bottom pressure", "pressure_bottom_Pa", "Pa", tube.bottom_pressure},
                  {"fill pressure top", "fill_pressure_top_Pa", "Pa", tube.fill_pressure_top},
                  {"fill pressure bottom", "fill_pressure_bottom_Pa", "Pa", tube.fill_pressure_bottom},
                  {"tension", "tension_N_m", "N/m", tube.tension}};
  if (!strength) return list;
  const double allowable = allowable_tension(*strength);
  list.push_back({"allowable tension", "allowable_tension_N_m", "N/m", allowable});
  list.push_back({"factor of safety", "factor_of_safety_ratio", "-", allowable / tube.tension});
  list.push_back({"utilisation", "utilisation_ratio", "-", tube.tension / allowable});
  return list;
}

ResultList list_inputs(const GeotubeInput& input) {
  return {{"perimeter", "perimeter_m", "m", input.perimeter},
          {"unit weight", "unit_weight_N_m3", "N/m3", input.unit_weight},
          {"axial stiffness", "stiffness_N_m", "N/m", input.stiffness},
          {"water level", "water_level_m", "m", input.water.level},
          {"water unit weight", "water_unit_weight_N_m3", "N/m3", input.water.unit_weight}};
}

// --- Text ------------------------------------------------------------------------------------------------------------

using Lines = std::vector<std::vector<std::string>>;

Lines input_lines(const GeotubeReport& report) {
  Lines lines;
  for (const ListedNumber& given : list_inputs(report.input)) {
    const bool is_stiffness = given.column == "stiffness_N_m";
    if (is_stiffness && !std::isfinite(given.value)) {
      lines.push_back({given.name, "not given", "inextensible"});
    } else if (given.column == "water_level_m" && given.value == 0) {
      lines.push_back({given.name, "none", "dry"});
      break;
    } else {
      lines.push_back({given.name, format_number(given.value, digits), given.unit});
    }
  }
  return lines;
}

std::string strength_text(const TensionStrength& strength) {
  Lines lines{{"strength", format_number(strength.strength), "N/m"}};
  const auto add = [&](const char* name, const std::optional<double>& factor) {
    lines.push_back({name, factor ? format_number(*factor) : "not given: 1", "-"});
  };
  add("seam efficiency", strength.seam_efficiency);
  add("reduction, installation", strength.installation);
  add("reduction, creep", strength.creep);
  add("reduction, durability", strength.durability);
  add("reduction, seam", strength.seam);
  return format_table(lines, "lrl");
}

std::string one_tube_text(const GeotubeReport& report) {
  return format_table(result_lines(list_results(report.tubes.front(), report.strength)), "lrl");
}

std::string table_text(const GeotubeReport& report) {
  std::vector<ResultList> rows;
  for (const Geotube& tube : report.tubes) rows.push_back(list_results(tube, report.strength));
  return row_table(rows, "-");
}

// --- Files -----------------------------------------------------------------------------------------------------------

constexpr const char* geotube_file = "geotube.csv";
constexpr int file_digits = 12;

std::string tubes_csv(const GeotubeReport& report) {
  std::vector<ResultList> rows;
  for (const Geotube& tube : report.tubes) {
    rows.push_back(list_inputs(report.input));
    for (ListedNumber& result : list_results(tube, report.strength)) rows.back().push_back(std::move(result));
  }
  return results_csv(rows);
}

std::string outline_csv(const std::vector<OutlinePoint>& outline) {
  std::string text = "s_m,x_m,z_m,theta_rad,pressure_Pa\n";
  for (const OutlinePoint& point : outline) {
    std::string row;
    for (const double value : {point.s, point.x, point.z, point.theta, point.pressure})
      row += (row.empty() ? "" : ",") + format_number(value, file_digits);
    text += row + "\n";
  }
  return text;
}

Chart outline_chart(const GeotubeReport& report, int segments) {
  ChartPanel shape{"outline", "x [m]", "height above the ground [m]", {}, Aspect::equal};
  ChartPanel load{"pressure difference", "pressure inside - outside [Pa]", "height above the ground [m]", {}};
  for (const Geotube& tube : report.tubes) {
    const std::string label = "A = " + format_number(tube.area, 4) + " m2, H = " + format_number(tube.height, 4) + " m";
    ChartSeries outline{label, {}, {}}, pressure{label, {}, {}};
    const std::vector<OutlinePoint> points = geotube_outline(tube, segments);
    for (std::size_t i = 0; i < points.size(); ++i) {
      outline.x.push_back(points[i].x);
      outline.y.push_back(points[i].z);
      if (2 * i >= points.size()) continue;  // the left side repeats the right
      pressure.x.push_back(points[i].pressure);
      pressure.y.push_back(points[i].z);
    }
    shape.series.push_back(outline);
    load.series.push_back(pressure);
  }
  if (report.input.water.level > 0)
    shape.series.push_back({"water outside",
                            {-report.tubes.front().width, report.tubes.front().width},
                            {report.input.water.level, report.input.water.level},
                            SeriesStyle::dashed});
  return {"Geotube of " + format_number(report.input.perimeter) + " m perimeter", {shape, load}, 1};
}

}  // namespace

std::string report_text(const GeotubeReport& report) {
  std::string text = format_table(input_lines(report), "lrl");
  if (report.strength) text += strength_text(*report.strength);
  return text + "\n" + (report.layout == ReportLayout::table ? table_text(report) : one_tube_text(report));
}

void check_geotube_directory(const fs::path& directory) {
  check_result_directory({directory, "geodrop geotube", geotube_file});
}

void write_geotube_files(const fs::path& directory, const GeotubeReport& report, int segments) {
  make_result_directory(directory);
  for (const char* old : {geotube_file, "outline.csv", "outline.svg"}) fs::remove(directory / old);
  write_file_atomically(directory / geotube_file, tubes_csv(report));
  if (report.layout == ReportLayout::one_tube)
    write_file_atomically(directory / "outline.csv", outline_csv(geotube_outline(report.tubes.front(), segments)));
  write_chart(outline_chart(report, segments), directory / "outline.svg");
}

}  // namespace geodrop
