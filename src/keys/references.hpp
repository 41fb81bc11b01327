// Names by which one part of a scene refers to another.
#pragma once

#include "report.hpp"

#include <geodrop/scene/scene.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace geodrop {

/// The different names of a list of bodies, materials, membranes or results, without empty ones.
template <class List>
std::vector<std::string> names_of(const List& list) {
  std::vector<std::string> names;
  for (const auto& element : list) {
    const bool is_new = std::find(names.begin(), names.end(), element.name) == names.end();
    if (!element.name.empty() && is_new) names.push_back(element.name);
  }
  return names;
}

/// Reports a name that is not among the known ones; says whether it is.
bool check_reference(const std::string& key, const std::string& name, const std::vector<std::string>& known,
                     const char* kind, Report& report);

/// The same for a name that must be a newtonian material.
bool check_fluid(const Scene& scene, const std::string& key, const std::string& name, Report& report);

}  // namespace geodrop
