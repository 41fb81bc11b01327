#include "rows.hpp"

#include <geodrop/scene/velocity_fields.hpp>

#include "scene/needs.hpp"

#include <algorithm>

#include "cell_pressure.hpp"
#include "checkerboard.hpp"
#include "crowding.hpp"
#include "mass_correction.hpp"
#include "momentum.hpp"
#include "sort_particles.hpp"
#include "spread_particles.hpp"

namespace geodrop {

template <int Dim>
Row<Dim> sort_particles_row(const Scene&) {
  constexpr DataSet of_particles = Data::particle_order | Data::position | Data::velocity | Data::affine_rate |
                                   Data::mass | Data::volume_ratio | Data::stress | Data::material_state;
  constexpr DataSet of_sleeping_blocks = Data::nodal_sums | Data::nodal_force | Data::nodal_velocity |
                                         Data::velocity_change | Data::cell_volume | Data::cell_pressure |
                                         Data::volume_rate | Data::crowding | Data::cell_flags | Data::nodal_pressure |
                                         Data::pore_space;
  return {"sort_particles", Data::largest_motion | Data::membrane_position | Data::viscous_boundaries | Data::position,
          of_particles | of_sleeping_blocks | Data::largest_motion | Data::active_blocks, true,
          [](State<Dim>& s, Grids<Dim>& f, const StepContext&) { sort_particles_if_due(s, f); }};
}

template <int Dim>
Row<Dim> fold_walls_row(const Scene&) {
  return {"fold_walls",
          {},
          Data::nodal_sums | Data::nodal_force,
          true,
          each_field<Dim>([](const State<Dim>&, Grid<Dim>& g, const StepContext&) { fold_walls(g); })};
}

namespace {

/// By velocity field; coupled soil, whose pressure is that of its pore water, has the weight of its particles.
std::vector<Weight> weights_of_fields(const Scene& scene) {
  const std::vector<int> fields = velocity_fields(scene);
  std::vector<Weight> weights(count_velocity_fields(scene), scene.solver.weight);
  for (std::size_t b = 0; b < fields.size(); ++b)
    if (scene.bodies[b].pressure != PressureSupport::cell) weights[fields[b]] = Weight::particle;
  return weights;
}

}  // namespace

template <int Dim>
Row<Dim> momentum_row(const Scene& scene) {
  std::array<double, Dim> gravity;
  std::copy_n(scene.gravity.begin(), Dim, gravity.begin());
  return {"momentum",
          Data::nodal_sums | Data::nodal_force | Data::cell_volume | Data::cell_flags | Data::cell_pressure |
              Data::rigid_share | Data::pore_space | Data::cut_cells,
          Data::cell_pressure | Data::volume_rate | Data::nodal_velocity | Data::velocity_change | Data::rigid_share,
          true,
          each_field<Dim>(
              [gravity, weights = weights_of_fields(scene)](const State<Dim>&, Grid<Dim>& g, const StepContext& step) {
                if (g.largest_modulus > 0 && g.pore_share.empty()) soften_light_cells(g, step.dt);
                update_momentum<Dim>(g, gravity, step.dt, weights[g.field]);
              })};
}

template <int Dim>
Row<Dim> mass_correction_row(const Scene& scene) {
  return {"mass_correction", Data::nodal_sums | Data::velocity_change,
          Data::mass_correction | Data::nodal_velocity | Data::velocity_change,
          scene.solver.mass_matrix == MassMatrix::consistent,
          each_field<Dim>([](const State<Dim>&, Grid<Dim>& g, const StepContext&) { correct_mass(g); })};
}

template <int Dim>
Row<Dim> filter_checkerboard_row(const Scene& scene) {
  return {"filter_checkerboard",
          Data::position | Data::cell_volume | Data::cell_pressure | Data::cell_flags | Data::cut_cells,
          Data::volume_rate | Data::material_state,
          std::any_of(scene.bodies.begin(), scene.bodies.end(),
                      [&](const BodySpec& body) { return has_checkerboard(scene, body); }),
          [](State<Dim>& state, Grids<Dim>& grids, const StepContext& step) {
            for (Grid<Dim>& grid : grids)
              if (!grid.pore_volume.empty()) filter_checkerboard(state, grid, step.dt);
          }};
}

template <int Dim>
Row<Dim> volume_rate_row(const Scene& scene) {
  return {"volume_rate", Data::nodal_velocity | Data::cell_volume | Data::cell_flags | Data::volume_rate,
          Data::volume_rate, any_body_with(scene, PressureSupport::cell),
          each_field<Dim>([](const State<Dim>&, Grid<Dim>& g, const StepContext&) {
            if (g.largest_modulus > 0 && g.pore_share.empty()) cell_volume_rate(g);
          })};
}

template <int Dim>
Row<Dim> crowding_row(const Scene& scene) {
  return {"crowding", Data::nodal_velocity | Data::cell_flags, Data::crowding,
          std::ranges::any_of(scene.bodies, makes_room),
          each_field<Dim>([](const State<Dim>&, Grid<Dim>& g, const StepContext&) {
            if (!g.crowding.empty()) find_crowding(g);
          })};
}

template <int Dim>
Row<Dim> spread_particles_row(const Scene& scene) {
  return {"spread_particles",
          Data::largest_motion | Data::position | Data::affine_rate | Data::mass | Data::volume_ratio |
              Data::cell_flags | Data::cut_cells | Data::rigid_share | Data::pore_space,
          Data::position | Data::velocity | Data::largest_motion, any_body_shifts(scene),
          [](State<Dim>& s, const Grids<Dim>& f, const StepContext&) { spread_particles_if_due(s, f); }};
}

#define GEODROP_INSTANTIATE(D)                              \
  template Row<D> sort_particles_row<D>(const Scene&);      \
  template Row<D> fold_walls_row<D>(const Scene&);          \
  template Row<D> momentum_row<D>(const Scene&);            \
  template Row<D> mass_correction_row<D>(const Scene&);     \
  template Row<D> filter_checkerboard_row<D>(const Scene&); \
  template Row<D> volume_rate_row<D>(const Scene&);         \
  template Row<D> crowding_row<D>(const Scene&);            \
  template Row<D> spread_particles_row<D>(const Scene&);
GEODROP_INSTANTIATE(2)
GEODROP_INSTANTIATE(3)
#undef GEODROP_INSTANTIATE

}  // namespace geodrop
