// The step, stage by stage. docs/step.md tells the same with equations; `geodrop stages SCENE` prints the list.
#include <algorithm>
#include <chrono>
#include <geodrop/pipeline.hpp>
#include <type_traits>

#include "../boundary/silent_side.hpp"
#include "../boundary/viscous_boundary.hpp"
#include "../contact/membrane_contact.hpp"
#include "../contact/surface_contact.hpp"
#include "../enclosed/enclosed_fluid.hpp"
#include "../exact/body_force.hpp"
#include "../grid/cell_pressure.hpp"
#include "../grid/mass_correction.hpp"
#include "../grid/momentum.hpp"
#include "../grid/sort_particles.hpp"
#include "../interface/interface_cells.hpp"
#include "../interface/interface_constraint.hpp"
#include "../interface/keep_sides.hpp"
#include "../interface/model_drag.hpp"
#include "../kernels/transfer_stages.hpp"
#include "../membrane/fluid_load.hpp"
#include "../membrane/membrane_force.hpp"
#include "../probes/probes.hpp"
#include "energy_watch.hpp"
#include "pumps.hpp"
#include "relaxation.hpp"
#include "scene_stages.hpp"

namespace geodrop {
namespace {

bool any_body(const Scene& scene, bool (*has)(const BodySpec&)) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(), has);
}

bool has_tracers(const Scene& scene) {
  return std::any_of(scene.probes.begin(), scene.probes.end(),
                     [](const ProbeSpec& p) { return std::holds_alternative<TracerSpec>(p.probe); });
}

bool has_contact(const Scene& scene, ContactPair::Kind kind) {
  return std::any_of(scene.contacts.begin(), scene.contacts.end(),
                     [&](const ContactSpec& contact) { return contact_pair(scene, contact).kind == kind; });
}

}  // namespace

