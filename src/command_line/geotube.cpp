// Options to inputs, one solution or a table of them, results to the terminal and to files.
#include "geotube.hpp"

#include "doubts/doubts.hpp"
#include "geotube_report.hpp"
#include "only_if.hpp"
#include "option_errors.hpp"

#include <geodrop/calculators/geotube.hpp>

#include <cmath>
#include <cstdio>
#include <iostream>
#include <vector>

namespace geodrop {
namespace {

constexpr OptionErrors geotube_errors{"geodrop geotube"};

// --- Which tubes are asked for ---------------------------------------------------------------------------------------

struct Choice {
  const char* name;  ///< of the option, without dashes
  GeotubeQuantity quantity;
  std::optional<double> GeotubeArguments::*value;
};

constexpr Choice choices[] = {{"area", GeotubeQuantity::area, &GeotubeArguments::area},
                              {"height", GeotubeQuantity::height, &GeotubeArguments::height},
                              {"pressure", GeotubeQuantity::top_pressure, &GeotubeArguments::pressure},
                              {"tension", GeotubeQuantity::tension, &GeotubeArguments::tension}};

/// "height=0.5:2.5:0.1" to its inputs, both ends included.
std::vector<GeotubeInput> read_table(const std::string& text, const GeotubeInput& tube) {
  const std::string allowed =
      "QUANTITY=FROM:TO:STEP, e.g. height=0.5:2.5:0.1, with 0 < FROM <= TO, STEP > 0 and area, "
      "height, pressure or tension as quantity";
  const std::size_t equals = text.find('=');
  double from = 0, to = 0, step = 0;
  int used = 0;
  const std::string range = equals == std::string::npos ? "" : text.substr(equals + 1);
  const bool is_range = std::sscanf(range.c_str(), "%lf:%lf:%lf%n", &from, &to, &step, &used) == 3 &&
                        static_cast<std::size_t>(used) == range.size();
  if (!is_range || !(from > 0 && to >= from && step > 0 && std::isfinite(to / step)))
    geotube_errors.refuse("--table", text, allowed);
  constexpr double most_rows = 10000, rounding = 1e-9;  // of a step
  const double rows = std::floor((to - from) / step + rounding) + 1;
  if (rows > most_rows) geotube_errors.refuse("--table", text, "at most 10000 rows");
  for (const Choice& choice : choices) {
    if (text.substr(0, equals) != choice.name) continue;
    std::vector<GeotubeInput> inputs(static_cast<std::size_t>(rows), tube);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      inputs[i].given = choice.quantity;
      inputs[i].value = from + static_cast<double>(i) * step;
    }
    return inputs;
  }
  geotube_errors.refuse("--table", text, allowed);
}

std::vector<GeotubeInput> read_inputs(const GeotubeArguments& arguments) {
  GeotubeInput tube{.perimeter = arguments.perimeter, .unit_weight = arguments.unit_weight, .value = 0};
  if (arguments.stiffness) tube.stiffness = *arguments.stiffness;
  if (arguments.water_level.has_value() != arguments.water_unit_weight.has_value())
    geotube_errors.refuse("--water-level and --water-unit-weight", "one of them", "both or none");
  if (arguments.water_level) tube.water = {*arguments.water_level, *arguments.water_unit_weight};

  std::vector<std::string> found;
  for (const Choice& choice : choices) {
    if (!(arguments.*choice.value)) continue;
    found.push_back(std::string("--") + choice.name);
    tube.given = choice.quantity;
    tube.value = *(arguments.*choice.value);
  }
  if (!arguments.table.empty()) found.push_back("--table");
  std::string names;
  for (const std::string& name : found) names += (names.empty() ? "" : " and ") + name;
  if (found.size() != 1)
    geotube_errors.refuse("what is known of the fill", found.empty() ? "nothing" : names,
                          "exactly one of --area, --height, --pressure, --tension, --table");
  return arguments.table.empty() ? std::vector{tube} : read_table(arguments.table, tube);
}

std::optional<TensionStrength> read_strength(const GeotubeArguments& arguments) {
  if (arguments.strength)
    return TensionStrength{*arguments.strength, arguments.seam_efficiency, arguments.installation,
                           arguments.creep,     arguments.durability,      arguments.seam};
  if (arguments.seam_efficiency || arguments.installation || arguments.creep || arguments.durability || arguments.seam)
    geotube_errors.refuse("--seam-efficiency and --reduction-...", "no --strength", "--strength, which they reduce");
  return std::nullopt;
}

std::vector<Geotube> solve(const std::vector<GeotubeInput>& inputs) {
  std::vector<Geotube> tubes;
  geotube_errors.with_option_names([&] {
    for (const GeotubeInput& input : inputs) tubes.push_back(solve_geotube(input));
  });
  return tubes;
}

}  // namespace

