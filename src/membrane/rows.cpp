#include "rows.hpp"

#include <geodrop/base/find_named.hpp>

#include <algorithm>

#include "scene/needs.hpp"

#include "anchors.hpp"
#include "even_out_nodes.hpp"
#include "fluid_load.hpp"
#include "membrane_force.hpp"
#include "move_skins.hpp"
#include "slide_membranes.hpp"
#include "surface_load.hpp"

namespace geodrop {
namespace {

/// Something holds a membrane whose interface is not sharp: of those the anchors are in cut/anchor_rows.
bool any_anchor_in_mixture(const Scene& scene) {
  return std::any_of(scene.anchors.begin(), scene.anchors.end(), [&](const AnchorSpec& anchor) {
    return find_named(scene.membranes, anchor.membrane).interface == Interface::mixture;
  });
}

}  // namespace

template <int Dim>
Row<Dim> clear_loads_row(const Scene& scene) {
  return {"clear_loads",
          {},
          Data::membrane_load,
          any_membrane_load(scene),
          [](State<Dim>& s, const Grids<Dim>&, const StepContext&) { clear_membrane_loads(s); }};
}

Row<3> surface_pressure_row(const Scene& scene) {
  return {"surface_pressure", Data::membranes | Data::membrane_position, Data::membrane_load,
          any_surface_pressure(scene),
          [fluids = still_fluids(scene)](State<3>& s, const Grids<3>&, const StepContext&) {
            add_surface_pressure(fluids, s);
          }};
}

Row<2> still_fluids_row(const Scene& scene) {
  return {"still_fluids", Data::membrane_position, Data::membrane_load, !scene.still_fluids.empty(),
          [fluids = still_fluids(scene)](State<2>& s, const Grids<2>&, const StepContext&) {
            add_still_fluids(fluids, s);
          }};
}

Row<2> even_out_nodes_row(const Scene& scene) {
  return {"even_out_nodes", Data::anchors | Data::membranes | Data::membrane_position,
          Data::membrane_position | Data::membrane_velocity | Data::membrane_cloth | Data::largest_motion,
          any_membrane_slides(scene), [](State<2>& s, const Grids<2>&, const StepContext&) { even_out_membranes(s); }};
}

Row<2> slide_membranes_row(const Scene& scene) {
  return {"slide_membranes",
          Data::anchors | Data::membranes | Data::membrane_position | Data::membrane_load | Data::water_traction |
              Data::position | Data::mass | Data::volume_ratio | Data::stress,
          Data::membrane_cloth | Data::membrane_velocity, any_membrane_slides(scene),
          [slide = MembraneSlide({scene.gravity[0], scene.gravity[1]})](
              State<2>& s, const Grids<2>& f, const StepContext&) mutable { slide.slide(s, f); }};
}

template <int Dim>
Row<Dim> membranes_to_grid_row(const Scene& scene) {
  return {"membranes_to_grid",
          Data::time | Data::membranes | Data::membrane_position | Data::membrane_velocity | Data::membrane_cloth |
              Data::membrane_load,
          Data::membrane_tension | Data::nodal_sums | Data::nodal_force, !scene.membranes.empty(),
          each_field<Dim>(
              [](State<Dim>& s, Grid<Dim>& g, const StepContext& step) { membranes_to_grid(s, g, step.t, step.dt); })};
}

template <int Dim>
Row<Dim> anchors_row(const Scene& scene) {
  return {"anchors", Data::anchors | Data::membranes | Data::membrane_position | Data::nodal_sums,
          Data::nodal_velocity | Data::velocity_change | Data::anchors, any_anchor_in_mixture(scene),
          each_field<Dim>([](State<Dim>& s, Grid<Dim>& g, const StepContext& step) { hold_anchors(s, g, step.dt); })};
}

template <int Dim>
Row<Dim> hold_remapped_row(const Scene& scene) {
  return {"hold_remapped", Data::anchors | Data::membranes | Data::membrane_position | Data::nodal_sums,
          Data::nodal_velocity | Data::velocity_change,
          scene.solver.transfer == Transfer::musl && any_anchor_in_mixture(scene),
          each_field<Dim>([](State<Dim>& s, Grid<Dim>& g, const StepContext& step) { hold_remapped(s, g, step.dt); })};
}

template <int Dim>
Row<Dim> grid_to_membranes_row(const Scene& scene) {
  return {"grid_to_membranes", Data::nodal_velocity | Data::velocity_change | Data::stage,
          Data::membrane_position | Data::membrane_velocity | Data::largest_motion, !scene.membranes.empty(),
          each_field<Dim>([solver = scene.solver](State<Dim>& s, const Grid<Dim>& g, const StepContext& step) {
            grid_to_membranes(solver, s, g, step.dt);
          })};
}

Row<2> move_skins_row(const Scene& scene) {
  return {"move_skins", Data::membranes | Data::membrane_position | Data::nodal_velocity | Data::nodal_sums,
          Data::membrane_position | Data::membrane_velocity | Data::largest_motion, any_sharp_skin(scene),
          [](State<2>& s, const Grids<2>& f, const StepContext& step) { move_skins(s, f, step.dt); }};
}

template <int Dim>
Row<Dim> grid_to_tracers_row(const Scene& scene) {
  return {"grid_to_tracers", Data::nodal_velocity, Data::tracers, any_tracer(scene),
          each_field<Dim>(
              [](State<Dim>& s, const Grid<Dim>& g, const StepContext& step) { grid_to_tracers(s, g, step.dt); })};
}

#define GEODROP_INSTANTIATE(D)                            \
  template Row<D> clear_loads_row<D>(const Scene&);       \
  template Row<D> membranes_to_grid_row<D>(const Scene&); \
  template Row<D> anchors_row<D>(const Scene&);           \
  template Row<D> hold_remapped_row<D>(const Scene&);     \
  template Row<D> grid_to_membranes_row<D>(const Scene&); \
  template Row<D> grid_to_tracers_row<D>(const Scene&);
GEODROP_INSTANTIATE(2)
GEODROP_INSTANTIATE(3)
#undef GEODROP_INSTANTIATE

}  // namespace geodrop
