#include "rows.hpp"

#include "scene/needs.hpp"

#include "grid/cell_pressure.hpp"
#include "transfer_stages.hpp"

namespace geodrop {

template <int Dim>
Row<Dim> clear_grid_row(const Scene&) {
  return {"clear_grid",
          {},
          Data::nodal_sums | Data::nodal_force | Data::cell_volume | Data::cell_pressure | Data::nodal_pressure |
              Data::pore_space,
          true,
          each_field<Dim>([](const State<Dim>&, Grid<Dim>& g, const StepContext&) { clear_grid(g); })};
}

template <int Dim>
Row<Dim> cell_pressure_row(const Scene& scene) {
  const bool shift = any_body_shifts(scene);
  return {"cell_pressure",
          Data::position | Data::mass | Data::volume_ratio | Data::stress | Data::material_state | Data::rigid_share |
              Data::pore_space,
          Data::cell_volume | Data::cell_pressure | Data::cell_flags | Data::volume_rate,
          shift || any_body_with(scene, PressureSupport::cell),
          each_field<Dim>([shift](const State<Dim>& s, Grid<Dim>& g, const StepContext&) {
            if (g.cell_volume.empty()) return;
            sum_particles_in_cells(s, g);
            average_cell_pressure(s, g, shift);
          })};
}

template <int Dim>
Row<Dim> nodal_pressure_row(const Scene& scene) {
  return {"nodal_pressure", Data::position | Data::mass | Data::volume_ratio | Data::stress | Data::material_state,
          Data::nodal_pressure, any_body_with(scene, PressureSupport::nodal),
          each_field<Dim>([](const State<Dim>& s, Grid<Dim>& g, const StepContext&) {
            if (!g.node_volume.empty()) average_nodal_pressure(s, g);
          })};
}

template <int Dim>
Row<Dim> particles_to_grid_row(const Scene&) {
  return {"particles_to_grid",
          Data::position | Data::velocity | Data::affine_rate | Data::mass | Data::volume_ratio | Data::stress |
              Data::material_state | Data::cell_flags | Data::nodal_pressure,
          Data::nodal_sums | Data::nodal_force, true,
          each_field<Dim>(
              [](const State<Dim>& s, Grid<Dim>& g, const StepContext& step) { particles_to_grid(s, g, step.dt); })};
}

template <int Dim>
Row<Dim> remap_velocity_row(const Scene& scene) {
  return {"remap_velocity", Data::position | Data::mass | Data::membrane_position | Data::velocity_change,
          Data::velocity | Data::membrane_velocity | Data::nodal_sums | Data::nodal_force | Data::nodal_velocity,
          scene.solver.transfer == Transfer::musl,
          each_field<Dim>([solver = scene.solver](State<Dim>& s, Grid<Dim>& g, const StepContext& step) {
            remap_velocity(solver, s, g, step.dt);
          })};
}

template <int Dim>
Row<Dim> nodal_rate_row(const Scene& scene) {
  return {"nodal_rate", Data::position | Data::mass | Data::volume_ratio | Data::nodal_velocity, Data::nodal_pressure,
          any_body_with(scene, PressureSupport::nodal),
          each_field<Dim>([](const State<Dim>& s, Grid<Dim>& g, const StepContext&) {
            if (!g.node_volume.empty()) average_nodal_rate(s, g);
          })};
}

template <int Dim>
Row<Dim> grid_to_particles_row(const Scene& scene) {
  return {"grid_to_particles",
          Data::nodal_velocity | Data::velocity_change | Data::volume_rate | Data::crowding | Data::cell_flags |
              Data::cell_pressure | Data::nodal_pressure | Data::enclosed_cells | Data::stage,
          Data::position | Data::velocity | Data::affine_rate | Data::volume_ratio | Data::stress |
              Data::material_state | Data::largest_motion,
          true, [solver = scene.solver](State<Dim>& s, Grids<Dim>& f, const StepContext& step) {
            grid_to_particles(solver, s, f, step.dt);
          }};
}

#define GEODROP_INSTANTIATE(D)                            \
  template Row<D> clear_grid_row<D>(const Scene&);        \
  template Row<D> cell_pressure_row<D>(const Scene&);     \
  template Row<D> nodal_pressure_row<D>(const Scene&);    \
  template Row<D> particles_to_grid_row<D>(const Scene&); \
  template Row<D> remap_velocity_row<D>(const Scene&);    \
  template Row<D> nodal_rate_row<D>(const Scene&);        \
  template Row<D> grid_to_particles_row<D>(const Scene&);
GEODROP_INSTANTIATE(2)
GEODROP_INSTANTIATE(3)
#undef GEODROP_INSTANTIATE

}  // namespace geodrop
