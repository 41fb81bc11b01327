// Particles on the wrong side of a closed membrane.
#pragma once

#include <geodrop/state/state.hpp>

namespace geodrop {

/// Volume of particles of other bodies inside a closed membrane [m2].
double strays_inside(const State<2>& state, const Membrane<2>& membrane);

}  // namespace geodrop
