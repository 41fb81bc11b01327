// Horizontal forces that a body and its membrane carry over an upright section (2D).
//
//   w(x) = sum of N_i(x) over the nodes right of the section (on it: by half)
//   soil: sum V_p sigma_xx w'(x_p),   membrane: sum over segments of T t_x (w(X_end) - w(X_start))
//
// These are what the grid itself balances with gravity and contact: a band of particles around the section counts
// columns of particles, and errs by 5 to 15 %.
#pragma once

#include <geodrop/scene.hpp>
#include <geodrop/scene/probes.hpp>
#include <geodrop/state.hpp>

namespace geodrop {

/// Per metre of depth [N/m].
struct SectionForces {
  double soil = 0;      ///< compression positive
  double membrane = 0;  ///< tension positive
};

SectionForces section_forces(const Scene& scene, const SectionProbeSpec& probe, const State<2>& state);

}  // namespace geodrop
