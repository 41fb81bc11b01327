// The force that drives a body along a manufactured solution.
#pragma once

#include <geodrop/grid/row.hpp>
#include <geodrop/solutions/exact.hpp>

#include <variant>
#include <vector>

namespace geodrop {

/// Which bodies of the state are driven, by index.
struct DrivenBody {
  std::size_t body;
  std::variant<AxisAlignedMms, GeneralizedVortex, OscillatingDrop> solution;
};
template <int Dim>
std::vector<DrivenBody> driven_bodies(const Scene& scene);

/// Adds sum_p N m b(X_p, t_n), of a drop b(x_p), to the force of the nodes, as a Galerkin method does: it passes
/// through the same weights as the stresses at t_n, and the leapfrog of the scheme stays of second order.
template <int Dim>
void body_force_to_grid(const std::vector<DrivenBody>& driven, const State<Dim>& state, Grid<Dim>& grid,
                        const StepContext& step);

}  // namespace geodrop
