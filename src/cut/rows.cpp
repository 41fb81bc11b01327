#include "rows.hpp"

#include "scene/needs.hpp"

#include <algorithm>

#include "even_out_volumes.hpp"
#include "interface_cells.hpp"
#include "interface_constraint.hpp"
#include "keep_sides.hpp"
#include "limit_unseen.hpp"
#include "model_drag.hpp"
#include "other_sides.hpp"
#include "rigid_parts.hpp"
#include "seep.hpp"

namespace geodrop {

namespace {

/// Membranes or rigid bodies cut cells.
bool cuts_cells(const Scene& scene) { return has_sharp_interface(scene) || any_fluid_at_rigid(scene); }

}  // namespace

template <int Dim>
Row<Dim> cut_cells_row(const Scene& scene) {
  return {"cut_cells", Data::membranes | Data::membrane_position,
          Data::cut_cells | Data::cell_flags | Data::cell_pressure | Data::volume_rate, cuts_cells(scene),
          [](const State<Dim>& s, Grids<Dim>& f, const StepContext&) { cut_interface_cells(s, f); }};
}

template <int Dim>
Row<Dim> interface_pressure_row(const Scene& scene) {
  return {"interface_pressure", Data::cut_cells | Data::position | Data::mass | Data::volume_ratio,
          Data::cut_cells | Data::rigid_share | Data::cell_volume | Data::cell_pressure | Data::cell_flags,
          cuts_cells(scene),
          [](const State<Dim>& s, Grids<Dim>& f, const StepContext&) { share_interface_pressure(s, f); }};
}

template <int Dim>
Row<Dim> even_out_volumes_row(const Scene& scene) {
  return {"even_out_volumes", Data::cell_pressure | Data::cell_flags | Data::position, Data::volume_ratio,
          cuts_cells(scene) || scene.solver.even_out_volumes,
          [](State<Dim>& s, const Grids<Dim>& f, const StepContext& step) { even_out_volumes(s, f, step.dt); }};
}

template <int Dim>
Row<Dim> seep_row(const Scene& scene) {
  return {"seep",
          Data::cut_cells | Data::cell_volume | Data::position | Data::volume_ratio | Data::membranes |
              Data::membrane_position | Data::water_traction,
          Data::mass | Data::velocity | Data::volume_ratio | Data::material_state,
          std::any_of(scene.membranes.begin(), scene.membranes.end(),
                      [](const MembraneSpec& membrane) { return membrane.permittivity > 0; }),
          [](State<Dim>& s, const Grids<Dim>& f, const StepContext& step) { seep(s, f, step.dt); }};
}

Row<2> rigid_parts_row(const Scene& scene) {
  return {"rigid_parts", Data::rigid_bodies | Data::contacts | Data::active_blocks, Data::rigid_share,
          any_fluid_at_rigid(scene),
          each_field<2>([](const State<2>& s, Grid<2>& g, const StepContext&) { find_rigid_parts(s, g); })};
}

Row<2> model_drag_row(const Scene& scene) {
  return {"model_drag", Data::membrane_position | Data::membrane_velocity | Data::velocity | Data::mass,
          Data::membrane_load, any_model_drag(scene),
          [](State<2>& s, const Grids<2>&, const StepContext&) { add_model_drag(s); }};
}

template <int Dim>
Row<Dim> interface_force_row(const Scene& scene) {
  return {"interface_force", Data::cut_cells | Data::cell_volume | Data::nodal_sums,
          Data::cut_cells | Data::cell_pressure | Data::nodal_force, cuts_cells(scene),
          [](const State<Dim>&, Grids<Dim>& f, const StepContext& step) { add_interface_force(f, step.dt); }};
}

template <int Dim>
Row<Dim> join_interfaces_row(const Scene& scene) {
  return {"join_interfaces",
          Data::cut_cells | Data::cell_volume | Data::cell_pressure | Data::nodal_sums | Data::active_blocks |
              Data::position | Data::mass | Data::membranes | Data::membrane_position | Data::membrane_cloth |
              Data::pore_space | Data::anchors | Data::contacts,
          Data::nodal_velocity | Data::velocity_change | Data::mass_correction | Data::water_traction | Data::anchors,
          has_sharp_interface(scene),
          [knots = std::vector<ClothKnots>()](State<Dim>& s, Grids<Dim>& f, const StepContext& step) mutable {
            join_interfaces(s, f, step.dt, knots);
          }};
}

template <int Dim>
Row<Dim> fill_other_sides_row(const Scene& scene) {
  return {"fill_other_sides", Data::cut_cells | Data::pore_space | Data::nodal_sums, Data::nodal_velocity,
          has_sharp_interface(scene) && any_body_shifts(scene),
          [](const State<Dim>& s, Grids<Dim>& f, const StepContext&) { fill_other_sides(s, f); }};
}

template <int Dim>
Row<Dim> interface_rate_row(const Scene& scene) {
  return {"interface_rate", Data::cut_cells | Data::cell_volume | Data::nodal_velocity | Data::pore_space,
          Data::volume_rate, cuts_cells(scene),
          [](const State<Dim>&, Grids<Dim>& f, const StepContext&) { update_interface_rates(f); }};
}

template <int Dim>
Row<Dim> keep_sides_row(const Scene& scene) {
  return {"keep_sides",
          Data::cut_cells | Data::membrane_position | Data::membrane_velocity | Data::mass | Data::nodal_sums |
              Data::cell_volume,
          Data::position | Data::velocity | Data::membrane_load, has_sharp_interface(scene),
          [](State<Dim>& s, const Grids<Dim>& f, const StepContext& step) { keep_sides(s, f, step.dt); }};
}

template <int Dim>
Row<Dim> limit_unseen_row(const Scene& scene) {
  return {"limit_unseen", Data::cut_cells | Data::position | Data::nodal_velocity, Data::velocity,
          has_sharp_interface(scene) && any_fluid(scene) && scene.solver.transfer == Transfer::blend,
          [](State<Dim>& s, const Grids<Dim>& f, const StepContext&) { limit_unseen(s, f); }};
}

#define GEODROP_INSTANTIATE(D)                             \
  template Row<D> cut_cells_row<D>(const Scene&);          \
  template Row<D> interface_pressure_row<D>(const Scene&); \
  template Row<D> even_out_volumes_row<D>(const Scene&);   \
  template Row<D> seep_row<D>(const Scene&);               \
  template Row<D> interface_force_row<D>(const Scene&);    \
  template Row<D> join_interfaces_row<D>(const Scene&);    \
  template Row<D> fill_other_sides_row<D>(const Scene&);   \
  template Row<D> interface_rate_row<D>(const Scene&);     \
  template Row<D> keep_sides_row<D>(const Scene&);         \
  template Row<D> limit_unseen_row<D>(const Scene&);
GEODROP_INSTANTIATE(2)
GEODROP_INSTANTIATE(3)
#undef GEODROP_INSTANTIATE

}  // namespace geodrop
