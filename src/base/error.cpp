// The text of a SceneError: one line per problem, in the form compilers use, so that editors can jump to it.
#include <algorithm>
#include <geodrop/base/error.hpp>
#include <utility>

namespace geodrop {
namespace {

/// What was found may be a text of a megabyte and of many lines: the first of it in one line, without half a letter of
/// UTF-8 at the end.
std::string shortened(const std::string& text) {
  constexpr std::size_t most = 200;
  std::size_t end = std::min(most, text.size());
  while (end > 0 && end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  std::string line = text.substr(0, end);
  std::replace_if(
      line.begin(), line.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
  return end < text.size() ? line + "... (" + std::to_string(text.size()) + " characters)" : line;
}

std::string describe(const std::string& file, const SceneProblem& problem) {
  std::string text = file;
  if (problem.at.line > 0) {
    text += ":" + std::to_string(problem.at.line) + ":" + std::to_string(problem.at.column);
  } else if (problem.source == ProblemSource::scene && !problem.key.empty()) {
    text += ": --set";
  }
  if (!problem.key.empty()) text += ": " + shortened(problem.key);
  return text + ": found " + shortened(problem.found) + "; allowed: " + problem.allowed;
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
