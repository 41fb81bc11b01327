#include "release_report.hpp"

#include "base/atomic_file.hpp"
#include "base/text.hpp"
#include "result_directory.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace geodrop {
namespace {

namespace fs = std::filesystem;

constexpr double degrees = 180 / std::numbers::pi;

ResultList list_inputs(const ReleaseCase& given) {
  ResultList list{{"perimeter", "perimeter_m", "m", given.perimeter},
                  {"area", "area_m2", "m2", given.section.area},
                  {"density", "density_kg_m3", "kg/m3", given.section.density},
                  {"density around it", "water_density_kg_m3", "kg/m3", given.section.water_density}};
  const auto add = [&](const char* name, const char* column, const char* unit, double value) {
    list.push_back({name, column, unit, value});
  };
  if (given.barge) {
    add("hinge above keel", "hinge_radius_m", "m", given.barge->hinge_radius);
    add("slope of closed walls", "wall_slope_deg", "deg", given.barge->wall_slope * degrees);
    add("friction", "friction_ratio", "-", given.barge->friction);
    add("opening angle", "opening_angle_deg", "deg", given.opening_angle * degrees);
  }
  if (given.strength) add("strength", "strength_N_m", "N/m", *given.strength);
  if (given.fall_height) add("fall height", "fall_height_m", "m", *given.fall_height);
  if (given.sinking) {
    add("volume", "volume_m3", "m3", given.sinking->volume);
    add("frontal area", "frontal_area_m2", "m2", given.sinking->frontal_area);
    add("drag coefficient", "drag_coefficient_ratio", "-", given.sinking->drag_coefficient);
  }
  return list;
}

double width_of_opening(const ReleaseCase& given) {
  return given.opening_width ? *given.opening_width : best_opening_width(given.section.area);
}

ResultList list_results(const ReleaseCase& given) {
  const double area = given.section.area, opening = width_of_opening(given), best = best_opening_width(area);
  const double tension = opening_tension(given.section);
  ResultList list{{"share of the circle", "circle_share_ratio", "-", circle_share(area, given.perimeter)},
                  {"opening width", "opening_width_m", "m", opening},
                  {"smallest perimeter", "smallest_perimeter_m", "m", smallest_perimeter(area, opening)},
                  {"best opening width", "best_opening_width_m", "m", best},
                  {"smallest perimeter there", "best_smallest_perimeter_m", "m", smallest_perimeter(area, best)},
                  {"weight less buoyancy", "weight_N_m", "N/m", container_weight(given.section)},
                  {"tension at opening", "opening_tension_N_m", "N/m", tension}};
  const auto add = [&](const char* name, const char* column, const char* unit, double value) {
    list.push_back({name, column, unit, value});
  };
  if (given.strength) {
    add("factor of safety", "factor_of_safety_ratio", "-", *given.strength / tension);
    add("utilisation", "utilisation_ratio", "-", tension / *given.strength);
  }
  if (given.barge) add("neutral height", "neutral_height_m", "m", neutral_height(*given.barge));
  if (given.fall_height) {
    const FreeFall fall = free_fall(*given.fall_height);
    add("speed after the fall", "fall_speed_m_s", "m/s", fall.speed);
    add("time of the fall", "fall_time_s", "s", fall.time);
  }
  if (given.sinking) add("terminal velocity", "terminal_velocity_m_s", "m/s", terminal_velocity(*given.sinking));
  return list;
}

/// NaN as long as friction holds the container.
std::vector<ResultList> list_wall_forces(const ReleaseCase& given) {
  constexpr int steps = 5;
  std::vector<ResultList> rows;
  if (!given.barge) return rows;
  const SplitBarge& barge = *given.barge;
  for (int i = 0; i <= steps; ++i) {
    const double angle = given.opening_angle * i / steps, slope = barge.wall_slope + angle;
    const bool slides = slope >= std::atan(barge.friction);
    const double force =
        slides ? wall_force(barge, container_weight(given.section), angle) : std::numeric_limits<double>::quiet_NaN();
    rows.push_back({{"angle of each half", "angle_deg", "deg", angle * degrees},
                    {"opening", "opening_width_m", "m", opening_width(barge, angle)},
                    {"slope of walls", "slope_deg", "deg", slope * degrees},
                    {"force of a wall = F_s - F_GT", "wall_force_N_m", "N/m", force}});
  }
  return rows;
}

constexpr const char* release_file = "release.csv";
constexpr const char* forces_file = "wall_force.csv";

}  // namespace

ReleaseReport make_release_report(const ReleaseCase& given) {
  const double smallest = smallest_perimeter(given.section.area, width_of_opening(given));
  return {given, given.perimeter >= smallest ? OpeningRule::met : OpeningRule::not_met, list_inputs(given),
          list_results(given), list_wall_forces(given)};
}

std::string release_text(const ReleaseReport& report) {
  std::vector<std::vector<std::string>> lines = result_lines(report.results);
  const std::string rule = report.rule == OpeningRule::met ? "met" : "NOT MET";
  lines.insert(lines.begin(), {"opening rule", rule, "perimeter >= 2.5 (A/b0 + b0)"});
  if (!report.given.opening_width) lines.insert(lines.begin() + 1, {"", "", "for the best opening, none was given"});
  std::string text = format_table(result_lines(report.inputs), "lrl") + "\n" + format_table(lines, "lrl");
  if (!report.wall_forces.empty()) text += "\n" + row_table(report.wall_forces, "friction holds");
  return text;
}

void check_release_directory(const fs::path& directory) {
  check_result_directory({directory, "geodrop release", release_file});
}

void write_release_files(const fs::path& directory, const ReleaseReport& report) {
  make_result_directory(directory);
  for (const char* old : {release_file, forces_file}) fs::remove(directory / old);
  ResultList row = report.inputs;
  row.insert(row.end(), report.results.begin(), report.results.end());
  row.push_back({"opening rule", "opening_rule_met", "-", report.rule == OpeningRule::met ? 1.0 : 0.0});
  write_file_atomically(directory / release_file, results_csv({row}));
  if (!report.wall_forces.empty()) write_file_atomically(directory / forces_file, results_csv(report.wall_forces));
}

}  // namespace geodrop
