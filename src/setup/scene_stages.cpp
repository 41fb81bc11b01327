#include "scene_stages.hpp"

#include <fmt/format.h>
#include <geodrop/base/error.hpp>
#include <geodrop/measure/measure.hpp>
#include <geodrop/scene/velocity_fields.hpp>

#include <algorithm>
#include <map>

#include "grid/neighbourhood.hpp"
#include "scene/needs.hpp"

namespace geodrop {
namespace {

bool is_listed(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

template <int Dim>
void set_field(const std::string& name, int field, State<Dim>& state) {
  for (Body<Dim>& body : state.bodies)
    if (body.name == name) body.field = field;
  for (Membrane<Dim>& membrane : state.membranes)
    if (membrane.body == name) membrane.field = field;
  for (Tracer<Dim>& tracer : state.tracers)
    if (tracer.body == name) tracer.field = field;
}

template <int Dim>
void place(const StageSpec& stage, const SceneStages& scene, State<Dim>& state) {
  if (stage.places.empty()) return;
  const double before = measure(state, scene.gravity).potential;
  for (std::size_t b = 0; b < state.bodies.size(); ++b)
    if (is_listed(stage.places, state.bodies[b].name)) set_field(state.bodies[b].name, scene.fields[b], state);
  state.relaxation.initial_potential += measure(state, scene.gravity).potential - before;
  state.drift = -1;  // sort, and with it renew the active blocks
}

template <int Dim>
void enter(const StageSpec& stage, const SceneStages& scene, State<Dim>& state) {
  place(stage, scene, state);
  for (RigidBody<Dim>& rigid : state.rigid) {
    rigid.moving = is_listed(stage.moves, rigid.name);
    if (is_listed(stage.removes, rigid.name)) rigid.present = false;
  }
}

/// Rises in proportion to time over the ramp.
double damping_at(const StageSpec& stage, double t) {
  if (stage.damping_ramp <= 0) return stage.damping_rate;
  return stage.damping_rate * std::clamp((t - stage.from) / stage.damping_ramp, 0.0, 1.0);
}

/// The part of each cell that the particles of a body take [its volume].
template <int Dim>
std::map<int, double> cell_shares(const Body<Dim>& body, const GridLayout<Dim>& layout) {
  std::map<int, double> shares;
  for (std::size_t p = 0; p < body.size(); ++p) {
    const std::array<int, Dim> cell = place_of_cell_at(layout, body.x, p);
    double room = 1;
    for (int a = 0; a < Dim; ++a) room *= layout.span_width(a, cell[a]) * layout.h;
    shares[layout.index(cell)] += body.volume(p) / room;
  }
  return shares;
}

/// Cells that both take a part of, more than they have; at its rim a body may be a particle over its share.
std::ptrdiff_t overfull(const std::map<int, double>& one, const std::map<int, double>& other) {
  constexpr double least = 0.5, most = 1.5;
  return std::ranges::count_if(one, [&](const auto& cell) {
    const auto found = other.find(cell.first);
    return found != other.end() && std::min(cell.second, found->second) > least && cell.second + found->second > most;
  });
}

}  // namespace

SceneStages::SceneStages(const Scene& scene)
    : stages(scene.stages), fields(velocity_fields(scene)), gravity(scene.gravity) {
  for (const BodySpec& body : scene.bodies) in_pores.push_back(saturates(scene, body.name));
}

template <int Dim>
void enter_due_stages(const SceneStages& scene, State<Dim>& state) {
  const auto& stages = scene.stages;
  while (state.stages_entered < stages.size() && stages[state.stages_entered].from <= state.t)
    enter(stages[state.stages_entered++], scene, state);
  state.damping_rate = damping_at(stages[state.stages_entered - 1], state.t);
}

template <int Dim>
void refuse_full_cells(const SceneStages& scene, std::size_t first, const State<Dim>& state,
                       const GridLayout<Dim>& layout) {
  for (std::size_t s = first; s < state.stages_entered; ++s) {
    const StageSpec& stage = scene.stages[s];
    for (std::size_t i = 0; i < state.bodies.size(); ++i) {
      if (!is_listed(stage.places, state.bodies[i].name) || scene.in_pores[i]) continue;
      const std::map<int, double> shares = cell_shares(state.bodies[i], layout);
      for (std::size_t j = 0; j < state.bodies.size(); ++j) {
        if (j == i || state.bodies[j].field == waiting || scene.in_pores[j]) continue;
        if (const auto full = overfull(shares, cell_shares(state.bodies[j], layout)))
          throw RunError(
              fmt::format("stage \"{}\" at t = {:g} s places \"{}\" where \"{}\" is: {} cells have more in "
                          "them than their room; place it elsewhere, or later",
                          stage.name, state.t, state.bodies[i].name, state.bodies[j].name, full));
      }
    }
  }
}

template <int Dim>
void let_bodies_wait(const Scene& scene, State<Dim>& state) {
  for (const StageSpec& stage : scene.stages)
    for (const std::string& name : stage.places) set_field(name, waiting, state);
}

#define GEODROP_INSTANTIATE(D)                                                                                \
  template void enter_due_stages<D>(const SceneStages&, State<D>&);                                           \
  template void refuse_full_cells<D>(const SceneStages&, std::size_t, const State<D>&, const GridLayout<D>&); \
  template void let_bodies_wait<D>(const Scene&, State<D>&);
GEODROP_INSTANTIATE(2)
GEODROP_INSTANTIATE(3)
#undef GEODROP_INSTANTIATE

}  // namespace geodrop
