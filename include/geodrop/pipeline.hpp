// The ordered list of stages of a step, and the loop that runs them.
#pragma once

#include <functional>
#include <geodrop/grid.hpp>
#include <geodrop/output.hpp>
#include <geodrop/scene.hpp>
#include <geodrop/state.hpp>
#include <string>
#include <vector>

namespace geodrop {

/// What is fixed for the duration of one step.
struct StepContext {
  double dt;  ///< [s]
  double t;   ///< at the start of the step [s]
  std::uint64_t step;
};

/// One named, timed piece of a step.
template <int Dim>
struct Stage {
  std::string name;
  std::string reads_writes;  ///< "reads -> writes", for `geodrop stages`
  std::function<void(State<Dim>&, Grids<Dim>&, const StepContext&)> run;
  double seconds = 0;  ///< wall time so far
};

template <int Dim>
using Pipeline = std::vector<Stage<Dim>>;

/// The stages that the scene's physics needs, in order; nothing for what the scene does not name.
template <int Dim>
Pipeline<Dim> build_pipeline(const Scene& scene);

/// Stable time step [s] of the present state; throws RunError if it collapses.
template <int Dim>
double stable_dt(const Scene& scene, const State<Dim>& state, const GridLayout<Dim>& layout);

/// Runs one step of all stages and advances the clock.
template <int Dim>
void advance(const Scene& scene, Pipeline<Dim>& pipeline, State<Dim>& state, Grids<Dim>& grids);

/// Whether a run has nothing more to do: its time is over, or it has come to rest and neither a pump nor a stage is
/// still to come.
template <int Dim>
bool is_over(const Scene& scene, const State<Dim>& state);

/// What is worth knowing of a state before the next step: sizes, memory, time step, Skempton's B, density rise of
/// fluids.
template <int Dim>
std::vector<Fact> state_facts(const Scene& scene, const State<Dim>& state);

/// Particles, membranes and tracers of the scene at t = 0, with their initial stress.
template <int Dim>
State<Dim> build_state(const Scene& scene);

}  // namespace geodrop
