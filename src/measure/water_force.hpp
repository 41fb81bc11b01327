// What the water around a sharp membrane does to it.
#pragma once

#include <geodrop/state/state.hpp>

#include <array>

namespace geodrop {

/// Forces per metre of depth on the whole membrane, in the step before [N/m].
struct WaterForce {
  std::array<double, 2> pressure{}, friction{};
};

/// Sums of the tractions of its segments: the pressure pushes inwards, the friction along.
WaterForce water_force(const Membrane<2>& membrane);

/// Forces on a whole membrane in space, in the step before [N].
struct WaterForceInSpace {
  Vec<3> pressure = Vec<3>::Zero(), friction = Vec<3>::Zero();
};
WaterForceInSpace water_force(const Membrane<3>& membrane);

/// Sum of the pressures of the grains of a coupled bed on a membrane, in the step before [N/m, N].
template <int Dim>
std::array<double, Dim> bed_force(const Membrane<Dim>& membrane);

/// What flows out of the pores inside through a membrane, in the step before [m2/s, m3/s].
template <int Dim>
double seepage(const Membrane<Dim>& membrane);

/// Volume of the water in the pores inside, without pressure [m2, m3].
template <int Dim>
double water_inside(const Body<Dim>& water);

}  // namespace geodrop
