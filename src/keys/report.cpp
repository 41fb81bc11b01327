#include "report.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace geodrop {

SourceRef to_ref(const toml::source_region& region) {
  if (region.path && *region.path == kOverrideSource) return {};
  return {static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

SourceRef to_ref(const toml::node& node) {
  const SourceRef at = to_ref(node.source());
  const toml::array* list = node.as_array();
  const bool values =
      list && std::none_of(list->begin(), list->end(), [](const toml::node& x) { return x.is_table(); });
  if (values && std::any_of(list->begin(), list->end(), [](const toml::node& x) { return to_ref(x) == SourceRef{}; }))
    return {};
  return at;
}

SourceRef Report::where(std::string key) const {
  while (true) {
    if (const auto place = places_.find(key); place != places_.end()) return place->second;
    if (key.empty()) return {1, 1};
    const std::size_t dot = key.rfind('.');
    key.resize(dot == std::string::npos ? 0 : dot);
  }
}

void Report::add_at(SourceRef at, const std::string& key, std::string found, std::string allowed) {
  problems_.push_back({at, key, std::move(found), std::move(allowed)});
}

bool Report::healthy(const std::string& key) const {
  return std::none_of(problems_.begin(), problems_.end(), [&](const SceneProblem& problem) {
    return problem.key == key || problem.key.starts_with(key + '.');
  });
}

std::vector<SceneProblem> Report::problems() const {
  std::vector<SceneProblem> sorted = problems_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const SceneProblem& a, const SceneProblem& b) {
    return std::tie(a.at.line, a.at.column) < std::tie(b.at.line, b.at.column);
  });
  return sorted;
}

}  // namespace geodrop
