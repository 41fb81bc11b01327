// Whether a state that was read from a file can be one of a scene.
#pragma once

#include <geodrop/scene/scene.hpp>
#include <geodrop/state/state.hpp>

#include <string>

namespace geodrop {

/// What of `state` is not as in a run of the scene, e.g. "body 'water': a velocity field of number 7"; empty: nothing.
/// A step of a state that passes reads and writes nothing out of bounds: counts, numbers of fields and names are those
/// of `built`, which is build_state of the scene, numbers are finite, particles are in the domain and sorted.
template <int Dim>
std::string fault_in_state(const Scene& scene, State<Dim> built, const State<Dim>& state);

}  // namespace geodrop
