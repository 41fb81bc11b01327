// Many runs of one scene, each with settings of its own: what ensembles and sweeps share.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <deque>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace geodrop {

struct BatchOptions {
  std::string scene;
  std::vector<std::string> overrides;  ///< for all runs
  std::vector<std::string> keys;       ///< that vary; those joined by + have one value
  std::filesystem::path output;
  int jobs = 1;        ///< runs at a time, each on one thread
  std::string kind;    ///< "an ensemble", for messages
  std::string prefix;  ///< of directories: "run" makes run_001
  std::string design;  ///< what the values of the runs follow from besides scene and overrides, one per line
};

/// One of the runs.
struct Member {
  std::filesystem::path directory;
  std::vector<std::string> values;  ///< by key, as --set takes them
  std::optional<int> code;          ///< exit code, once it has ended
  std::vector<double> results;      ///< by name; NaN: none
  bool at_work = false;             ///< a process makes it now
};

class Batch {
 public:
  /// `values`: of each run, by key.
  Batch(BatchOptions options, const std::vector<std::vector<std::string>>& values);

  /// Throws SceneError if the scene refuses one of these sets of values, or has no results.
  void check(const std::vector<std::vector<std::string>>& values);
  /// Makes the directory. Throws SceneError if it holds runs of another design.
  void claim();
  /// Makes the runs: one that is done already is not made again, one that was stopped goes on, one that a process of an
  /// earlier call still writes is waited for. Writes manifest.csv at the start and end of each. Ctrl-C or SIGTERM stops
  /// the runs with a checkpoint. Returns 0, 1 if a run failed, 75 if it was stopped.
  int run();
  /// What is there, without a run.
  void look();
  /// The command of a run; empty if it is done.
  std::vector<std::string> command(const Member& member) const;

  const std::vector<Member>& members() const { return members_; }
  const std::vector<std::string>& result_names() const { return names_; }
  /// One result of all runs; NaN of those that are not done.
  std::vector<double> column(std::size_t result) const;

 private:
  /// Each key once, and none that is set for all.
  void check_keys() const;
  void make(std::size_t i, std::atomic<pid_t>& process);
  void begin(Member& member);
  void write_manifest() const;

  BatchOptions options_;
  std::vector<Member> members_;
  std::vector<std::string> names_;  ///< of results
  std::mutex mutex_;
  std::size_t ended_ = 0;
};

/// "waiting", "running", "done", "stopped", "failed".
std::string state_of(const Member& member);

/// Writes a table as CSV and prints it.
void publish(const std::filesystem::path& file, const std::vector<std::vector<std::string>>& lines);

}  // namespace geodrop
