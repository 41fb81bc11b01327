// Options to a case in SI units; what cannot be is refused by the name of its option.
#include "release.hpp"

#include "base/text.hpp"
#include "doubts/doubts.hpp"
#include "only_if.hpp"
#include "option_errors.hpp"
#include "release_report.hpp"

#include <iostream>
#include <numbers>

namespace geodrop {
namespace {

constexpr double degree = std::numbers::pi / 180, right_angle = 90;

constexpr OptionErrors release_errors{"geodrop release"};

std::optional<SplitBarge> read_barge(const ReleaseArguments& a) {
  const Given given = release_errors.all_or_none(
      {{"--hinge-radius", a.hinge_radius}, {"--wall-slope", a.wall_slope}, {"--friction", a.friction}});
  if (given == Given::none) return std::nullopt;
  return SplitBarge{*a.wall_slope * degree, *a.hinge_radius, *a.friction};
}

std::optional<double> read_opening_width(const ReleaseArguments& a, const std::optional<SplitBarge>& barge) {
  if (a.opening_angle && a.opening_width)
    release_errors.refuse("how far the barge opens", "--opening-angle and --opening-width", "one of them");
  if (a.opening_angle && !barge)
    release_errors.refuse("--opening-angle", "no barge",
                          "with --hinge-radius, --wall-slope and --friction; without, --opening-width");
  if (barge && !a.opening_angle && !a.opening_width)
    release_errors.refuse("how far the barge opens", "nothing", "--opening-angle or --opening-width");
  if (!a.opening_angle) return a.opening_width;
  return release_errors.with_option_names([&] { return opening_width(*barge, *a.opening_angle * degree); });
}

void check_walls_lean(const ReleaseArguments& a, double angle) {
  const double most = right_angle - *a.wall_slope, found = angle / degree;
  if (found < most) return;
  const std::string walls = "less than " + format_number(most) + " deg, where the walls stand upright";
  if (a.opening_angle) release_errors.refuse("--opening-angle", format_number(*a.opening_angle), walls);
  release_errors.refuse("--opening-width",
                        format_number(*a.opening_width) + " (each half at " + format_number(found) + " deg)", walls);
}

std::optional<SinkingContainer> read_sinking(const ReleaseArguments& a) {
  const Given given = release_errors.all_or_none(
      {{"--volume", a.volume}, {"--frontal-area", a.frontal_area}, {"--drag-coefficient", a.drag_coefficient}});
  if (given == Given::none) return std::nullopt;
  if (a.water_density == 0)
    release_errors.refuse("--water-density", "0 with --volume",
                          "a density > 0 [kg/m3]: the terminal velocity is one in water");
  return SinkingContainer{*a.volume, *a.frontal_area, *a.drag_coefficient, a.density, a.water_density};
}

ReleaseCase read_case(const ReleaseArguments& a) {
  ReleaseCase found{.section = {a.area, a.density, a.water_density}, .perimeter = a.perimeter};
  found.barge = read_barge(a);
  found.opening_width = read_opening_width(a, found.barge);
  if (found.barge) {
    found.opening_angle =
        release_errors.with_option_names([&] { return opening_angle(*found.barge, *found.opening_width); });
    check_walls_lean(a, found.opening_angle);
  }
  if (a.fall_height && a.water_density > 0)
    release_errors.refuse("--fall-height", "--water-density " + format_number(a.water_density),
                          "a fall in air, --water-density 0");
  found.fall_height = a.fall_height;
  found.strength = a.strength;
  found.sinking = read_sinking(a);
  return found;
}

}  // namespace

void add_release_options(CLI::App& command, ReleaseArguments& a) {
  const auto add = [&](const char* name, auto& value, const char* text, const char* allowed) {
    return command.add_option(name, value, text)->check(positive(allowed));
  };
  const auto add_not_negative = [&](const char* name, auto& value, const char* text, const char* allowed) {
    return command.add_option(name, value, text)
        ->check(only_if<double>([](double number) { return number >= 0; }, allowed));
  };
  const auto add_angle = [&](const char* name, auto& value, const char* text) {
    command.add_option(name, value, text)
        ->check(only_if<double>([](double angle) { return angle > 0 && angle < right_angle; },
                                "an angle > 0 and < 90 [deg]"));
  };
  add("--perimeter", a.perimeter, "of the container [m]", "a length > 0 [m]")->required();
  add("--area", a.area, "of its fill [m2]", "an area > 0 [m2]")->required();
  add("--density", a.density, "of the fill with what is in its pores [kg/m3]", "a density > 0 [kg/m3]")->required();
  add_not_negative("--water-density", a.water_density, "of the water around it [kg/m3]; 0: in air",
                   "a density >= 0 [kg/m3]")
      ->required();
  add("--hinge-radius", a.hinge_radius, "barge: height of the hinge above the keel [m]", "a height > 0 [m]");
  add_angle("--wall-slope", a.wall_slope, "barge: slope of its closed walls, from the horizontal [deg]");
  add_not_negative("--friction", a.friction, "barge: coefficient of friction, geotextile on wall",
                   "a coefficient >= 0");
  add_angle("--opening-angle", a.opening_angle, "how far each half of the barge opens [deg]");
  add("--opening-width", a.opening_width, "instead: width of the opening [m]", "a width > 0 [m]");
  add("--strength", a.strength, "tension that geotextile and seams may bear [N/m]", "a strength > 0 [N/m]");
  add("--fall-height", a.fall_height, "height of a fall in air [m]", "a height > 0 [m]");
  add("--volume", a.volume, "of the whole container [m3], for its terminal velocity in water", "a volume > 0 [m3]");
  add("--frontal-area", a.frontal_area, "of the whole container, across its fall [m2]", "an area > 0 [m2]");
  add("--drag-coefficient", a.drag_coefficient, "of the container that sinks", "a coefficient > 0");
  command.add_option("--output", a.output, "directory for release.csv and wall_force.csv");
}

int run_release(const ReleaseArguments& arguments) {
  tell_doubts({doubt_density("--density", arguments.density), doubt_density("--water-density", arguments.water_density),
               doubt_strength("--strength", arguments.strength.value_or(0))});
  const ReleaseCase given = read_case(arguments);
  if (!arguments.output.empty()) check_release_directory(arguments.output);
  const ReleaseReport report = release_errors.with_option_names([&] { return make_release_report(given); });
  std::cout << release_text(report);
  if (!arguments.output.empty()) write_release_files(arguments.output, report);
  return 0;
}

}  // namespace geodrop
