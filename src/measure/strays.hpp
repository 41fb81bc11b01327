// Particles on the wrong side of a closed membrane.
#pragma once

#include <geodrop/state/state.hpp>

#include <map>
#include <string>

namespace geodrop {

/// Names of the waters in the pores of soils, by the soil.
using PoreWaters = std::map<std::string, std::string>;

/// Volume of particles of other bodies inside a closed membrane, but for the water in the pores of its own [m2]. Those
/// within `skin` [m] of the membrane do not count: between two membranes that touch, water is a thousandth of a cell
/// inside one of them; nor do those that are inside their own one: two that touch overlap by what the penalty needs.
double strays_inside(const State<2>& state, const Membrane<2>& membrane, const PoreWaters& pore_waters, double skin);

}  // namespace geodrop
