#include "check_scene.hpp"

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
  check_anchors(scene, report);
  check_pumps(scene, report);
  check_stages(scene, report);
  check_measurements(scene, report);
  check_output(scene, report);
}

}  // namespace geodrop
