#include "run_directory.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <fstream>
#include <geodrop/error.hpp>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

namespace geodrop {
namespace {

namespace fs = std::filesystem;

constexpr std::array run_files = {"run.log",       "scene.toml",   "history.csv",    "hashes.csv",
                                  "parts.csv",     "summary.json", "checkpoint.bin", "particles.pvd",
                                  "membranes.pvd", "rigid.pvd",    "history.svg",    "history.png"};

/// Number of a frame from its file name; empty if it is not a frame's.
std::optional<std::size_t> frame_number(std::string_view name) {
  for (const auto& [before, after] : {std::pair<std::string_view, std::string_view>{"particles_", ".vtu"},
                                      std::pair<std::string_view, std::string_view>{"membranes_", ".vtp"},
                                      std::pair<std::string_view, std::string_view>{"rigid_", ".vtp"}}) {
    if (!name.starts_with(before) || !name.ends_with(after) || name.size() <= before.size() + after.size()) continue;
    const std::string_view digits = name.substr(before.size(), name.size() - before.size() - after.size());
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (error == std::errc() && end == digits.data() + digits.size()) return number;
  }
  return std::nullopt;
}

/// Profiles of geotube probes, and pictures of those and of section probes.
bool is_profile(std::string_view name) {
  const bool is_picture = name.ends_with(".svg") || name.ends_with(".png");
  return (name.starts_with("geotube_") && (name.ends_with(".csv") || is_picture)) ||
         (name.starts_with("section_") && is_picture);
}

/// Every run begins its log with the program's name, before it writes anything else.
bool is_run_directory(const fs::path& directory) {
  std::ifstream log(directory / "run.log");
  std::string first_word;
  return log >> first_word && first_word == "geodrop";
}

template <class Select>
std::size_t remove_files(const fs::path& directory, const Select& select) {
  std::vector<fs::path> chosen;
  for (const auto& entry : fs::directory_iterator(directory))
    if (entry.is_regular_file() && select(entry.path().filename().string())) chosen.push_back(entry.path());
  for (const fs::path& path : chosen) fs::remove(path);
  return chosen.size();
}

}  // namespace

fs::path choose_directory(const Scene& scene, const fs::path& asked_for) {
  return asked_for.empty() ? fs::path("runs") / fs::path(scene.file).stem() : asked_for;
}

void check_replaceable(const fs::path& directory) {
  const auto refuse = [&](const std::string& found) {
    throw SceneError(directory.string(),
                     {{{}, "--output", found, "a new directory or one of an earlier run", ProblemSource::elsewhere}});
  };
  if (!fs::exists(directory)) return;
  if (!fs::is_directory(directory)) refuse("a file");
  if (!fs::is_empty(directory) && !is_run_directory(directory)) refuse("a directory with other files in it");
}

std::optional<double> done_at(const fs::path& directory) {
  std::ifstream file(directory / "summary.json");
  const std::string text{std::istreambuf_iterator<char>(file), {}}, time = "\"time_s\": ";
  const std::size_t at = text.find(time);
  if (text.find("\"status\": \"done\"") == std::string::npos || at == std::string::npos) return std::nullopt;
  return std::strtod(text.c_str() + at + time.size(), nullptr);
}

std::size_t prepare_directory(const fs::path& directory) {
  std::error_code error;
  fs::create_directories(directory, error);
  if (error) throw RunError("cannot make the directory " + directory.string() + ": " + error.message());
  return remove_files(directory, [](std::string name) {
    constexpr std::string_view unfinished = ".part";  // of a run that was killed while it wrote
    if (name.ends_with(unfinished)) name.resize(name.size() - unfinished.size());
    return frame_number(name) || is_profile(name) ||
           std::find(run_files.begin(), run_files.end(), name) != run_files.end();
  });
}

std::size_t remove_frames(const fs::path& directory, std::size_t first) {
  return remove_files(directory, [&](const std::string& name) {
    const auto number = frame_number(name);
    return number && *number >= first;
  });
}

}  // namespace geodrop
