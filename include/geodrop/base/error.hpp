// The ways in which a run can go wrong for a reason that is not a programmer's mistake.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace geodrop {

/// Where something stands in the scene file; line 0 means "not from the file": a --set override,
/// or no place at all if the problem's source is elsewhere.
struct SourceRef {
  int line = 0;
  int column = 0;
  bool operator==(const SourceRef&) const = default;
};

/// What a mistake is about: the scene, which consists of its file and of the overrides by --set, or anything else, such
/// as a checkpoint or a directory.
enum class ProblemSource { scene, elsewhere };

/// One mistake of the user: where, which key, what was found, what is allowed.
struct SceneProblem {
  SourceRef at;
  std::string key;      ///< full key, e.g. "materials.water.density"
  std::string found;    ///< what was found, e.g. "-1000"
  std::string allowed;  ///< what is allowed, e.g. "a density > 0 [kg/m3]"
  ProblemSource source = ProblemSource::scene;
};

/// The user's input is wrong; carries every problem that was found. Exit code 2.
class SceneError : public std::runtime_error {
 public:
  SceneError(std::string file, std::vector<SceneProblem> problems);
  const std::vector<SceneProblem>& problems() const { return problems_; }

 private:
  std::vector<SceneProblem> problems_;
};

/// The run broke (NaN, particle outside, collapsed time step); the last frame is kept. Exit code 1.
class RunError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The disk does not take what is to be written: full, read-only, gone. Exit code 74.
class WriteError : public RunError {
 public:
  using RunError::RunError;
};

}  // namespace geodrop
