// The two ways in which a run can go wrong for a reason that is not a programmer's mistake.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace geodrop {

/// Where something stands in the scene file; line 0 means "not from a file" (a --set override).
struct SourceRef {
  int line = 0;
  int column = 0;
  bool operator==(const SourceRef&) const = default;
};

/// One mistake of the user: where, which key, what was found, what is allowed.
struct SceneProblem {
  SourceRef at;
  std::string key;      ///< full key, e.g. "materials.water.density"
  std::string found;    ///< what was found, e.g. "-1000"
  std::string allowed;  ///< what is allowed, e.g. "a density > 0 [kg/m3]"
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

}  // namespace geodrop
