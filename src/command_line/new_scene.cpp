#include "new_scene.hpp"

#include <geodrop/base/error.hpp>
#include <geodrop/base/input_file.hpp>

#include <filesystem>
#include <iostream>
#include <vector>

#include "base/atomic_file.hpp"
#include "base/nearest_name.hpp"
#include "base/shell_command.hpp"
#include "base/text.hpp"
#include "option_errors.hpp"
#include "reader/parse_scene.hpp"
#include "scene_file.hpp"

namespace geodrop {
namespace {

namespace fs = std::filesystem;

constexpr const char* beginning =
    R"(# How fast does a bag of sand fall through 6 m of water, and what does its geotextile bear?
#
# A scene to begin with: change it, then
#   geodrop check THIS_FILE       mistakes, doubts, how long a run takes
#   geodrop run THIS_FILE         a directory of results below runs/
#   geodrop report runs/NAME      a page about it
# All keys: docs/scene.md. Units are SI: m, s, kg, N, Pa; angles in degrees.
title = "A bag of sand dropped in water"
question = "How fast does a bag of sand fall through 6 m of water, and what does its geotextile bear?"
gravity = [0.0, -9.81]

[grid]
lower = [-3.0, -1.0]
upper = [3.0, 7.0]
spacing = 0.125  # of cells; double it and compare

[walls]
left = "slip"
right = "slip"
bottom = "no_slip"
top = "slip"

[solver]
transfer = "blend"
blend_rate = 10.0

[time]
end = 6.0

[output]
frame_interval = 0.1
history_interval = 0.01

[materials.water]
model = "newtonian"
density = 1000.0
sound_speed = 60.0  # about ten times the fastest motion; water has 1460 m/s
viscosity = 8.9e-4
still_level = 6.0  # of its surface; without it softened water is too dense below

[materials.sand]
model = "mohr_coulomb"
density = 1900.0
youngs_modulus = 2.0e6
poissons_ratio = 0.3
cohesion = 0.0
friction_angle_deg = 32.0
dilatancy_angle_deg = 0.0
tension_cutoff = 0.0
drainage = "undrained"
porosity = 0.4
fluid_bulk_modulus = 16.0e6  # of water in the pores; far above the skeleton, far below the 2.1e9 of real water, which costs time
void_memory = true

[materials.clay]
model = "mohr_coulomb"
density = 1900.0
youngs_modulus = 2.5e6
poissons_ratio = 0.3
cohesion = 20.0e3  # undrained strength; undrained sand has next to none at its surface: the bag would make a crater
friction_angle_deg = 0.0
dilatancy_angle_deg = 0.0
tension_cutoff = 0.0
drainage = "undrained"
porosity = 0.4
fluid_bulk_modulus = 20.0e6

[[bodies]]
name = "water"
material = "water"
shape = { type = "box", lower = [-3.0, 0.0], upper = [3.0, 6.0] }
minus = ["bag"]
jitter = 0.3  # particles on a lattice would part below the bag, and the pressure would ring
shift = true
shift_speed = 2.0
initial_stress = { type = "hydrostatic", fluid = "water", surface = 6.0 }

# Where the bag lands, the bed is a body of its own within a skin: an exact surface that water slips along. Without it the last
# cell of water stays below the bag.
[[bodies]]
name = "bed"
material = "clay"
shape = { type = "box", lower = [-2.0, -0.5], upper = [2.0, 0.0] }
initial_stress = { type = "k0", surface = 0.0, k0 = 0.5, under = "fluid", fluid = "water", fluid_surface = 6.0 }

[[bodies]]
name = "ground"
material = "clay"
shape = { type = "box", lower = [-3.0, -1.0], upper = [3.0, 0.0] }
minus = ["bed"]
initial_stress = { type = "k0", surface = 0.0, k0 = 0.5, under = "fluid", fluid = "water", fluid_surface = 6.0 }

[[bodies]]
name = "bag"
material = "sand"
shape = { type = "ellipse", centre = [0.0, 4.5], semi_axes = [1.0, 0.5] }
layers = 6
initial_stress = { type = "fluid_pressure", fluid = "water", surface = 6.0, effective_pressure = 2000.0 }

[[membranes]]
name = "geotextile"
body = "bag"
axial_stiffness = 1.0e6
mass_per_area = 0.5
strength = 100.0e3
slack = 0.0
interface = "sharp"
shear = "none"

[[membranes]]
name = "bed_surface"
body = "bed"
axial_stiffness = 0.0  # a skin: no tension, no mass
mass_per_area = 0.0
slack = 0.0
interface = "sharp"
shear = "none"

[[contacts]]
between = ["geotextile", "bed_surface"]
friction = 0.5
stiffness = 0.25

[[results]]
name = "time_to_land_s"
column = "bag.lowest_m"
reduce = "first_time_below"
level = 0.05

[[results]]
name = "fall_velocity_max_m_s"
column = "bag.velocity_y_m_s"
reduce = "min"
scale = -1.0

[[results]]
name = "tension_max_N_m"
column = "geotextile.tension_gauge_N_m"
reduce = "max"

[[results]]
name = "height_end_m"
column = "bag.height_m"
reduce = "last"
)";

constexpr OptionErrors new_scene_errors{"geodrop new"};

/// A file, or a case by its name.
std::string text_of_case(const std::string& from) {
  if (fs::is_regular_file(from)) return read_input(from, "--from", "a scene");
  std::vector<std::string> names;
  for (const fs::path& file : shipped_cases()) {
    if (file.stem() == from) return read_input(file, "--from", "a scene");
    names.push_back(file.stem());
  }
  const std::string nearest = nearest_name(from, names);
  new_scene_errors.refuse(
      "--from", '"' + from + '"',
      "a scene file, or the name of a case" +
          (nearest.empty() ? "; geodrop new --list tells them" : "; the nearest is \"" + nearest + '"'));
}

/// Names and titles, those of cases/ before those of the folders in it.
std::string list_of_cases() {
  std::vector<std::vector<std::string>> first, below;
  for (const fs::path& file : shipped_cases()) {
    const bool is_first = file.parent_path().filename() == "cases";
    const std::string title = parse_scene(file.string()).table["title"].value_or<std::string>("");
    (is_first ? first : below).push_back({file.stem().string(), title});
  }
  return "Cases to begin with:\n" + format_table(first, "ll") + "\nCases with a reference (geodrop verify):\n" +
         format_table(below, "ll");
}

}  // namespace

void add_new_scene_options(CLI::App& command, NewSceneArguments& arguments) {
  command.add_option("name", arguments.name, "of the scene; the file is NAME.toml");
  command.add_option("--from", arguments.from, "a case (cases/*.toml) by its name, or a file, to begin with");
  command.add_flag("--list", arguments.list, "print the names of the cases, with their titles");
}

int run_new_scene(const NewSceneArguments& arguments) {
  if (arguments.list) return std::cout << list_of_cases(), 0;
  if (arguments.name.empty()) throw CLI::RequiredError("name");
  fs::path file = arguments.name;
  if (file.extension() != ".toml") file += ".toml";
  if (fs::exists(file)) new_scene_errors.refuse("name", file.string() + ", which is there already", "a new name");
  write_file_atomically(file, arguments.from.empty() ? beginning : text_of_case(arguments.from));
  std::cout << file.string() << "\nnext: geodrop check " << shell_word(file.string()) << '\n';
  return 0;
}

}  // namespace geodrop
