#include "enclosed_rows.hpp"

#include "scene/needs.hpp"

#include "enclosed_fluid.hpp"

namespace geodrop {

Row<2> enclosed_cells_row(const Scene& scene) {
  return {"enclosed_cells", Data::membrane_position | Data::position | Data::mass | Data::volume_ratio,
          Data::enclosed_cells, any_body_with(scene, PressureSupport::enclosed),
          each_field<2>([](const State<2>& s, Grid<2>& g, const StepContext&) { update_enclosed_cells(s, g); })};
}

Row<2> enclosed_force_row(const Scene& scene) {
  return {"enclosed_force", Data::enclosed_cells | Data::position | Data::mass, Data::nodal_sums | Data::nodal_force,
          any_body_with(scene, PressureSupport::enclosed),
          each_field<2>([gravity = scene.gravity](const State<2>& s, Grid<2>& g, const StepContext& step) {
            if (!g.enclosed.empty()) enclosed_force_to_grid(s, g, gravity, step.dt);
          })};
}

Row<2> enclosed_load_row(const Scene& scene) {
  return {"enclosed_load", Data::enclosed_cells | Data::membrane_position, Data::membrane_load,
          any_body_with(scene, PressureSupport::enclosed),
          each_field<2>([](State<2>& s, const Grid<2>& g, const StepContext&) { add_fluid_loads(s, g); })};
}

Row<2> enclosed_rate_row(const Scene& scene) {
  return {
      "enclosed_rate", Data::nodal_velocity | Data::membrane_position, Data::enclosed_cells | Data::volume_ratio,
      any_body_with(scene, PressureSupport::enclosed),
      each_field<2>([](State<2>& s, Grid<2>& g, const StepContext& step) { update_enclosed_rates(s, g, step.dt); })};
}

}  // namespace geodrop
