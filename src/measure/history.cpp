// The rows of history.csv. Names and values are listed by the same functions, so that they cannot fall out of step.
#include <algorithm>
#include <cmath>
#include <geodrop/base/find_named.hpp>
#include <geodrop/measure/history.hpp>
#include <numbers>

#include "base/text.hpp"
#include "history_row.hpp"
#include "measure/probes/probes.hpp"
#include "membrane_balance.hpp"
#include "scene/needs.hpp"
#include "strays.hpp"
#include "water_force.hpp"

namespace geodrop {
namespace {

/// The multiple of 360 degrees that brings an angle closest to the one of the row before.
double unwrap(double degrees, double before) { return degrees + 360 * std::round((before - degrees) / 360); }

/// In 2D an angle that goes on beyond half a turn; in 3D the components of axis times angle, as they are.
template <int Dim>
void list_rotation(HistoryRow& row, const std::string& name, const Rotation<Dim>& rotation,
                   const HistoryTable& earlier) {
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
void list_stress(HistoryRow& row, const std::string& name, const Vec<Dim>& stress) {
  row.add(name + ".vertical_stress_centre_Pa", stress[vertical_axis<Dim>]);
  if constexpr (Dim == 2) row.add(name + ".horizontal_stress_centre_Pa", stress[0]);
  if constexpr (Dim == 3) row.add_vector(name + ".horizontal_stress", "centre_Pa", stress, 2);
}

template <int Dim>
void list_body(HistoryRow& row, const std::string& name, const BodyMeasures<Dim>& body, const HistoryTable& earlier) {
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
  row.add(name + ".height_m", body.upper[vertical_axis<Dim>] - body.lower[vertical_axis<Dim>]);
  row.add(name + ".width_m", body.upper[0] - body.lower[0]);
  if constexpr (Dim == 3) {
    row.add(name + ".frontmost_m", body.lower[1]);
    row.add(name + ".backmost_m", body.upper[1]);
  }
}

template <int Dim>
void list_membrane(HistoryRow& row, const std::string& name, const MembraneMeasures<Dim>& membrane, bool closed) {
  row.add(name + ".tension_max_N_m", membrane.tension_max);
  row.add(name + ".tension_mean_N_m", membrane.tension_mean);
  row.add(name + ".tension_p95_N_m", membrane.tension_p95);
  row.add_vector(name + ".tension_max", "m", membrane.tension_max_at, Dim);
  row.add(name + ".tension_gauge_N_m", membrane.gauge_peak);
  row.add_vector(name + ".tension_gauge", "m", membrane.gauge_at, Dim);
  row.add(name + ".tension_gauge_time_s", membrane.gauge_time);
  if (Dim == 2 && closed) row.add(name + ".area_m2", membrane.area);
  if constexpr (Dim == 2) row.add(name + ".length_m", membrane.length);
  if constexpr (Dim == 3) {
    row.add(name + ".tension_std_N_m", membrane.tension_deviation);
    row.add(name + ".cross_tension_mean_N_m", membrane.cross_tension_mean);
    row.add(name + ".cross_tension_std_N_m", membrane.cross_tension_deviation);
    row.add(name + ".cloth_area_m2", membrane.area);
    row.add(name + ".volume_m3", membrane.volume);
    row.add_vector(name + ".lower", "m", membrane.lower, Dim);
    row.add_vector(name + ".upper", "m", membrane.upper, Dim);
  }
  row.add(name + ".utilisation_max", membrane.utilisation_max);
}

/// Of membranes that slide over a soil, which are for the plane.
void list_balance(HistoryRow& row, const Scene& scene, const State<2>* state) {
  for (std::size_t m = 0; m < scene.membranes.size(); ++m) {
    const MembraneSpec& spec = scene.membranes[m];
    if (!slides(scene, spec) || contents_friction(scene, spec) == 0) continue;
    const double weight = std::hypot(scene.gravity[0], scene.gravity[1]);
    row.add(spec.name + ".friction_ratio", state ? friction_ratio(state->membranes[m], weight) : 0);
    const auto strain_max = [](const Array<double>& strain) { return *std::max_element(strain.begin(), strain.end()); };
    row.add(spec.name + ".strain_max", state ? strain_max(state->membranes[m].strain) : 0);
  }
}
void list_balance(HistoryRow&, const Scene&, const State<3>*) {}

/// Of membranes that bear tension: where it is largest now, and whether it is in balance there.
template <int Dim>
void list_across(HistoryRow& row, const Scene& scene, const State<Dim>* state) {
  for (std::size_t m = 0; m < scene.membranes.size(); ++m) {
    if (!(scene.membranes[m].axial_stiffness > 0)) continue;
    const AcrossLine across = state ? balance_at_gauge(scene, *state, state->membranes[m]) : AcrossLine{};
    row.add(scene.membranes[m].name + ".curvature_load_Pa", across.curvature);
    row.add(scene.membranes[m].name + ".pressure_jump_Pa", across.pressure);
    row.add(scene.membranes[m].name + balance_column, across.error);
  }
}

/// Of membranes on coupled beds.
template <int Dim>
void list_bed(HistoryRow& row, const Scene& scene, const MembraneSpec& spec, const State<Dim>* state) {
  if (!lies_on_grains(scene, spec)) return;
  const auto force = state ? bed_force<Dim>(find_named(state->membranes, spec.name)) : std::array<double, Dim>{};
  row.add_vector(spec.name + ".bed_force", Dim == 2 ? "N_m" : "N", force, Dim);
}

/// Of membranes that let water through.
template <int Dim>
void list_seepage(HistoryRow& row, const Scene& scene, const MembraneSpec& spec, const State<Dim>* state) {
  if (!(spec.permittivity > 0)) return;
  const std::string& pore_water = find_body(scene, body_inside(scene, spec))->saturated_by;
  const std::string unit = Dim == 2 ? "m2" : "m3";
  row.add(spec.name + ".seepage_" + unit + "_s", state ? seepage(find_named(state->membranes, spec.name)) : 0);
  row.add(spec.name + ".water_inside_" + unit, state ? water_inside(find_named(state->bodies, pore_water)) : 0);
}

/// Of sharp membranes.
void list_sharp(HistoryRow& row, const Scene& scene, const State<2>* state) {
  constexpr double skin = 0.01;  // strays no deeper than this do not count [cells]
  for (std::size_t m = 0; m < scene.membranes.size(); ++m) {
    if (scene.membranes[m].interface != Interface::sharp) continue;
    const std::string& name = scene.membranes[m].name;
    const std::string& pore_water = find_body(scene, scene.membranes[m].body)->saturated_by;
    const WaterForce force = state ? water_force(state->membranes[m]) : WaterForce{};
    row.add_vector(name + ".pressure_force", "N_m", force.pressure, 2);
    row.add_vector(name + ".friction_force", "N_m", force.friction, 2);
    list_bed(row, scene, scene.membranes[m], state);
    list_seepage(row, scene, scene.membranes[m], state);
    row.add(name + ".strays_m2",
            state ? strays_inside(*state, state->membranes[m], pore_water, skin * scene.grid.spacing) : 0);
  }
}
void list_sharp(HistoryRow& row, const Scene& scene, const State<3>* state) {
  for (std::size_t m = 0; m < scene.membranes.size(); ++m) {
    if (scene.membranes[m].interface != Interface::sharp) continue;
    const std::string& name = scene.membranes[m].name;
    const WaterForceInSpace force = state ? water_force(state->membranes[m]) : WaterForceInSpace{};
    row.add_vector(name + ".pressure_force", "N", force.pressure, 3);
    if (rubs_sharply(scene.membranes[m])) row.add_vector(name + ".friction_force", "N", force.friction, 3);
    list_bed(row, scene, scene.membranes[m], state);
    list_seepage(row, scene, scene.membranes[m], state);
  }
}

/// Sums over all points in contact, in the step before.
template <int Dim>
void list_contact(HistoryRow& row, const std::string& name, const RigidContact<Dim>& contact) {
  const std::string unit = Dim == 2 ? "N_m" : "N";  // per metre of depth in the plane
  row.add(name + ".normal_force_" + unit, contact.normal_sum);
  row.add(name + ".friction_force_" + unit, contact.friction_sum);
  row.add_vector(name + ".normal_force", unit, contact.normal_force, Dim);
  row.add_vector(name + ".friction_force", unit, contact.friction_force, Dim);
  row.add(name + ".friction_work_J", contact.friction_work);
  row.add(name + ".damping_work_J", contact.damping_work);
}

/// Likewise; the force is what the other membrane does to the first. Within own folds it adds up to nothing.
template <int Dim>
void list_contact(HistoryRow& row, const std::string& name, const MembraneContact<Dim>& contact, bool folds) {
  const std::string unit = Dim == 2 ? "N_m" : "N";
  row.add(name + ".normal_force_" + unit, contact.normal_force);
  if (!folds) row.add_vector(name + ".force", unit, contact.force, Dim);
}

/// In the order of the scene; the state keeps the two kinds apart.
template <int Dim>
void list_contacts(HistoryRow& row, const Scene& scene, const State<Dim>* state) {
  const MembraneContact<Dim> no_contact{};
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

/// On the membrane, in the step before.
template <int Dim>
void list_anchors(HistoryRow& row, const Scene& scene, const State<Dim>* state) {
  const std::string unit = Dim == 2 ? "N_m" : "N";
  for (std::size_t i = 0; i < scene.anchors.size(); ++i) {
    const Anchor<Dim> anchor = state ? state->anchors[i] : Anchor<Dim>{};
    const Vec<Dim> force(anchor.force.data());
    row.add_vector(scene.anchors[i].name + ".force", unit, force, Dim);
    row.add(scene.anchors[i].name + ".pull_" + unit, force.norm());
    if (std::holds_alternative<AnchorLineSpec>(scene.anchors[i].by))
      row.add(scene.anchors[i].name + ".length_m", anchor.length + anchor.stretch);
  }
}

template <int Dim>
void list_rigid(HistoryRow& row, const std::string& name, const RigidBody<Dim>& rigid) {
  constexpr double degrees = 180 / std::numbers::pi;
  row.add(name + ".rotation_deg", rigid.angle * degrees);
  row.add_vector(name + ".displacement", "m", rigid.displacement, Dim);
}

template <int Dim>
void list_totals(HistoryRow& row, const Totals<Dim>& totals, const HistoryTable& earlier) {
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

void list_relaxation(HistoryRow& row, const Relaxation& relaxation) {
  row.add("relaxation.kinetic_ratio", relaxation.kinetic_ratio);
  row.add("relaxation.out_of_balance_ratio", relaxation.out_of_balance_ratio);
  row.add("relaxation.cycles", static_cast<double>(relaxation.cycles));
}

/// Without a state: the names only, with values that mean nothing.
template <int Dim>
HistoryRow list(const Scene& scene, const State<Dim>* state, const HistoryTable& earlier) {
  HistoryRow row;
  row.add("time_s", state ? state->t : 0);
  row.add("step", state ? static_cast<double>(state->step) : 0);
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    list_body(row, scene.bodies[b].name, state ? measure(state->bodies[b], scene.grid.spacing) : BodyMeasures<Dim>{},
              earlier);
  for (std::size_t m = 0; m < scene.membranes.size(); ++m)
    list_membrane(row, scene.membranes[m].name, state ? measure(state->membranes[m]) : MembraneMeasures<Dim>{},
                  scene.membranes[m].closed);
  list_balance(row, scene, state);
  list_across(row, scene, state);
  list_sharp(row, scene, state);
  for (const RigidSpec& rigid : scene.rigid)
    if (!std::holds_alternative<std::monostate>(rigid.motion))
      list_rigid(row, rigid.name, state ? find_named(state->rigid, rigid.name) : RigidBody<Dim>{});
  list_contacts(row, scene, state);
  list_anchors(row, scene, state);
  if (scene.relaxation.damping != RelaxationSpec::Damping::none)
    list_relaxation(row, state ? state->relaxation : Relaxation{});
  list_totals(row, state ? measure(*state, scene.gravity) : Totals<Dim>{}, earlier);
  const auto list_probe = [&](const auto& probe) {
    if constexpr (requires { probe.list(row, scene, state); }) probe.list(row, scene, state);
  };
  for (const ProbeSpec& spec : scene.probes) std::visit(list_probe, spec.probe);
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