template <int Dim>
Pipeline<Dim> build_pipeline(const Scene& scene) {
  using S = State<Dim>;
  using G = Grid<Dim>;
  using Fields = Grids<Dim>;
  using C = StepContext;
  const bool shift = any_body(scene, [](const BodySpec& b) { return b.shift; });
  const bool cell_pressure = any_body(scene, [](const BodySpec& b) { return b.pressure == PressureSupport::cell; });
  const bool nodal_pressure = any_body(scene, [](const BodySpec& b) { return b.pressure == PressureSupport::nodal; });
  const bool musl = scene.solver.transfer == Transfer::musl;
  const bool consistent = scene.solver.mass_matrix == MassMatrix::consistent;
  const bool membranes = !scene.membranes.empty();
  const bool enclosed = any_body(scene, [](const BodySpec& b) { return b.pressure == PressureSupport::enclosed; });
  const bool skin_contact =
      has_contact(scene, ContactPair::Kind::membrane_on_rigid) || has_contact(scene, ContactPair::Kind::membranes);
  const bool bare_contact = has_contact(scene, ContactPair::Kind::body_on_rigid);
  const bool model_drag = std::any_of(scene.membranes.begin(), scene.membranes.end(),
                                      [](const MembraneSpec& membrane) { return membrane.drag_coefficient > 0; });
  const bool loads = enclosed || skin_contact || model_drag || !scene.still_fluids.empty();
  const bool rigid_moves = std::any_of(scene.rigid.begin(), scene.rigid.end(), [](const RigidSpec& rigid) {
    return !std::holds_alternative<std::monostate>(rigid.motion);
  });
  const bool sharp = has_sharp_interface(scene);
  const std::vector<RigidSpec> rigid = scene.rigid;
  const std::vector<StillFluid> fluids = still_fluids(scene);
  const bool silent = !scene.silent_sides.empty();
  const bool viscous = !scene.viscous_boundaries.empty();
  const std::vector<PumpSpec> pumps = scene.pumps;
  const RelaxationSpec relaxation = scene.relaxation;
  const bool relaxes = relaxation.damping == RelaxationSpec::Damping::kinetic;
  const SolverSpec solver = scene.solver;
  const std::vector<DrivenBody> driven = driven_bodies<Dim>(scene);
  std::array<double, Dim> gravity;
  std::copy_n(scene.gravity.begin(), Dim, gravity.begin());
  const Point g_vector = scene.gravity;
  const double h = scene.grid.spacing;

  Pipeline<Dim> p;
  const auto add = [&p](bool wanted, std::string name, std::string flow, auto run) {
    if (!wanted) return;
    if constexpr (std::is_invocable_v<decltype(run), S&, G&, const C&>)  // what one velocity field needs, each needs
      p.push_back({std::move(name), std::move(flow),
                   [run](S& s, Fields& fields, const C& c) {
                     for (G& g : fields) run(s, g, c);
                   },
                   0.0});
    else
      p.push_back({std::move(name), std::move(flow), run, 0.0});
  };
  const bool cells = cell_pressure || shift;
  const SceneStages in_time(scene);
  // clang-format off
  add(!scene.stages.empty(), "scene_stages", "time -> bodies placed, rigid bodies moved or removed, damping", [in_time](S& s, Fields&, const C&) { enter_due_stages(in_time, s); });
  add(true,          "sort_particles",    "positions -> order of all particle arrays, active blocks", [](S& s, Fields& f, const C&) { sort_particles_if_due(s, f); });
  add(true,          "clear_grid",        "-> zero sums in active blocks",                             [](S&, G& g, const C&) { clear_grid(g); });
  add(sharp,         "cut_cells",         "membrane nodes -> what both sides have of cells",           [](S& s, Fields& f, const C&) { cut_interface_cells(s, f); });
  add(cells,         "cell_pressure",     "volume, pressure -> cell pressure, fill, flags",            [shift](S& s, G& g, const C&) { if (g.cell_volume.empty()) return; sum_particles_in_cells(s, g); average_cell_pressure(s, g, shift); });
  add(sharp,         "interface_pressure", "cut cells, volume -> pressure of their parts",             [](S& s, Fields& f, const C&) { share_interface_pressure(s, f); });
  add(sharp,         "even_out_volumes",  "cell pressure -> volume ratio of fluid particles",          [](S& s, Fields& f, const C& c) { even_out_volumes(s, f, c.dt); });
  add(nodal_pressure, "nodal_pressure",   "volume, pressure -> mean pressure of nodes",                [](S& s, G& g, const C&) { if (!g.node_volume.empty()) average_nodal_pressure(s, g); });
  add(enclosed,      "enclosed_cells",    "volume, membrane nodes -> cut cells, their pressure",       [](S& s, G& g, const C&) { update_enclosed_cells(s, g); });
  add(true,          "particles_to_grid", "mass, velocity, affine rate, stress -> nodal sums, force",  [](S& s, G& g, const C& c) { particles_to_grid(s, g, c.dt); });
  add(enclosed,      "enclosed_force",    "cut cells, their pressure -> nodal sums or force",          [g_vector](S& s, G& g, const C& c) { if (!g.enclosed.empty()) enclosed_force_to_grid(s, g, g_vector, c.dt); });
  add(!driven.empty(), "body_force",      "initial position, time -> nodal sums or force",            [driven](S& s, G& g, const C& c) { body_force_to_grid(driven, s, g, c); });
  add(loads,         "membrane_loads",    "membrane nodes, cells -> loads of contact, fluid, drag; slip", [fluids](S& s, Fields& f, const C& c) { clear_membrane_loads(s); add_contact_forces(s, c.dt); add_membrane_contacts(s, c.dt); for (const G& g : f) add_fluid_loads(s, g); add_still_fluids(fluids, s); add_model_drag(s); });
  add(bare_contact,  "particle_contact",  "particles at rigid bodies -> nodal sums or force, slip",    [](S& s, G& g, const C& c) { contact_to_grid(s, g, c.dt); });
  add(membranes,     "membranes_to_grid", "membrane nodes -> tension, nodal sums, force",              [](S& s, G& g, const C& c) { membranes_to_grid(s, g, c.dt); });
  add(viscous,       "boundaries_to_grid", "points of viscous boundaries -> nodal sums or force",      [](S& s, G& g, const C& c) { boundaries_to_grid(s, g, c.dt); });
  add(sharp,         "interface_force",   "pressure of parts of cells -> force",                       [](S&, Fields& f, const C&) { add_interface_force(f); });
  add(true,          "momentum",          "nodal sums, force, cell pressure -> nodal velocity",        [gravity](S&, G& g, const C& c) { fold_walls(g); update_momentum<Dim>(g, gravity, c.dt); });
  add(consistent,    "mass_correction",   "nodal velocity change -> nodal velocity, its change",       [](S&, G& g, const C&) { correct_mass(g); });
  add(sharp,         "join_interfaces",   "nodal velocities on both sides -> the same, with one normal velocity; pressure on membranes", [](S& s, Fields& f, const C& c) { join_interfaces(s, f, c.dt); });
  add(sharp && shift, "fill_other_sides", "cut cells -> fill ratio of nodes beside membranes",         [](S& s, Fields& f, const C&) { fill_other_sides(s, f); });
  add(relaxes,       "out_of_balance",    "nodal velocity change -> out-of-balance ratio",             [g_vector](S& s, Fields& f, const C& c) { measure_balance(g_vector, c.dt, s, f); });
  add(musl,          "remap_velocity",    "nodal velocity -> particle velocity -> nodal velocity",     [solver](S& s, G& g, const C& c) { remap_velocity(solver, s, g, c.dt); });
  add(cell_pressure, "volume_rate",       "nodal velocity -> volume rate of filled cells",             [](S&, G& g, const C&) { if (!g.cell_volume.empty()) cell_volume_rate(g); });
  add(sharp,         "interface_rate",    "nodal velocities -> volume rate of parts of cells",         [](S&, Fields& f, const C&) { update_interface_rates(f); });
  add(nodal_pressure, "nodal_rate",       "nodal velocity -> mean volume rate of nodes",               [](S& s, G& g, const C&) { if (!g.node_volume.empty()) average_nodal_rate(s, g); });
  add(enclosed,      "enclosed_rate",     "nodal velocity -> volume rate of enclosed cells",           [](S& s, G& g, const C& c) { update_enclosed_rates(s, g, c.dt); });
  add(true,          "grid_to_particles", "nodal velocity, volume rate -> position, velocity, stress", [solver](S& s, Fields& f, const C& c) { grid_to_particles(solver, s, f, c.dt); });
  add(silent,        "silent_sides",      "particles at silent sides -> flow beyond; their velocity, mass, volume ratio", [](S& s, Fields& f, const C& c) { fade_at_silent_sides(f.front().layout, c.dt, s); });
  add(membranes,     "grid_to_membranes", "nodal velocity -> membrane nodes",                          [solver](S& s, G& g, const C& c) { grid_to_membranes(solver, s, g, c.dt); });
  add(sharp,         "keep_sides",        "membrane nodes -> positions of particles on the wrong side", [](S& s, Fields& f, const C&) { keep_sides(s, f); });
  add(viscous,       "grid_to_boundaries", "nodal velocity -> points of viscous boundaries",           [](S& s, G& g, const C& c) { grid_to_boundaries(s, g, c.dt); });
  add(has_tracers(scene), "grid_to_tracers", "nodal velocity -> tracers",                              [](S& s, G& g, const C& c) { grid_to_tracers(s, g, c.dt); });
  add(rigid_moves,   "move_rigid_bodies", "time -> pose and rates of rigid bodies",                    [rigid](S& s, Fields&, const C& c) { move_rigid_bodies(rigid, c.dt, s); });
  add(!pumps.empty(), "pumps",            "time -> mass, volume ratio",                                [pumps, g_vector](S& s, Fields&, const C& c) { pump_fluid(pumps, g_vector, c, s); });
  add(relaxes,       "kinetic_damping",   "kinetic energy -> velocities at its peaks",                 [relaxation, g_vector](S& s, Fields&, const C&) { damp_kinetically(relaxation, g_vector, s); });
  add(watches_energy(scene) && driven.empty(), "energy_watch", "energies, every 50 steps -> end of a run that gains without cause", [g_vector, h](S& s, Fields&, const C& c) { watch_energy(g_vector, h, c, s); });
  // clang-format on
  return p;
}

template <int Dim>
void advance(const Scene& scene, Pipeline<Dim>& pipeline, State<Dim>& state, Grids<Dim>& grids) {
  using Clock = std::chrono::steady_clock;
  const StepContext step{stable_dt(scene, state, grids.front().layout), state.t, state.step};
  auto start = Clock::now();
  for (Stage<Dim>& stage : pipeline) {
    stage.run(state, grids, step);
    const auto end = Clock::now();
    stage.seconds += std::chrono::duration<double>(end - start).count();
    start = end;
  }
  state.t += step.dt;
  ++state.step;
}

template Pipeline<2> build_pipeline<2>(const Scene&);
template Pipeline<3> build_pipeline<3>(const Scene&);
template void advance<2>(const Scene&, Pipeline<2>&, State<2>&, Grids<2>&);
template void advance<3>(const Scene&, Pipeline<3>&, State<3>&, Grids<3>&);

}  // namespace geodrop
