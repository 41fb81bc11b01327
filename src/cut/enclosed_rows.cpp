#include "enclosed_rows.hpp"

#include "scene/needs.hpp"

#include "enclosed_fluid.hpp"

namespace geodrop {

template <int Dim>
Row<Dim> enclosed_cells_row(const Scene& scene) {
  return {"enclosed_cells", Data::membrane_position | Data::position | Data::mass | Data::volume_ratio,
          Data::enclosed_cells, any_body_with(scene, PressureSupport::enclosed),
          each_field<Dim>([](const State<Dim>& s, Grid<Dim>& g, const StepContext&) { update_enclosed_cells(s, g); })};
}

template <int Dim>
Row<Dim> enclosed_force_row(const Scene& scene) {
  return {"enclosed_force", Data::enclosed_cells | Data::position | Data::mass, Data::nodal_sums | Data::nodal_force,
          any_body_with(scene, PressureSupport::enclosed),
          each_field<Dim>([gravity = scene.gravity](const State<Dim>& s, Grid<Dim>& g, const StepContext& step) {
            if (!g.enclosed.empty()) enclosed_force_to_grid(s, g, gravity, step.dt);
          })};
}

template <int Dim>
Row<Dim> enclosed_load_row(const Scene& scene) {
  return {"enclosed_load", Data::enclosed_cells | Data::membrane_position, Data::membrane_load,
          any_body_with(scene, PressureSupport::enclosed),
          each_field<Dim>([](State<Dim>& s, const Grid<Dim>& g, const StepContext&) { add_fluid_loads(s, g); })};
}

template <int Dim>
Row<Dim> enclosed_rate_row(const Scene& scene) {
  return {"enclosed_rate", Data::nodal_velocity | Data::membrane_position, Data::enclosed_cells | Data::volume_ratio,
          any_body_with(scene, PressureSupport::enclosed),
          each_field<Dim>(
              [](State<Dim>& s, Grid<Dim>& g, const StepContext& step) { update_enclosed_rates(s, g, step.dt); })};
}

#define GEODROP_INSTANTIATE(D)                         \
  template Row<D> enclosed_cells_row<D>(const Scene&); \
  template Row<D> enclosed_force_row<D>(const Scene&); \
  template Row<D> enclosed_load_row<D>(const Scene&);  \
  template Row<D> enclosed_rate_row<D>(const Scene&);
GEODROP_INSTANTIATE(2)
GEODROP_INSTANTIATE(3)
#undef GEODROP_INSTANTIATE

}  // namespace geodrop
