// The rows of history.csv. Names and values are listed by the same functions, so that they cannot fall out of step.
#include <algorithm>
#include <cmath>
#include <geodrop/find_named.hpp>
#include <geodrop/history.hpp>
#include <geodrop/scene/probes.hpp>
#include <numbers>

#include "extremes_probe.hpp"
#include "front_probe.hpp"
#include "geotube_probe.hpp"
#include "pressure_probe.hpp"
#include "section_probe.hpp"
#include "span_probe.hpp"
#include "strays.hpp"
#include "text.hpp"

namespace geodrop {
namespace {

constexpr const char* axis_names[] = {"x", "y", "z"};

/// Names with values, in the order of the columns.
struct Row {
  std::vector<std::string> names;
  std::vector<double> values;

  void add(const std::string& name, double value) {
    names.push_back(name);
    values.push_back(value);
  }
  /// One column per axis: `before` + "_x_" + `unit`, ...
  template <class Vector>
  void add_vector(const std::string& before, const std::string& unit, const Vector& vector, int dimension) {
    for (int a = 0; a < dimension; ++a) add(before + "_" + axis_names[a] + "_" + unit, vector[a]);
  }
};

/// The multiple of 360 degrees that brings an angle closest to the one of the row before.
double unwrap(double degrees, double before) { return degrees + 360 * std::round((before - degrees) / 360); }

/// In 2D an angle that goes on beyond half a turn; in 3D the components of axis times angle, as they are.
template <int Dim>
void list_rotation(Row& row, const std::string& name, const Rotation<Dim>& rotation, const HistoryTable& earlier) {
  constexpr double degrees = 180 / std::numbers::pi;
  if constexpr (Dim == 2) {
    const double before = earlier.rows.empty() ? 0 : earlier.rows.back()[row.values.size()];
    row.add(name + ".rotation_deg", unwrap(rotation[0] * degrees, before));
  } else {
    row.add_vector(name + ".rotation", "deg", Rotation<Dim>(rotation * degrees), Dim);
  }
}

/// The normal stresses at the centre; in 3D there are two horizontal ones.
template <int Dim>
void list_stress(Row& row, const std::string& name, const Vec<Dim>& stress) {
  row.add(name + ".vertical_stress_centre_Pa", stress[vertical_axis<Dim>]);
  if constexpr (Dim == 2) row.add(name + ".horizontal_stress_centre_Pa", stress[0]);
  if constexpr (Dim == 3) row.add_vector(name + ".horizontal_stress", "centre_Pa", stress, 2);
}

template <int Dim>
void list_body(Row& row, const std::string& name, const BodyMeasures<Dim>& body, const HistoryTable& earlier) {
  row.add_vector(name + ".position", "m", body.centre, Dim);
  row.add_vector(name + ".velocity", "m_s", body.velocity, Dim);
  list_rotation<Dim>(row, name, body.rotation, earlier);
  row.add(name + ".mean_pressure_centre_Pa", body.pressure_centre);
  list_stress<Dim>(row, name, body.stress_centre);
  row.add(name + ".velocity_rms_m_s", body.velocity_rms);
  row.add(name + ".lowest_m", body.lower[vertical_axis<Dim>]);
  row.add(name + ".highest_m", body.upper[vertical_axis<Dim>]);
  row.add(name + ".leftmost_m", body.lower[0]);
  row.add(name + ".rightmost_m", body.upper[0]);
  if constexpr (Dim == 3) {
    row.add(name + ".frontmost_m", body.lower[1]);
    row.add(name + ".backmost_m", body.upper[1]);
  }
}

/// `peak`: largest tension since the row before.
template <int Dim>
void list_membrane(Row& row, const std::string& name, const MembraneMeasures<Dim>& membrane, double peak, bool closed) {
  row.add(name + ".tension_max_N_m", membrane.tension_max);
  row.add(name + ".tension_mean_N_m", membrane.tension_mean);
  row.add(name + ".tension_p95_N_m", membrane.tension_p95);
  row.add_vector(name + ".tension_max", "m", membrane.tension_max_at, Dim);
  row.add(name + ".tension_peak_N_m", std::max(peak, membrane.tension_max));
  if (Dim == 2 && closed) row.add(name + ".area_m2", membrane.area);
  row.add(name + ".length_m", membrane.length);
  row.add(name + ".utilisation_max", membrane.utilisation_max);
}

/// Of sharp membranes, which are for the plane.
void list_strays(Row& row, const Scene& scene, const State<2>* state) {
  for (std::size_t m = 0; m < scene.membranes.size(); ++m)
    if (scene.membranes[m].interface == Interface::sharp)
      row.add(scene.membranes[m].name + ".strays_m2", state ? strays_inside(*state, state->membranes[m]) : 0);
}
void list_strays(Row&, const Scene&, const State<3>*) {}

/// Sums over all points in contact, in the step before.
template <int Dim>
void list_contact(Row& row, const std::string& name, const RigidContact<Dim>& contact) {
  row.add(name + ".normal_force_N_m", contact.normal_sum);
  row.add(name + ".friction_force_N_m", contact.friction_sum);
  row.add_vector(name + ".normal_force", "N_m", contact.normal_force, Dim);
  row.add_vector(name + ".friction_force", "N_m", contact.friction_force, Dim);
  row.add(name + ".friction_work_J", contact.friction_work);
  row.add(name + ".damping_work_J", contact.damping_work);
}

/// Likewise; the force is what the other membrane does to the first. Within own folds it adds up to nothing.
void list_contact(Row& row, const std::string& name, const MembraneContact& contact, bool folds) {
  row.add(name + ".normal_force_N_m", contact.normal_force);
  if (!folds) row.add_vector(name + ".force", "N_m", contact.force, 2);
}

/// In the order of the scene; the state keeps the two kinds apart.
template <int Dim>
void list_contacts(Row& row, const Scene& scene, const State<Dim>* state) {
  const MembraneContact no_contact{};
  std::size_t rigid = 0, membranes = 0;
  for (const ContactSpec& contact : scene.contacts) {
    const ContactPair pair = contact_pair(scene, contact);
    const std::string name = pair.touching + '.' + pair.other;
    if (pair.kind == ContactPair::Kind::membranes)
      list_contact(row, name, state ? state->membrane_contacts[membranes++] : no_contact, pair.touching == pair.other);
    else
      list_contact(row, name, state ? state->rigid_contacts[rigid++] : RigidContact<Dim>{});
  }
}

template <int Dim>
void list_rigid(Row& row, const std::string& name, const RigidBody<Dim>& rigid) {
  constexpr double degrees = 180 / std::numbers::pi;
  row.add(name + ".rotation_deg", rigid.angle * degrees);
  row.add_vector(name + ".displacement", "m", rigid.displacement, Dim);
}

template <int Dim>
void list_totals(Row& row, const Totals<Dim>& totals, const HistoryTable& earlier) {
  row.add("energy.kinetic_J", totals.kinetic);
  row.add("energy.potential_J", totals.potential);
  row.add("energy.strain_J", totals.strain);
  row.add("energy.membrane_J", totals.membrane);
  const double initial = earlier.rows.empty() ? totals.energy() : earlier.rows.front()[row.values.size()];
  row.add("energy.total_J", totals.energy());
  row.add("energy.dissipated_J", initial - totals.energy());
  row.add("total.mass_kg", totals.mass);
  row.add_vector("total.momentum", "kg_m_s", totals.momentum, Dim);
}

void list_relaxation(Row& row, const Relaxation& relaxation) {
  row.add("relaxation.kinetic_ratio", relaxation.kinetic_ratio);
  row.add("relaxation.out_of_balance_ratio", relaxation.out_of_balance_ratio);
  row.add("relaxation.cycles", static_cast<double>(relaxation.cycles));
}

template <int Dim>
void list_tracer(Row& row, const std::string& name, const Tracer<Dim>& tracer) {
  std::array<double, Dim> displacement;
  for (int a = 0; a < Dim; ++a) displacement[a] = tracer.x[a] - tracer.initial_x[a];
  row.add_vector(name + ".position", "m", tracer.x, Dim);
  row.add_vector(name + ".displacement", "m", displacement, Dim);
  row.add_vector(name + ".velocity", "m_s", tracer.v, Dim);
}

void list_pressure_error(Row& row, const HydrostaticProbeSpec& probe, const PressureError& error,
                         const PressureSpread& spread) {
  row.add(probe.name + ".pressure_error_rms_Pa", error.rms);
  row.add(probe.name + ".pressure_error_max_Pa", error.max);
  row.add(probe.name + ".pressure_error_p999_Pa", spread.elsewhere);
  if (!probe.tips_of.empty()) row.add(probe.name + ".pressure_error_tips_p999_Pa", spread.tips);
}

/// The columns that the solution tells something about.
void list_exact_error(Row& row, const std::string& name, const ExactSpec& spec, const ExactError& error) {
  row.add(name + ".velocity_error_rms_ratio", error.velocity_rms);
  row.add(name + ".velocity_error_max_ratio", error.velocity_max);
  if (std::holds_alternative<TaylorGreenSpec>(spec.solution)) {
    row.add(name + ".kinetic_energy_ratio", error.kinetic_energy);
    row.add(name + ".pressure_error_rms_ratio", error.pressure_rms);
    row.add(name + ".node_density_min_ratio", error.density_min);
    row.add(name + ".node_density_max_ratio", error.density_max);
    return;
  }
  row.add(name + ".displacement_error_rms_m", error.displacement_rms);
  row.add(name + ".displacement_error_max_m", error.displacement_max);
  row.add(name + ".strain_error_rms_ratio", error.strain_rms);
  row.add(name + ".strain_error_max_ratio", error.strain_max);
  if (!std::holds_alternative<BarFirstModeSpec>(spec.solution)) return;
  row.add(name + ".mode_energy_ratio", error.mode_energy);
  row.add(name + ".phase_error_rad", error.phase);
}

template <int Dim>
PressureError measure(const HydrostaticProbeSpec& probe, const Scene& scene, const State<Dim>& state) {
  const Material fluid = make_material(*find_material(scene, probe.still.fluid));
  return pressure_error(find_named(state.bodies, probe.body), std::get<Newtonian>(fluid), probe.still.surface,
                        -scene.gravity[vertical_axis<Dim>]);
}

template <int Dim>
void list_stress_spread(Row& row, const std::string& name, const Body<Dim>* body) {
  std::vector<double> stress;
  for (std::size_t p = 0; body && p < body->size(); ++p) stress.push_back(total_stress(*body, p)[vertical_axis<Dim>]);
  for (const auto& [column, percent] : {std::pair{"p01", 1.0}, std::pair{"p50", 50.0}, std::pair{"p99", 99.0}})
    row.add(name + ".vertical_stress_" + column + "_Pa", body ? percentile(stress, percent) : 0.0);
}

void list_extremes(Row& row, const std::string& name, const Extremes& extremes) {
  row.add(name + ".volume_min_ratio", extremes.volume_min);
  row.add(name + ".volume_max_ratio", extremes.volume_max);
  row.add(name + ".pressure_min_Pa", extremes.pressure_min);
  row.add(name + ".pressure_max_Pa", extremes.pressure_max);
  row.add(name + ".tension_max_Pa", extremes.tension);
}

void list_plane_probe(Row& row, const Scene& scene, const ProbeSpec& spec, const State<2>* state) {
  if (const auto* tube = std::get_if<GeotubeProbeSpec>(&spec.probe))
    for (const auto& [name, value] : geotube_columns(scene, *tube, state)) row.add(tube->name + "." + name, value);
  if (const auto* section = std::get_if<SectionProbeSpec>(&spec.probe)) {
    const SectionForces forces = state ? section_forces(scene, *section, *state) : SectionForces{};
    row.add(section->name + ".soil_force_N_m", forces.soil);
    row.add(section->name + ".membrane_force_N_m", forces.membrane);
    row.add(section->name + ".net_force_N_m", forces.soil - forces.membrane);
  }
  if (const auto* front = std::get_if<FrontProbeSpec>(&spec.probe)) {
    const HeapFronts fronts =
        state ? heap_fronts(scene.grid, *front, find_named(state->bodies, front->body)) : HeapFronts{};
    row.add(front->name + ".left_m", fronts.left);
    row.add(front->name + ".right_m", fronts.right);
  }
  if (const auto* span = std::get_if<SpanProbeSpec>(&spec.probe)) {
    const SpanTension tension = state ? span_tension(scene, *span, *state) : SpanTension{};
    row.add(span->name + ".tension_mean_N_m", tension.mean);
    row.add(span->name + ".tension_max_N_m", tension.max);
  }
}

/// Without a state: the names only, with values that mean nothing.
template <int Dim>
Row list(const Scene& scene, const State<Dim>* state, const HistoryTable& earlier) {
  Row row;
  row.add("time_s", state ? state->t : 0);
  row.add("step", state ? static_cast<double>(state->step) : 0);
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    list_body(row, scene.bodies[b].name, state ? measure(state->bodies[b], scene.grid.spacing) : BodyMeasures<Dim>{},
              earlier);
  for (std::size_t m = 0; m < scene.membranes.size(); ++m)
    list_membrane(row, scene.membranes[m].name, state ? measure(state->membranes[m]) : MembraneMeasures<Dim>{},
                  state ? state->membranes[m].tension_peak : 0, scene.membranes[m].closed);
  list_strays(row, scene, state);
  for (const RigidSpec& rigid : scene.rigid)
    if (!std::holds_alternative<std::monostate>(rigid.motion))
      list_rigid(row, rigid.name, state ? find_named(state->rigid, rigid.name) : RigidBody<Dim>{});
  list_contacts(row, scene, state);
  if (scene.relaxation.damping != RelaxationSpec::Damping::none)
    list_relaxation(row, state ? state->relaxation : Relaxation{});
  list_totals(row, state ? measure(*state, scene.gravity) : Totals<Dim>{}, earlier);
  for (const ProbeSpec& spec : scene.probes) {
    if (const auto* tracer = std::get_if<TracerSpec>(&spec.probe))
      list_tracer(row, tracer->name, state ? find_named(state->tracers, tracer->name) : Tracer<Dim>{});
    if (const auto* probe = std::get_if<HydrostaticProbeSpec>(&spec.probe))
      list_pressure_error(row, *probe, state ? measure(*probe, scene, *state) : PressureError{},
                          state ? pressure_spread(scene, *probe, *state) : PressureSpread{});
    if (const auto* probe = std::get_if<StressProbeSpec>(&spec.probe))
      list_stress_spread<Dim>(row, probe->name, state ? &find_named(state->bodies, probe->body) : nullptr);
    if (const auto* probe = std::get_if<ExtremesProbeSpec>(&spec.probe))
      list_extremes(row, probe->name, state ? extremes_of(find_named(state->bodies, probe->body)) : Extremes{});
    if constexpr (Dim == 2) list_plane_probe(row, scene, spec, state);
    if (const auto* probe = std::get_if<ExactProbeSpec>(&spec.probe))
      list_exact_error(row, probe->name, *find_exact(scene, probe->body),
                       state ? exact_error(scene, *state, find_named(state->bodies, probe->body)) : ExactError{});
  }
  return row;
}

}  // namespace

std::size_t HistoryTable::find(const std::string& column) const {
  return static_cast<std::size_t>(std::find(columns.begin(), columns.end(), column) - columns.begin());
}

std::vector<std::string> history_columns(const Scene& scene) {
  return scene.dimension == 2 ? list<2>(scene, nullptr, {}).names : list<3>(scene, nullptr, {}).names;
}

template <int Dim>
std::vector<double> history_row(const Scene& scene, const State<Dim>& state, const HistoryTable& earlier) {
  return list<Dim>(scene, &state, earlier).values;
}

template std::vector<double> history_row(const Scene&, const State<2>&, const HistoryTable&);
template std::vector<double> history_row(const Scene&, const State<3>&, const HistoryTable&);

}  // namespace geodrop
