// The force that drives a body along a manufactured solution.
#pragma once

#include <geodrop/exact.hpp>
#include <geodrop/pipeline.hpp>

#include <vector>

namespace geodrop {

/// Which bodies of the state are driven, by index.
struct DrivenBody {
  std::size_t body;
  AxisAlignedMms mms;
};
template <int Dim>
std::vector<DrivenBody> driven_bodies(const Scene& scene);

/// v_p += dt b(X_p, t_n). Particles are kicked before they give their momentum to the grid, so that grid and particles
/// gain sum m_p b dt to round-off, together with the stresses at t_n: the leapfrog of the scheme stays of second order.
template <int Dim>
void apply_body_force(const std::vector<DrivenBody>& driven, State<Dim>& state, const StepContext& step);

}  // namespace geodrop
