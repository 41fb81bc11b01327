// The text of a SceneError: one line per problem, in the form compilers use, so that editors can jump to it.
#include <geodrop/error.hpp>
#include <utility>

namespace geodrop {
namespace {

std::string describe(const std::string& file, const SceneProblem& problem) {
  std::string text = file;
  if (problem.at.line > 0) {
    text += ":" + std::to_string(problem.at.line) + ":" + std::to_string(problem.at.column);
  } else if (problem.source == ProblemSource::scene && !problem.key.empty()) {
    text += ": --set";
  }
  if (!problem.key.empty()) text += ": " + problem.key;
  return text + ": found " + problem.found + "; allowed: " + problem.allowed;
}

std::string describe_all(const std::string& file, const std::vector<SceneProblem>& problems) {
  std::string text;
  for (const SceneProblem& problem : problems) {
    if (!text.empty()) text += '\n';
    text += describe(file, problem);
  }
  return text;
}

}  // namespace

// NOLINTNEXTLINE(performance-unnecessary-value-param): callers hand over temporaries, and an error is made once
SceneError::SceneError(std::string file, std::vector<SceneProblem> problems)
    : std::runtime_error(describe_all(file, problems)), problems_(std::move(problems)) {}

}  // namespace geodrop
