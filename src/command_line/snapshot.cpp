#include "snapshot.hpp"

#include <geodrop/base/error.hpp>
#include <geodrop/reader/scene_reader.hpp>

#include <fmt/core.h>

#include <filesystem>
#include <iostream>
#include <numeric>

#include "base/text.hpp"
#include "files/read_frames.hpp"
#include "only_if.hpp"
#include "option_errors.hpp"
#include "unfinished_runs.hpp"

namespace geodrop {
namespace {

namespace fs = std::filesystem;

void add_picture_options(CLI::App& command, SnapshotArguments& arguments) {
  command.add_option("directory", arguments.directory, "run directory")->required();
  command.add_option("--field", arguments.picture.field,
                     "what particles are coloured by: layers (default), material, velocity, velocity_y, displacement, "
                     "stress_yy, mean_pressure, pore_pressure, density, ...; in space, in which these are drawn in a "
                     "cut, also membranes from outside: tension, cross_tension, utilisation, strain, ...");
  command.add_option("--membrane", arguments.picture.membrane,
                     "what membranes are coloured by: tension (default), utilisation, strain, ..., none");
  command
      .add_option("--window", arguments.window,
                  "X0,X1,Y0,Y1, in space X0,X1,Y0,Y1,Z0,Z1, the part that is shown [m] (default: all)")
      ->delimiter(',')
      ->expected(4, 6);
  command
      .add_option("--cut", arguments.cut,
                  "X,Y, in space: where the front view and the side view are cut [m] (default: middle of the "
                  "membranes, or a plane of symmetry at which they end)")
      ->delimiter(',')
      ->expected(2);
  command.add_option("--range", arguments.range, "LOW,HIGH of the field, SI units (default: of the frame)")
      ->delimiter(',')
      ->expected(2);
  command.add_option("--membrane-range", arguments.tensions, "LOW,HIGH of the membranes' field, SI units")
      ->delimiter(',')
      ->expected(2);
}

constexpr OptionErrors snapshot_errors{"geodrop snapshot"};

std::optional<ValueRange> range_of(const std::vector<double>& ends, const char* option) {
  if (ends.empty()) return std::nullopt;
  if (!(ends[0] < ends[1])) snapshot_errors.refuse(option, "two numbers that are not in order", "LOW,HIGH");
  return ValueRange{ends[0], ends[1]};
}

/// Two numbers for each axis of the scene.
Extent window_of(const std::vector<double>& ends, std::size_t dimension) {
  const std::string allowed = dimension == 2 ? "X0,X1,Y0,Y1" : "X0,X1,Y0,Y1,Z0,Z1";
  if (ends.size() != 2 * dimension)
    snapshot_errors.refuse("--window", std::to_string(ends.size()) + " numbers", allowed);
  Extent window{{}, {}};
  for (std::size_t a = 0; a < dimension; ++a) {
    window.lower[a] = ends[2 * a];
    window.upper[a] = ends[2 * a + 1];
    if (!(window.lower[a] < window.upper[a]))
      snapshot_errors.refuse("--window", "numbers that are not in order", allowed);
  }
  return window;
}

PictureOptions picture_of(const SnapshotArguments& arguments, const Scene& scene) {
  PictureOptions picture = arguments.picture;
  if (picture.field == "pressure") picture.field = "mean_pressure";
  picture.range = range_of(arguments.range, "--range");
  picture.tensions = range_of(arguments.tensions, "--membrane-range");
  if (!arguments.window.empty())
    picture.window = window_of(arguments.window, static_cast<std::size_t>(scene.dimension));
  if (!arguments.cut.empty()) picture.cut = {arguments.cut[0], arguments.cut[1]};
  return picture;
}

}  // namespace

void add_snapshot_options(CLI::App& command, SnapshotArguments& arguments) {
  add_picture_options(command, arguments);
  command.add_option("--time", arguments.time, "of the frame, the nearest one is drawn [s] (default: the last)")
      ->check(only_if<double>([](double t) { return t >= 0; }, "a time >= 0 [s]"));
  command.add_option("--output", arguments.output, "PNG (default: snapshot_FIELD_TIME.png in the directory)")
      ->check(only_if<std::string>([](const std::string& file) { return file.ends_with(".png"); }, "a file .png"));
}

void add_animate_options(CLI::App& command, SnapshotArguments& arguments) {
  add_picture_options(command, arguments);
  command.add_option("--output", arguments.output, "GIF (default: animation.gif in the directory)")
      ->check(only_if<std::string>([](const std::string& file) { return file.ends_with(".gif"); }, "a file .gif"));
}

int run_snapshot(const SnapshotArguments& arguments) {
  tell_unfinished_runs({arguments.directory});
  const fs::path directory = arguments.directory;
  const std::vector<double> times = frame_times(directory);
  const Scene scene = read_scene(directory / "scene.toml");
  const Snapshot snapshot =
      read_frame(directory, arguments.time < 0 ? times.size() - 1 : frame_near(times, arguments.time));
  if (arguments.time > times.back())
    std::cerr << "no frame at " << short_number(arguments.time) << " s: the last one, at " << short_number(times.back())
              << " s, is drawn\n";
  PictureOptions picture = picture_of(arguments, scene);
  picture.field = picture_field(snapshot, picture);
  const fs::path file = arguments.output.empty()
                            ? directory / fmt::format("snapshot_{}_{:.2f}_s.png", picture.field, snapshot.t)
                            : fs::path(arguments.output);
  draw_snapshot(scene, snapshot, picture, file);
  std::cout << file.string() << '\n';
  return 0;
}

int run_animate(const SnapshotArguments& arguments) {
  tell_unfinished_runs({arguments.directory});
  const fs::path directory = arguments.directory;
  std::vector<std::size_t> frames(frame_times(directory).size());
  std::iota(frames.begin(), frames.end(), std::size_t{0});
  const Scene scene = read_scene(directory / "scene.toml");
  const fs::path file = arguments.output.empty() ? directory / "animation.gif" : fs::path(arguments.output);
  draw_animation(scene, directory, frames, picture_of(arguments, scene), file);
  std::cout << file.string() << '\n';
  return 0;
}

}  // namespace geodrop
