#include "hints.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "base/nearest_name.hpp"

namespace geodrop {
namespace {

constexpr std::pair<const char*, const char*> examples[] = {
    {"run",
     "geodrop run cases/dump_kekerdom.toml --threads 2\n"
     "geodrop run my_scene.toml --set grid.spacing=0.125 --output runs/fine\n"
     "geodrop run my_scene.toml --resume --set time.end=20"},
    {"check", "geodrop check my_scene.toml\ngeodrop check my_scene.toml --json"},
    {"stages", "geodrop stages cases/dump_kekerdom.toml"},
    {"info", "geodrop info\ngeodrop info my_scene.toml --set grid.spacing=0.125"},
    {"bench", "geodrop bench --quick\ngeodrop bench --against HEAD~1"},
    {"geotube", "geodrop geotube --perimeter 9.2 --unit-weight 12e3 --area 5.56 --output runs/tube"},
    {"release", "geodrop release --perimeter 18.3 --area 10.8 --density 1990 --water-density 1000 --opening-width 3"},
    {"fall", "geodrop fall --semi-axes 3.326767 0.507698 --density 1631 --water-density 1000 --terminal-velocity 3.3"},
    {"verify", "geodrop verify --quick\ngeodrop verify --only elastic_bar"},
    {"replay", "geodrop replay runs/dump_kekerdom"},
    {"ensemble",
     "geodrop ensemble cases/dump_kekerdom.toml --samples 20 --set grid.refine=[] "
     "--vary bodies.container.shape.tilt_deg=2.0:15.0"},
    {"sweep",
     "geodrop sweep my_scene.toml --vary grid.spacing=0.25,0.125 --jobs 2\n"
     "geodrop sweep my_scene.toml --vary membranes.geotextile.axial_stiffness=1e5:1e7:5:log --output runs/stiffness"},
    {"plot",
     "geodrop plot runs/dump_kekerdom\n"
     "geodrop plot runs/coarse runs/fine --columns container.velocity_y_m_s,geotextile.tension_gauge_N_m\n"
     "geodrop plot runs/stiffness --over membranes.geotextile.axial_stiffness --result height_m\n"
     "geodrop plot runs/dump_kekerdom_ensemble --outlines"},
    {"snapshot",
     "geodrop snapshot runs/dump_kekerdom --time 2.5\n"
     "geodrop snapshot runs/dump_kekerdom --field velocity --window=-4,4,-1,6 --membrane utilisation\n"
     "geodrop snapshot runs/release_uneven_3d --time 4 --field tension\n"
     "geodrop snapshot runs/release_uneven_3d --time 4 --cut=-8,0.5"},
    {"animate", "geodrop animate runs/dump_kekerdom --field velocity"},
    {"report",
     "geodrop report runs/dump_kekerdom --seam-efficiency 0.7 --reduction-installation 1.3\n"
     "geodrop report runs/dump_kekerdom --pdf"},
    {"compare", "geodrop compare runs/coarse runs/fine"},
    {"new", "geodrop new my_scene\ngeodrop new my_scene --from geotube_556\ngeodrop new --list"},
    {"manual",
     "geodrop manual | man -l -\ngeodrop manual --completion >~/.local/share/bash-completion/completions/geodrop"},
    {"schema", "geodrop schema >geodrop.schema.json"},
};

/// Of the wrapper ./geodrop in the source tree.
constexpr std::array wrapper_commands = {"test", "lint", "sanitize-test", "help"};

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

std::string example_lines(const std::string& command) {
  const auto* const found = std::ranges::find_if(examples, [&](const auto& each) { return each.first == command; });
  return found == std::end(examples) ? "" : found->second;
}

std::string did_you_mean(const std::string& nearest) {
  return nearest.empty() ? "" : "; did you mean " + nearest + "?";
}

}  // namespace

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

std::string examples_of(const std::string& command) {
  const std::string lines = example_lines(command);
  if (lines.empty()) return {};
  std::string text = "Examples:\n  ";
  for (const char letter : lines) text += letter == '\n' ? "\n  " : std::string(1, letter);
  return text;
}

std::string first_example(const std::string& command) {
  const std::string lines = example_lines(command);
  return lines.substr(0, lines.find('\n'));
}

std::string commands_of(const CLI::App& app) {
  std::string text;
  for (const std::string& name : command_names(app)) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::string hint_for(const CLI::App& app, const std::vector<std::string>& words) {
  const std::string help = "; geodrop --help lists what there is";
  if (words.size() < 2) return {};
  const std::string& first = words[1];
  std::vector<std::string> commands = command_names(app);
  if (first.starts_with('-')) return {};
  if (std::ranges::find(commands, first) == commands.end()) {
    commands.insert(commands.end(), wrapper_commands.begin(), wrapper_commands.end());
    const bool of_wrapper = std::ranges::find(wrapper_commands, first) != wrapper_commands.end();
    if (of_wrapper) return "\"" + first + "\" is a command of ./geodrop in the source tree";
    return "no command \"" + first + "\"" + did_you_mean(nearest_name(first, commands)) + help;
  }
  const CLI::App& command = *app.get_subcommand(first);
  const std::vector<std::string> known = option_names(command);
  for (std::size_t i = 2; i < words.size() && words[i] != "--"; ++i) {
    const std::string name = words[i].substr(0, words[i].find('='));
    const bool value = name.size() < 2 || name[0] != '-' || name.find_first_of("0123456789.") == 1;
    if (value || std::ranges::find(known, name) != known.end() || name == "-h") continue;
    const std::string nearest = name == "-o" ? "--output" : nearest_name(name, known);
    return "no option " + name + " of geodrop " + first + did_you_mean(nearest) + "; geodrop " + first +
           " --help lists them";
  }
  return {};
}

}  // namespace geodrop
