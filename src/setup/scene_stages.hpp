// Stages of a scene in time: what comes in, what goes, what moves, and how motion is damped, from when on.
#pragma once

#include <geodrop/scene/scene.hpp>
#include <geodrop/state/state.hpp>

#include <vector>

namespace geodrop {

/// The stages of the scene, and the velocity field of each of its bodies once it is placed.
struct SceneStages {
  std::vector<StageSpec> stages;
  std::vector<int> fields;
  Point gravity;  ///< [m/s2]

  explicit SceneStages(const Scene& scene);
};

/// Enters every stage that has begun by State::t, in order: places bodies with their membranes, removes and moves rigid
/// bodies. Sets State::damping_rate.
template <int Dim>
void enter_due_stages(const SceneStages& scene, State<Dim>& state);

/// Bodies that a later stage places wait outside of every velocity field.
template <int Dim>
void let_bodies_wait(const Scene& scene, State<Dim>& state);

}  // namespace geodrop
