#include "particle_columns.hpp"

#include <algorithm>

namespace geodrop {

std::vector<std::string> particle_columns() {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  const Body<2> body;
  for_each_column(body, [&](const char* name, const std::vector<std::string>&, const auto&) { add(name); });
  for_each_field<particle_role::shown | particle_role::shown_if_any>(
      body, [&](const auto& entry, const auto&) { add(entry.name); });
  return names;
}

}  // namespace geodrop
