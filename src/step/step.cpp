// The step, row by row. docs/step.md tells the same with equations; `geodrop stages SCENE` prints the list.
#include <geodrop/step/pipeline.hpp>

#include <chrono>

#include "boundary/rows.hpp"
#include "contact/rows.hpp"
#include "cut/enclosed_rows.hpp"
#include "cut/rows.hpp"
#include "grid/rows.hpp"
#include "membrane/rows.hpp"
#include "pores/rows.hpp"
#include "rows.hpp"
#include "solutions/rows.hpp"
#include "transfer/rows.hpp"
#include "write_check.hpp"

namespace geodrop {
namespace {

// clang-format off
template <int Dim>
const std::vector<RowMaker<Dim>> rows_of_a_step = {
    stable_dt_row<Dim>,
    scene_stages_row<Dim>,
    even_out_nodes_row,
    sort_particles_row<Dim>,
    clear_grid_row<Dim>,
    cut_cells_row<Dim>,
    rigid_parts_row,
    pore_space_row<Dim>,
    cell_pressure_row<Dim>,
    interface_pressure_row<Dim>,
    even_out_volumes_row<Dim>,
    filter_checkerboard_row<Dim>,
    seep_row<Dim>,
    nodal_pressure_row<Dim>,
    enclosed_cells_row<Dim>,
    particles_to_grid_row<Dim>,
    enclosed_force_row<Dim>,
    body_force_row<Dim>,
    clear_loads_row<Dim>,
    membrane_contact_row,
    slide_membranes_row,
    enclosed_load_row<Dim>,
    still_fluids_row,
    surface_pressure_row,
    space_contact_row,
    model_drag_row,
    particle_contact_row,
    membranes_to_grid_row<Dim>,
    boundaries_to_grid_row,
    interface_force_row<Dim>,
    fold_walls_row<Dim>,
    pore_pressure_row<Dim>,
    momentum_row<Dim>,
    mass_correction_row<Dim>,
    anchors_row<Dim>,
    join_interfaces_row<Dim>,
    pore_drag_row<Dim>,
    implicit_pressure_row<Dim>,
    fill_other_sides_row<Dim>,
    out_of_balance_row<Dim>,
    remap_velocity_row<Dim>,
    hold_remapped_row<Dim>,
    volume_rate_row<Dim>,
    pore_rate_row<Dim>,
    interface_rate_row<Dim>,
    crowding_row<Dim>,
    nodal_rate_row<Dim>,
    enclosed_rate_row<Dim>,
    held_shift_row,
    eddy_length_row<Dim>,
    grid_to_particles_row<Dim>,
    hold_shift_row,
    spread_particles_row<Dim>,
    silent_sides_row,
    grid_to_membranes_row<Dim>,
    move_skins_row,
    keep_sides_row<Dim>,
    limit_unseen_row<Dim>,
    grid_to_boundaries_row,
    grid_to_tracers_row<Dim>,
    move_rigid_bodies_row<Dim>,
    pumps_row<Dim>,
    kinetic_damping_row<Dim>,
    energy_watch_row<Dim>,
};
// clang-format on

}  // namespace

template <int Dim>
Pipeline<Dim> build_pipeline(const Scene& scene) {
  Pipeline<Dim> rows;
  for (const RowMaker<Dim>& maker : rows_of_a_step<Dim>) {
    if (!maker.make) continue;
    Row<Dim> row = maker.make(scene);
    if (row.wanted) rows.push_back(std::move(row));
  }
  return rows;
}

template <int Dim>
void advance(Pipeline<Dim>& pipeline, State<Dim>& state, Grids<Dim>& grids) {
  using Clock = std::chrono::steady_clock;
  StepContext step{0, state.t, state.step};
  auto start = Clock::now();
  for (Row<Dim>& row : pipeline) {
    const WriteCheck check(row, state, grids);
    row.run(state, grids, step);
    check.end(state, grids);
    const auto end = Clock::now();
    row.seconds += std::chrono::duration<double>(end - start).count();
    start = end;
  }
  state.t += step.dt;
  ++state.step;
}

template Pipeline<2> build_pipeline<2>(const Scene&);
template Pipeline<3> build_pipeline<3>(const Scene&);
template void advance<2>(Pipeline<2>&, State<2>&, Grids<2>&);
template void advance<3>(Pipeline<3>&, State<3>&, Grids<3>&);

}  // namespace geodrop
