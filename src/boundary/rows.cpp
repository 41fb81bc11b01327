#include "rows.hpp"

#include "scene/needs.hpp"

#include "eddy_length.hpp"
#include "silent_side.hpp"
#include "viscous_boundary.hpp"

namespace geodrop {

Row<2> boundaries_to_grid_row(const Scene& scene) {
  return {"boundaries_to_grid", Data::viscous_boundaries, Data::nodal_sums | Data::nodal_force,
          !scene.viscous_boundaries.empty(), each_field<2>([](const State<2>& s, Grid<2>& g, const StepContext& step) {
            boundaries_to_grid(s, g, step.dt);
          })};
}

template <int Dim>
Row<Dim> eddy_length_row(const Scene& scene) {
  return {"eddy_length", Data::position | Data::membranes | Data::membrane_position, Data::material_state,
          any_mixing_length(scene),
          [outlines = NearOutlines<Dim>()](State<Dim>& s, const Grids<Dim>& f, const StepContext&) mutable {
            limit_eddies(f.front().layout, outlines, s);
          }};
}
template Row<2> eddy_length_row<2>(const Scene&);
template Row<3> eddy_length_row<3>(const Scene&);

Row<2> silent_sides_row(const Scene& scene) {
  return {"silent_sides", Data::position,
          Data::absorbing_layers | Data::velocity | Data::mass | Data::volume_ratio | Data::energy_budget,
          !scene.silent_sides.empty(), [](State<2>& s, const Grids<2>& f, const StepContext& step) {
            fade_at_silent_sides(f.front().layout, step.dt, s);
          }};
}

Row<2> grid_to_boundaries_row(const Scene& scene) {
  return {"grid_to_boundaries", Data::nodal_velocity, Data::viscous_boundaries | Data::largest_motion,
          !scene.viscous_boundaries.empty(), each_field<2>([](State<2>& s, const Grid<2>& g, const StepContext& step) {
            grid_to_boundaries(s, g, step.dt);
          })};
}

}  // namespace geodrop
