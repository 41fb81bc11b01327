#include "check_scene.hpp"

#include "nearest_name.hpp"

namespace geodrop {

void check_scene(const Scene& scene, Report& report) {
  check_grid(scene, report);
  check_walls(scene, report);
  check_materials(scene, report);
  check_bodies(scene, report);
  check_initial_stress(scene, report);
  check_geometry(scene, report);
  check_exact(scene, report);
  check_membranes(scene, report);
  check_contacts(scene, report);
  check_still_fluids(scene, report);
  check_relaxation(scene, report);
  check_viscous_boundaries(scene, report);
  check_silent_sides(scene, report);
  check_pumps(scene, report);
  check_stages(scene, report);
  check_measurements(scene, report);
  check_output(scene, report);
}

bool check_reference(const std::string& key, const std::string& name, const std::vector<std::string>& known,
                     const char* kind, Report& report) {
  if (name.empty() || !report.healthy(key)) return false;
  if (std::find(known.begin(), known.end(), name) != known.end()) return true;
  report.add(key, '"' + name + '"', name_advice(name, known, kind));
  return false;
}

}  // namespace geodrop
