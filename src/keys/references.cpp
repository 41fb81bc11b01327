#include "references.hpp"

#include <variant>

#include "base/nearest_name.hpp"

namespace geodrop {

bool check_reference(const std::string& key, const std::string& name, const std::vector<std::string>& known,
                     const char* kind, Report& report) {
  if (name.empty() || !report.healthy(key)) return false;
  if (std::find(known.begin(), known.end(), name) != known.end()) return true;
  report.add(key, '"' + name + '"', name_advice(name, known, kind));
  return false;
}

bool check_fluid(const Scene& scene, const std::string& key, const std::string& name, Report& report) {
  if (!check_reference(key, name, names_of(scene.materials), "materials", report)) return false;
  if (!report.healthy("materials." + name)) return false;
  if (std::holds_alternative<NewtonianSpec>(find_material(scene, name)->model)) return true;
  report.add(key, '"' + name + "\", which is no fluid", "the name of a newtonian material");
  return false;
}

}  // namespace geodrop
