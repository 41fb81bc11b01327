#include "fall_report.hpp"

#include "base/atomic_file.hpp"
#include "base/text.hpp"
#include "result_directory.hpp"

namespace geodrop {
namespace {

namespace fs = std::filesystem;

ResultList list_inputs(const FallCase& given) {
  ResultList list{{"semi-axis along the fall", "along_m", "m", given.ellipse.along},
                  {"semi-axis across it", "across_m", "m", given.ellipse.across},
                  {"density", "density_kg_m3", "kg/m3", given.density},
                  {"density of the water", "water_density_kg_m3", "kg/m3", given.ellipse.water_density}};
  const auto add = [&](const char* name, const char* column, const char* unit, double value) {
    list.push_back({name, column, unit, value});
  };
  if (given.air) add("share of air", "air_ratio", "-", *given.air);
  if (given.drag) add("width for the drag", "width_m", "m", given.drag->width);
  if (given.fall_height) add("fall height", "fall_height_m", "m", *given.fall_height);
  if (given.stiffness) add("stiffness", "stiffness_N_m", "N/m", *given.stiffness);
  return list;
}

Fall fall_of(const FallCase& given) {
  return {initial_acceleration(given.ellipse), terminal_velocity(given.ellipse, *given.drag)};
}

ResultList list_landing(const FallCase& given) {
  const SinkingEllipse& ellipse = given.ellipse;
  const double perimeter = ellipse_perimeter(ellipse), stiffness = *given.stiffness;
  const double kinetic = kinetic_energy(ellipse, fall_through(fall_of(given), *given.fall_height).speed);
  const double settling = settling_energy(ellipse);
  return {{"kinetic energy", "kinetic_energy_J_m", "J/m", kinetic},
          {"energy of settling, at most", "settling_energy_J_m", "J/m", settling},
          {"tension if the fall is stopped, r.m.s., bound", "stop_tension_bound_N_m", "N/m",
           tension_bound(kinetic, stiffness, perimeter)},
          {"and if it settles, r.m.s., bound", "settling_tension_bound_N_m", "N/m",
           tension_bound(kinetic + settling, stiffness, perimeter)}};
}

ResultList list_results(const FallCase& given) {
  const SinkingEllipse& ellipse = given.ellipse;
  const double start = initial_acceleration(ellipse);
  ResultList list{{"area", "area_m2", "m2", ellipse_area(ellipse)},
                  {"perimeter", "perimeter_m", "m", ellipse_perimeter(ellipse)},
                  {"added mass coefficient", "added_mass_ratio", "-", added_mass_coefficient(ellipse)},
                  {"initial acceleration", "initial_acceleration_m_s2", "m/s2", start}};
  const auto add = [&](const char* name, const char* column, const char* unit, double value) {
    list.push_back({name, column, unit, value});
  };
  if (given.air) add("density with air", "density_with_air_kg_m3", "kg/m3", ellipse.density);
  if (given.drag) {
    add("drag coefficient", "drag_coefficient_ratio", "-", given.drag->coefficient);
    add("terminal velocity", "terminal_velocity_m_s", "m/s", fall_of(given).terminal_velocity);
    add("time scale", "time_scale_s", "s", time_scale(fall_of(given)));
  }
  if (given.fall_height) {
    const FallState fastest = fall_without_drag(start, *given.fall_height);
    add("without drag: speed on landing", "speed_without_drag_m_s", "m/s", fastest.speed);
    add("without drag: time of the fall", "time_without_drag_s", "s", fastest.time);
  }
  if (given.drag && given.fall_height) {
    const FallState end = fall_through(fall_of(given), *given.fall_height);
    add("speed on landing", "landing_speed_m_s", "m/s", end.speed);
    add("time of the fall", "landing_time_s", "s", end.time);
  }
  if (given.stiffness)
    for (const ListedNumber& result : list_landing(given)) list.push_back(result);
  return list;
}

/// To the bed or, if its depth was not given, to 99.5 % of the terminal velocity.
std::vector<ResultList> list_path(const FallCase& given, int steps) {
  std::vector<ResultList> rows;
  if (!given.drag) return rows;
  constexpr double scales_to_terminal = 3;  // tanh 3 = 0.995
  const Fall fall = fall_of(given);
  const double end =
      given.fall_height ? fall_through(fall, *given.fall_height).time : scales_to_terminal * time_scale(fall);
  for (int i = 0; i <= steps; ++i) {
    const FallState state = fall_until(fall, end * i / steps);
    rows.push_back({{"time", "time_s", "s", state.time},
                    {"way", "way_m", "m", state.way},
                    {"speed", "speed_m_s", "m/s", state.speed}});
  }
  return rows;
}

constexpr const char* fall_file = "fall.csv";
constexpr const char* path_file = "path.csv";

}  // namespace

FallReport make_fall_report(const FallCase& given) {
  constexpr int few = 10, many = 200;
  return {list_inputs(given), list_results(given), list_path(given, few), list_path(given, many)};
}

std::string fall_text(const FallReport& report) {
  std::string text =
      format_table(result_lines(report.inputs), "lrl") + "\n" + format_table(result_lines(report.results), "lrl");
  if (!report.short_path.empty()) text += "\n" + row_table(report.short_path, "nan");
  return text;
}

void check_fall_directory(const fs::path& directory) { check_result_directory({directory, "geodrop fall", fall_file}); }

void write_fall_files(const fs::path& directory, const FallReport& report) {
  make_result_directory(directory);
  for (const char* old : {fall_file, path_file}) fs::remove(directory / old);
  ResultList row = report.inputs;
  row.insert(row.end(), report.results.begin(), report.results.end());
  write_file_atomically(directory / fall_file, results_csv({row}));
  if (!report.path.empty()) write_file_atomically(directory / path_file, results_csv(report.path));
}

}  // namespace geodrop
