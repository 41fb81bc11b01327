#include "run_directory.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <geodrop/base/error.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/atomic_file.hpp"
#include "run_record.hpp"
#include "vtk_files.hpp"

namespace geodrop {
namespace {

namespace fs = std::filesystem;

constexpr std::array run_files = {"run.log",
                                  "scene.toml",
                                  "history.csv",
                                  "hashes.csv",
                                  "parts.csv",
                                  "summary.json",
                                  "checkpoint.bin",
                                  "checkpoint.previous.bin",
                                  "checkpoint.next.bin",
                                  "checkpoint.reserve",
                                  "particles.pvd",
                                  "membranes.pvd",
                                  "rigid.pvd",
                                  "history.svg",
                                  "history.png",
                                  "columns.svg",
                                  "columns.png",
                                  "report.html",
                                  "report.pdf",
                                  "animation.gif",
                                  "frames.vtkhdf"};

constexpr std::array<std::pair<std::string_view, std::string_view>, 3> frame_kinds = {
    {{"particles", "vtu"}, {"membranes", "vtp"}, {"rigid", "vtp"}}};

/// Number of a frame from its file name; empty if it is not a frame's.
std::optional<std::size_t> frame_number(std::string_view name) {
  for (const auto& [kind, extension] : frame_kinds) {
    const std::string before = std::string(kind) + "_", after = "." + std::string(extension);
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
         ((name.starts_with("section_") || name.starts_with("snapshot_")) && is_picture);
}

/// Whether a run gives this name to one of its files, whole or not.
bool is_run_file(std::string name) {
  constexpr std::string_view unfinished = ".part";  // of a run that was killed while it wrote
  if (name.ends_with(unfinished)) name.resize(name.size() - unfinished.size());
  return frame_number(name) || is_profile(name) ||
         std::find(run_files.begin(), run_files.end(), name) != run_files.end();
}

bool holds_only_run_files(const fs::path& directory) {
  return std::all_of(fs::directory_iterator(directory), fs::directory_iterator(), [](const fs::directory_entry& entry) {
    const std::string name = entry.path().filename().string();
    return name == RunLock::file_name || is_run_file(name);
  });
}

/// Every run takes its lock and begins its log with the program's name, before it writes anything else. A run that was
/// killed in between, or by a power cut, leaves a log with nothing in it.
bool is_run_directory(const fs::path& directory) {
  const fs::path log_path = directory / "run.log";
  std::ifstream log(log_path);
  std::string first_word;
  if (log >> first_word) return first_word == "geodrop";
  return (fs::exists(directory / RunLock::file_name) || fs::exists(log_path)) && holds_only_run_files(directory);
}

/// Nothing but what a run leaves that was killed before its first line.
bool holds_nothing(const fs::path& directory) {
  return std::all_of(fs::directory_iterator(directory), fs::directory_iterator(), [](const fs::directory_entry& entry) {
    const std::string name = entry.path().filename().string();
    return name == RunLock::file_name || (name == "run.log" && fs::file_size(entry.path()) == 0);
  });
}

template <class Select>
std::size_t remove_files(const fs::path& directory, const Select& select) {
  std::vector<fs::path> chosen;
  for (const auto& entry : fs::directory_iterator(directory))
    if (entry.is_regular_file() && select(entry.path().filename().string())) chosen.push_back(entry.path());
  for (const fs::path& path : chosen) fs::remove(path);
  return chosen.size();
}

[[noreturn]] void refuse_output(const fs::path& directory, const std::string& found, const std::string& allowed) {
  throw SceneError(directory.string(), {{{}, "--output", found, allowed, ProblemSource::elsewhere}});
}

void check_replaceable(const fs::path& directory) {
  constexpr const char* allowed = "a new directory or one of an earlier run";
  if (!fs::exists(directory)) return;
  if (!fs::is_directory(directory)) refuse_output(directory, "a file", allowed);
  if (!fs::is_empty(directory) && !is_run_directory(directory))
    refuse_output(directory, "a directory with other files in it", allowed);
}

void make_directory(const fs::path& directory) {
  std::error_code error;
  fs::create_directories(directory, error);
  if (error) throw WriteError("cannot make the directory " + directory.string() + ": " + error.message());
}

/// One more than the largest N of the directories NAME.N beside it.
int next_number(const fs::path& directory) {
  const std::string before = directory.filename().string() + ".";
  int next = 1;
  for (const auto& entry : fs::directory_iterator(directory.parent_path())) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(before)) continue;
    const char* const end = name.data() + name.size();
    int number = 0;
    if (std::from_chars(name.data() + before.size(), end, number).ptr == end) next = std::max(next, number + 1);
  }
  return next;
}

/// Renames `real`, which is the directory or what a link of that name leads to. Returns the new name.
std::string move_aside(const fs::path& directory, const fs::path& real) {
  const fs::path here = fs::current_path();
  if (std::mismatch(real.begin(), real.end(), here.begin(), here.end()).first == real.end())
    refuse_output(directory, "an earlier run in the directory in which this command runs",
                  "--overwrite, or another directory");
  std::error_code error;
  std::string aside = real.string() + "." + std::to_string(next_number(real));
  fs::rename(real, aside, error);
  if (error)
    throw WriteError("cannot move the earlier run in " + directory.string() + " aside: " + error.message() +
                     "; --overwrite replaces it");
  sync_directory(real.parent_path());
  return aside;
}

}  // namespace

fs::path choose_directory(const Scene& scene, const fs::path& asked_for) {
  return asked_for.empty() ? fs::path("runs") / fs::path(scene.file).stem() : asked_for;
}

std::optional<double> done_at(const fs::path& directory) {
  const std::optional<RunRecord> record = find_run_record(directory);
  return record && record->status == status_name(RunStatus::done) ? std::optional(record->run.t) : std::nullopt;
}

RunPlace take_for_new_run(const fs::path& directory, EarlierRun earlier) {
  check_replaceable(directory);
  make_directory(directory);
  RunLock lock(directory);
  if (holds_nothing(directory)) return {std::move(lock), ""};
  if (earlier == EarlierRun::overwrite) {
    const std::size_t removed = remove_files(directory, is_run_file);
    return {std::move(lock),
            "replaced an earlier run in " + directory.string() + " (" + std::to_string(removed) + " files)"};
  }
  const fs::path real = fs::canonical(directory);
  const std::string aside = move_aside(directory, real);
  make_directory(real);
  return {RunLock(directory), "an earlier run in " + directory.string() + " was moved aside, to " + aside};
}

void cut_back_frames(const fs::path& directory, const std::vector<double>& times) {
  for (const auto& [kind, extension] : frame_kinds)
    if (fs::exists(directory / (std::string(kind) + ".pvd")))
      write_collection(directory, std::string(kind), std::string(extension), times);
  remove_files(directory, [&](const std::string& name) {
    const auto number = frame_number(name);
    return number && *number >= times.size();
  });
}

}  // namespace geodrop
