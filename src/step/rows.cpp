#include "rows.hpp"

#include <geodrop/step/pipeline.hpp>

#include "energy_watch.hpp"
#include "pumps.hpp"
#include "relaxation.hpp"
#include "setup/scene_stages.hpp"
#include "solutions/body_force.hpp"
#include "stable_dt.hpp"

namespace geodrop {
namespace {

bool relaxes(const Scene& scene) { return scene.relaxation.damping == RelaxationSpec::Damping::kinetic; }

}  // namespace

template <int Dim>
Row<Dim> stable_dt_row(const Scene& scene) {
  return {"stable_dt",
          Data::velocity | Data::volume_ratio | Data::stress | Data::material_state | Data::membranes | Data::contacts |
              Data::rigid_bodies | Data::largest_motion | Data::stage,
          Data::time_step, true,
          [limit = StepLimits(scene)](const State<Dim>& s, const Grids<Dim>& f, StepContext& step) {
            step.dt = stable_dt(limit, s, f.front().layout);
          }};
}

template <int Dim>
Row<Dim> scene_stages_row(const Scene& scene) {
  return {"scene_stages", Data::time | Data::position | Data::mass | Data::volume_ratio,
          Data::bodies | Data::membranes | Data::rigid_bodies | Data::stage | Data::relaxation | Data::largest_motion |
              Data::tracers | Data::viscous_boundaries,
          !scene.stages.empty(),
          [in_time = SceneStages(scene)](State<Dim>& s, const Grids<Dim>& f, const StepContext&) {
            const std::uint64_t before = s.stages_entered;
            enter_due_stages(in_time, s);
            if (s.stages_entered > before) refuse_full_cells(in_time, before, s, f.front().layout);
          }};
}

template <int Dim>
Row<Dim> out_of_balance_row(const Scene& scene) {
  return {"out_of_balance", Data::nodal_sums | Data::velocity_change, Data::relaxation, relaxes(scene),
          [gravity = scene.gravity](State<Dim>& s, const Grids<Dim>& f, const StepContext& step) {
            measure_balance(gravity, step.dt, s, f);
          }};
}

template <int Dim>
Row<Dim> pumps_row(const Scene& scene) {
  return {"pumps", Data::time | Data::position | Data::velocity,
          Data::mass | Data::volume_ratio | Data::relaxation | Data::energy_budget, !scene.pumps.empty(),
          [pumps = scene.pumps, gravity = energy_sources(scene).gravity](
              State<Dim>& s, const Grids<Dim>&, const StepContext& step) { pump_fluid(pumps, gravity, step, s); }};
}

template <int Dim>
Row<Dim> kinetic_damping_row(const Scene& scene) {
  return {"kinetic_damping", Data::mass | Data::position,
          Data::relaxation | Data::velocity | Data::affine_rate | Data::membrane_velocity | Data::viscous_boundaries |
              Data::absorbing_layers,
          relaxes(scene),
          [spec = scene.relaxation, gravity = scene.gravity](State<Dim>& s, const Grids<Dim>&, const StepContext&) {
            damp_kinetically(spec, gravity, s);
          }};
}

template <int Dim>
Row<Dim> energy_watch_row(const Scene& scene) {
  return {"energy_watch",
          Data::mass | Data::position | Data::velocity | Data::volume_ratio | Data::stress | Data::material_state |
              Data::membranes | Data::membrane_position | Data::membrane_tension | Data::contacts |
              Data::viscous_boundaries,
          Data::energy_budget, driven_bodies<Dim>(scene).empty(),
          [sources = energy_sources(scene)](State<Dim>& s, const Grids<Dim>&, const StepContext& step) {
            watch_energy(sources, step, s);
          }};
}

#define GEODROP_INSTANTIATE(D)                          \
  template Row<D> stable_dt_row<D>(const Scene&);       \
  template Row<D> scene_stages_row<D>(const Scene&);    \
  template Row<D> out_of_balance_row<D>(const Scene&);  \
  template Row<D> pumps_row<D>(const Scene&);           \
  template Row<D> kinetic_damping_row<D>(const Scene&); \
  template Row<D> energy_watch_row<D>(const Scene&);
GEODROP_INSTANTIATE(2)
GEODROP_INSTANTIATE(3)
#undef GEODROP_INSTANTIATE

}  // namespace geodrop
