#include "option_errors.hpp"

#include <algorithm>
#include <iostream>

namespace geodrop {

void tell_doubts(const std::vector<std::string>& doubts) {
  for (const std::string& doubt : doubts)
    if (!doubt.empty()) std::cerr << "geodrop: warning: " << doubt << '\n';
}

void OptionErrors::refuse(const std::string& option, const std::string& found, const std::string& allowed) const {
  throw SceneError(command, {{{}, option, found, allowed, ProblemSource::elsewhere}});
}

Given OptionErrors::all_or_none(const std::vector<Option>& options) const {
  std::string names, found;
  for (const Option& option : options) {
    names += (names.empty() ? "" : ", ") + std::string(option.name);
    if (option.value) found += (found.empty() ? "only " : " and ") + std::string(option.name);
  }
  const bool has_all = std::all_of(options.begin(), options.end(), [](const Option& o) { return o.value.has_value(); });
  if (!has_all && !found.empty()) refuse(names, found, "all or none");
  return has_all ? Given::all : Given::none;
}

void OptionErrors::refuse_by_option(const SceneError& error) const {
  std::vector<SceneProblem> problems = error.problems();
  for (SceneProblem& problem : problems)
    if (!problem.key.starts_with("--")) problem.key = "--" + problem.key;
  throw SceneError(command, problems);
}

}  // namespace geodrop
