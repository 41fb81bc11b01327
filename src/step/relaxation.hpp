// Dynamic relaxation to a state at rest by kinetic damping (Cundall 1976; Barnes 1999): whenever the kinetic energy has
// passed a peak, every velocity is set to zero. From one peak to the next is a cycle.
//
//   kinetic ratio          largest kinetic energy of a cycle over the amount of work by gravity since the start
//   out-of-balance ratio   largest |f_ext + f_int| / |f_ext| of a cycle, norms over the free components of all nodes,
//                          f_ext = m g
//
// A run is at rest once both ratios were met over `cycles_to_rest` cycles in a row: within one cycle any of the two may
// be small by chance, the forces at a peak of the kinetic energy and the energy after it.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/scene/scene.hpp>
#include <geodrop/state/state.hpp>

namespace geodrop {

/// Steps; the ratios of shorter cycles count with those of the next one.
inline constexpr std::uint64_t shortest_cycle = 50;

/// The out-of-balance ratio from the change of nodal velocities during the step.
template <int Dim>
void measure_balance(const Point& gravity, double dt, State<Dim>& state, const Grids<Dim>& grids);

/// Follows the kinetic energy; at its peak ends the cycle and all motion.
template <int Dim>
void damp_kinetically(const RelaxationSpec& spec, const Point& gravity, State<Dim>& state);

}  // namespace geodrop