void add_geotube_options(CLI::App& command, GeotubeArguments& a) {
  const auto add = [&](const char* name, auto& value, const char* text, const char* allowed) {
    return command.add_option(name, value, text)->check(positive(allowed));
  };
  add("--perimeter", a.perimeter, "of the unstretched membrane [m]", "a length > 0 [m]")->required();
  add("--unit-weight", a.unit_weight, "of the fill [N/m3]", "a unit weight > 0 [N/m3]")->required();
  add("--area", a.area, "known: area of the cross-section [m2]", "an area > 0 [m2]");
  add("--height", a.height, "known: height [m]", "a height > 0 [m]");
  add("--pressure", a.pressure, "known: pressure at the crown, inside minus outside [Pa]", "a pressure > 0 [Pa]");
  add("--tension", a.tension, "known: tension [N/m]", "a tension > 0 [N/m]");
  command.add_option("--table", a.table, "many tubes: QUANTITY=FROM:TO:STEP, e.g. height=0.5:2.5:0.1");
  add("--stiffness", a.stiffness, "axial stiffness J [N/m] (not given: inextensible)", "a stiffness > 0 [N/m]");
  command.add_option("--water-level", a.water_level, "level of water outside, above the ground [m] (not given: dry)")
      ->check(only_if<double>([](double level) { return level >= 0; }, "a level >= 0 [m]"));
  add("--water-unit-weight", a.water_unit_weight, "of the water outside [N/m3]", "a unit weight > 0 [N/m3]");
  add("--strength", a.strength, "short-term strength of the geotextile [N/m], for the factor of safety",
      "a strength > 0 [N/m]");
  command.add_option("--seam-efficiency", a.seam_efficiency, "strength of a seam over that of the geotextile")
      ->check(only_if<double>([](double part) { return part > 0 && part <= 1; }, "a number > 0 and at most 1"));
  const auto add_factor = [&](const char* name, std::optional<double>& value, const char* text) {
    command.add_option(name, value, text)
        ->check(only_if<double>([](double factor) { return factor >= 1; }, "a reduction factor >= 1"));
  };
  add_factor("--reduction-installation", a.installation, "reduction factor of damage at installation");
  add_factor("--reduction-creep", a.creep, "reduction factor of creep");
  add_factor("--reduction-durability", a.durability, "reduction factor of chemical and biological degradation");
  add_factor("--reduction-seam", a.seam, "reduction factor of seams (instead of their efficiency)");
  command.add_option("--output", a.output, "directory for geotube.csv, outline.csv and outline.svg");
  command.add_option("--segments", a.segments, "pieces of equal length of the outline (default: 400)")
      ->check(only_if<int>([](int n) { return n >= 4 && n <= 1000000; }, "a whole number from 4 to 1000000"));
}

int run_geotube(const GeotubeArguments& arguments) {
  tell_doubts({doubt_unit_weight("--unit-weight", arguments.unit_weight),
               doubt_unit_weight("--water-unit-weight", arguments.water_unit_weight.value_or(0)),
               doubt_stiffness("--stiffness", arguments.stiffness.value_or(0)),
               doubt_strength("--strength", arguments.strength.value_or(0))});
  const std::vector<GeotubeInput> inputs = read_inputs(arguments);
  const std::optional<TensionStrength> strength = read_strength(arguments);
  if (!arguments.output.empty()) check_geotube_directory(arguments.output);
  const GeotubeReport report{inputs.front(), solve(inputs), strength,
                             arguments.table.empty() ? ReportLayout::one_tube : ReportLayout::table};
  std::cout << report_text(report);
  if (!arguments.output.empty()) write_geotube_files(arguments.output, report, arguments.segments);
  return 0;
}

}  // namespace geodrop
