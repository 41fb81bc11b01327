// The state that a run begins with, and whether it is the last.
#pragma once

#include <geodrop/scene/scene.hpp>
#include <geodrop/state/state.hpp>

namespace geodrop {

/// Particles, membranes and tracers of the scene at t = 0, with their initial stress. Bodies and membranes that an
/// earlier state has as well, by name, are as that one left them.
template <int Dim>
State<Dim> build_state(const Scene& scene, const State<Dim>* earlier = nullptr);

/// Cycles of the relaxation in a row that meet both criteria of rest.
inline constexpr std::uint64_t cycles_to_rest = 3;

/// Whether a run has nothing more to do: its time is over, or it has come to rest and neither a pump nor a stage is
/// still to come.
template <int Dim>
bool is_over(const Scene& scene, const State<Dim>& state);

}  // namespace geodrop
