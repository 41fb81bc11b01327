// Stages of a scene in time: what comes in, what goes, what moves, and how motion is damped, from when on.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/scene/scene.hpp>
#include <geodrop/state/state.hpp>

#include <vector>

namespace geodrop {

/// The stages of the scene, and of each of its bodies the velocity field once it is placed.
struct SceneStages {
  std::vector<StageSpec> stages;
  std::vector<int> fields;
  std::vector<bool> in_pores;  ///< whether it is the water in the pores of another body
  Point gravity;               ///< [m/s2]

  explicit SceneStages(const Scene& scene);
};

/// Enters every stage that has begun by State::t, in order: places bodies with their membranes, removes and moves rigid
/// bodies. Sets State::damping_rate.
template <int Dim>
void enter_due_stages(const SceneStages& scene, State<Dim>& state);

/// What the stages from `first` on have placed is not where something is already: no cell has half of its room taken by
/// the one and half by the other, and one and a half in all. Throws RunError.
template <int Dim>
void refuse_full_cells(const SceneStages& scene, std::size_t first, const State<Dim>& state,
                       const GridLayout<Dim>& layout);

/// Bodies that a later stage places wait outside of every velocity field.
template <int Dim>
void let_bodies_wait(const Scene& scene, State<Dim>& state);

}  // namespace geodrop
