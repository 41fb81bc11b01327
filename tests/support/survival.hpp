// Runs that are interrupted in one way or another, and whether they leave what an uninterrupted one leaves.
#pragma once

#include <doctest/doctest.h>

#include <filesystem>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "support/program.hpp"
#include "support/text.hpp"

namespace geodrop::test {

inline const std::string drop = "cases/dump_kekerdom.toml";

/// A drop of about a second on an idle core, with water, soil, membrane, contact and frames; `more` settings beside.
inline std::vector<std::string> short_drop(const std::vector<std::string>& more = {}) {
  std::vector<std::string> settings{"grid.refine=[]", "time.end=0.4", "output.frame_interval=0.02",
                                    "output.history_interval=0.005", "output.checkpoint_interval=0.05"};
  settings.insert(settings.end(), more.begin(), more.end());
  return settings;
}

/// Content of every file of a run that was done, but log, which tells of interruptions, and summary, which tells of
/// wall time.
inline std::map<std::string, std::string> files_of(const SceneRun& run) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(run.file("")))
    files[entry.path().filename().string()] = read_file(entry.path());
  files.erase("run.log");
  files.erase("summary.json");
  return files;
}

/// The same state, the same files, each the same bytes: frames, collections, rows, checkpoint.
inline void check_same(const SceneRun& run, const SceneRun& whole) {
  CHECK(run.text("status") == "done");
  CHECK(run.hash() == whole.hash());
  const auto files = files_of(run), expected = files_of(whole);
  for (const auto& [name, content] : expected) {
    CAPTURE(name);
    REQUIRE(files.count(name) == 1);
    CHECK((files.at(name) == content));  // in parentheses: not to be printed
  }
  for (const auto& [name, content] : files) CHECK_MESSAGE(expected.count(name) == 1, name);
}

/// Whether `condition` came true within a minute.
template <class Condition>
bool wait_for(const Condition& condition) {
  constexpr std::chrono::milliseconds pause{2};
  for (int k = 0; k < 30000; ++k) {
    if (condition()) return true;
    std::this_thread::sleep_for(pause);
  }
  return false;
}

inline bool wait_for_file(const std::filesystem::path& path) {
  return wait_for([&] { return std::filesystem::exists(path); });
}

/// Exit code of a shell's command.
inline int shell(const std::string& command) {
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// The program with these arguments, for a shell.
inline std::string in_shell(const std::vector<std::string>& arguments) {
  std::string command = "'" + program_path + "'";
  for (const std::string& argument : arguments) command += " '" + argument + "'";
  return command;
}

}  // namespace geodrop::test
