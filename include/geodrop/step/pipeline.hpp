// The ordered list of rows of a step, and the loop that runs them.
#pragma once

#include <geodrop/files/output.hpp>
#include <geodrop/grid/grid.hpp>
#include <geodrop/grid/row.hpp>
#include <geodrop/scene/scene.hpp>
#include <geodrop/setup/setup.hpp>
#include <geodrop/state/state.hpp>
#include <string>
#include <vector>

namespace geodrop {

template <int Dim>
using Pipeline = std::vector<Row<Dim>>;

/// The rows that the scene's physics needs, in order; nothing for what the scene does not name.
template <int Dim>
Pipeline<Dim> build_pipeline(const Scene& scene);

/// Runs one step of all rows and advances the clock.
template <int Dim>
void advance(Pipeline<Dim>& pipeline, State<Dim>& state, Grids<Dim>& grids);

/// What is worth knowing of a state before the next step: sizes, memory, time step, Skempton's B, density rise of
/// fluids.
template <int Dim>
std::vector<Fact> state_facts(const Scene& scene, const State<Dim>& state);

}  // namespace geodrop
