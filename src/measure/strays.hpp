// Particles on the wrong side of a closed membrane.
#pragma once

#include <geodrop/state/state.hpp>

#include <string>

namespace geodrop {

/// Volume of particles of other bodies inside a closed membrane, but for the water in the pores of its own (empty:
/// none) [m2].
double strays_inside(const State<2>& state, const Membrane<2>& membrane, const std::string& pore_water);

}  // namespace geodrop
