// Particles on the wrong side of a closed membrane.
#pragma once

#include <geodrop/state/state.hpp>

#include <string>

namespace geodrop {

/// Volume of particles of other bodies inside a closed membrane, but for the water in the pores of its own (empty:
/// none) [m2]. Those within `skin` [m] of the membrane do not count: between two membranes that touch, water is a
/// thousandth of a cell inside one of them; nor do those that another closed membrane has inside, too: two that touch
/// overlap by what the penalty needs.
double strays_inside(const State<2>& state, const Membrane<2>& membrane, const std::string& pore_water, double skin);

}  // namespace geodrop
