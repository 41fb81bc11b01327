// Runs the program as a user does, and reads what it leaves behind.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "support/paths.hpp"
#include "support/scene_files.hpp"

namespace geodrop::test {

/// How a command ended.
struct Outcome {
  int code;  ///< exit code; 128 + signal if a signal ended it
  std::string out, err;
};

/// One run of the program in a directory of its own.
class Program {
 public:
  explicit Program(const std::vector<std::string>& arguments);
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void signal(int number) const;
  Outcome wait() const;

 private:
  TemporaryDirectory directory_;
  pid_t pid_;
};

inline Outcome run_program(const std::vector<std::string>& arguments) { return Program(arguments).wait(); }

/// A run of a scene of the repository into a temporary directory.
class SceneRun {
 public:
  enum class Begin { now, later };

  /// `settings` are those of --set; `more` any further arguments. Begun later, it runs by `again`.
  explicit SceneRun(const std::string& scene, const std::vector<std::string>& settings = {},
                    const std::vector<std::string>& more = {}, Begin begin = Begin::now)
      : scene_(scene.front() == '/' ? scene : source_path(scene)),
        settings_(settings),
        outcome_(begin == Begin::now ? go(more) : Outcome{}) {}

  const Outcome& outcome() const { return outcome_; }
  std::filesystem::path file(const std::string& name) const { return directory_ / "run" / name; }
  /// The same command into the same directory again, e.g. with --resume.
  const Outcome& again(const std::vector<std::string>& more) { return outcome_ = go(more); }

  std::vector<std::string> arguments(const std::vector<std::string>& more) const;
  std::string summary() const { return read_file(file("summary.json")); }
  /// A text that the summary holds, e.g. "status".
  std::string text(const std::string& name) const;
  std::string hash() const { return text("state_hash"); }
  /// Value of a result, else of a fact; NaN, which meets no bound, if there is none.
  double result(const std::string& name) const;
  /// A column of history.csv; throws if there is no such column.
  std::vector<double> column(const std::string& name) const;

 private:
  Outcome go(const std::vector<std::string>& more) const { return run_program(arguments(more)); }

  TemporaryDirectory directory_;
  std::string scene_;
  std::vector<std::string> settings_;
  Outcome outcome_;
};

}  // namespace geodrop::test
