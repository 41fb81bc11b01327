// Options to a case; what cannot be is refused by the name of its option.
#include "fall.hpp"

#include "base/text.hpp"
#include "doubts/doubts.hpp"
#include "fall_report.hpp"
#include "only_if.hpp"
#include "option_errors.hpp"

#include <iostream>

namespace geodrop {
namespace {

constexpr OptionErrors fall_errors{"geodrop fall"};

SemiAxes read_axes(const FallArguments& a) {
  const Given given = fall_errors.all_or_none({{"--perimeter", a.perimeter}, {"--area", a.area}});
  const bool has_axes = !a.semi_axes.empty();
  if (has_axes == (given == Given::all))
    fall_errors.refuse("the ellipse", has_axes ? "--semi-axes, --perimeter and --area" : "nothing",
                       "either --semi-axes or --perimeter and --area");
  if (has_axes) return {a.semi_axes[0], a.semi_axes[1]};
  return fall_errors.with_option_names([&] { return upright_ellipse(*a.perimeter, *a.area); });
}

/// Density with the air.
double read_density(const FallArguments& a) {
  if (!a.air) return a.density;
  const double density = fall_errors.with_option_names([&] { return density_with_air(a.density, *a.air); });
  if (density <= a.water_density && a.density > a.water_density)
    fall_errors.refuse(
        "--air", format_number(*a.air),
        "less than " + format_number(1 - a.water_density / a.density) + ", with which the container floats");
  return density;
}

std::optional<Drag> read_drag(const FallArguments& a, const SinkingEllipse& ellipse) {
  if (a.drag_coefficient && a.terminal_velocity)
    fall_errors.refuse("the drag", "--drag-coefficient and --terminal-velocity", "one of them");
  if (!a.drag_coefficient && !a.terminal_velocity) {
    if (a.width) fall_errors.refuse("--width", "no drag", "with --drag-coefficient or --terminal-velocity");
    return std::nullopt;
  }
  const double width = a.width ? *a.width : 2 * ellipse.across;
  if (a.drag_coefficient) return Drag{*a.drag_coefficient, width};
  return Drag{fall_errors.with_option_names([&] { return drag_coefficient(ellipse, width, *a.terminal_velocity); }),
              width};
}

FallCase read_case(const FallArguments& a) {
  const SemiAxes axes = read_axes(a);
  FallCase found{.ellipse = {axes.along, axes.across, read_density(a), a.water_density}, .density = a.density};
  found.air = a.air;
  found.drag = read_drag(a, found.ellipse);
  found.fall_height = a.fall_height;
  if (a.stiffness && !(found.drag && found.fall_height))
    fall_errors.refuse("--stiffness", found.drag ? "no --fall-height" : "no drag",
                       "with --fall-height and --drag-coefficient or --terminal-velocity: landing needs a speed");
  found.stiffness = a.stiffness;
  return found;
}

}  // namespace

void add_fall_options(CLI::App& command, FallArguments& a) {
  const auto add = [&](const char* name, auto& value, const char* text, const char* allowed) {
    return command.add_option(name, value, text)->check(positive(allowed));
  };
  add("--semi-axes", a.semi_axes, "of the ellipse: along the fall, across it [m]", "a length > 0 [m]")->expected(2);
  add("--perimeter", a.perimeter, "instead, with --area: of the ellipse, which falls upright [m]", "a length > 0 [m]");
  add("--area", a.area, "of the ellipse [m2]", "an area > 0 [m2]");
  add("--density", a.density, "of all in the container, without air [kg/m3]", "a density > 0 [kg/m3]")->required();
  add("--water-density", a.water_density, "of the water around it [kg/m3]", "a density > 0 [kg/m3]")->required();
  command.add_option("--air", a.air, "share of the container's volume that air takes from sand and water alike")
      ->check(only_if<double>([](double share) { return share >= 0 && share < 1; }, "a share >= 0 and < 1"));
  add("--drag-coefficient", a.drag_coefficient, "on the width across the fall", "a coefficient > 0");
  add("--terminal-velocity", a.terminal_velocity, "instead: finds the drag coefficient that it needs [m/s]",
      "a speed > 0 [m/s]");
  add("--width", a.width, "that the drag coefficient is for [m] (not given: that of the ellipse)", "a width > 0 [m]");
  add("--fall-height", a.fall_height, "from release until the container touches the bed [m]", "a height > 0 [m]");
  add("--stiffness", a.stiffness, "axial stiffness of the geotextile [N/m], to bound its tension on landing",
      "a stiffness > 0 [N/m]");
  command.add_option("--output", a.output, "directory for fall.csv and path.csv");
}

int run_fall(const FallArguments& arguments) {
  tell_doubts({doubt_density("--density", arguments.density), doubt_density("--water-density", arguments.water_density),
               doubt_stiffness("--stiffness", arguments.stiffness.value_or(0))});
  const FallCase given = read_case(arguments);
  if (!arguments.output.empty()) check_fall_directory(arguments.output);
  const FallReport report = fall_errors.with_option_names([&] { return make_fall_report(given); });
  std::cout << fall_text(report);
  if (!arguments.output.empty()) write_fall_files(arguments.output, report);
  return 0;
}

}  // namespace geodrop
