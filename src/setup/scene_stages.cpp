#include "scene_stages.hpp"

#include <geodrop/measure/measure.hpp>
#include <geodrop/scene/velocity_fields.hpp>

#include <algorithm>

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

}  // namespace

SceneStages::SceneStages(const Scene& scene)
    : stages(scene.stages), fields(velocity_fields(scene)), gravity(scene.gravity) {}

template <int Dim>
void enter_due_stages(const SceneStages& scene, State<Dim>& state) {
  const auto& stages = scene.stages;
  while (state.stages_entered < stages.size() && stages[state.stages_entered].from <= state.t)
    enter(stages[state.stages_entered++], scene, state);
  state.damping_rate = damping_at(stages[state.stages_entered - 1], state.t);
}

template <int Dim>
void let_bodies_wait(const Scene& scene, State<Dim>& state) {
  for (const StageSpec& stage : scene.stages)
    for (const std::string& name : stage.places) set_field(name, waiting, state);
}

#define GEODROP_INSTANTIATE(D)                                      \
  template void enter_due_stages<D>(const SceneStages&, State<D>&); \
  template void let_bodies_wait<D>(const Scene&, State<D>&);
GEODROP_INSTANTIATE(2)
GEODROP_INSTANTIATE(3)
#undef GEODROP_INSTANTIATE

}  // namespace geodrop
