#include "rows.hpp"

#include <algorithm>

#include "pores.hpp"
#include "scene/needs.hpp"

namespace geodrop {

template <int Dim>
Row<Dim> pore_space_row(const Scene& scene) {
  return {
      "pore_space", Data::position | Data::mass | Data::volume_ratio, Data::pore_space, any_pores(scene),
      [soils = pore_soils(scene)](const State<Dim>& s, Grids<Dim>& f, const StepContext&) { sum_grains(soils, s, f); }};
}

template <int Dim>
Row<Dim> pore_pressure_row(const Scene& scene) {
  return {"pore_pressure", Data::pore_space | Data::cell_volume | Data::cell_flags | Data::nodal_sums | Data::cut_cells,
          Data::pore_space | Data::cut_cells | Data::cell_pressure | Data::volume_rate | Data::nodal_force,
          any_pores(scene), [soils = pore_soils(scene)](const State<Dim>&, Grids<Dim>& f, const StepContext& step) {
            share_pore_pressure(soils, step.dt, f);
          }};
}

template <int Dim>
Row<Dim> pore_drag_row(const Scene& scene) {
  return {"pore_drag", Data::pore_space | Data::nodal_sums, Data::nodal_velocity | Data::velocity_change,
          any_pores(scene), [soils = pore_soils(scene)](const State<Dim>&, Grids<Dim>& f, const StepContext& step) {
            drag_pore_water(soils, step.dt, f);
          }};
}

template <int Dim>
Row<Dim> implicit_pressure_row(const Scene& scene) {
  return {"implicit_pressure",
          Data::nodal_sums | Data::nodal_velocity | Data::velocity_change | Data::cell_volume | Data::cell_flags |
              Data::volume_rate | Data::cut_cells | Data::pore_space,
          Data::nodal_velocity | Data::velocity_change | Data::largest_motion,
          std::ranges::any_of(scene.bodies, &BodySpec::implicit_pore_pressure),
          [soils = pore_soils(scene)](State<Dim>& s, Grids<Dim>& f, const StepContext& step) {
            press_implicitly(soils, step.dt, s, f);
          }};
}

template <int Dim>
Row<Dim> pore_rate_row(const Scene& scene) {
  return {"pore_rate",
          Data::nodal_velocity | Data::cell_volume | Data::cell_flags | Data::volume_rate | Data::nodal_sums,
          Data::pore_space | Data::volume_rate, any_pores(scene),
          [soils = pore_soils(scene)](const State<Dim>&, Grids<Dim>& f, const StepContext&) {
            update_pore_rate(soils, f);
          }};
}

#define GEODROP_INSTANTIATE(D)                            \
  template Row<D> pore_space_row<D>(const Scene&);        \
  template Row<D> pore_pressure_row<D>(const Scene&);     \
  template Row<D> pore_drag_row<D>(const Scene&);         \
  template Row<D> implicit_pressure_row<D>(const Scene&); \
  template Row<D> pore_rate_row<D>(const Scene&);
GEODROP_INSTANTIATE(2)
GEODROP_INSTANTIATE(3)
#undef GEODROP_INSTANTIATE

}  // namespace geodrop
