// The tractions at which the rows of sharp membranes are held.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "node_rows.hpp"

namespace geodrop {

/// What the tractions of rows do to the velocities of the rows: S = E K E^T + D, of the nodes' masses within E, the
/// drag K of pore water (empty: none) and the flow D through the membrane.
struct System {
  SparseRows S;
  Eigen::VectorXd rate;  ///< of the rows without tractions: E K v / dt
};

/// Tractions of rows, and whether they are as exact as asked: to 1e-8 of the rate.
struct Solution {
  Eigen::VectorXd traction;
  bool converged;
};

/// Tractions that stop the gaps from opening and closing, and the slip where it sticks, S x = rate. Those of some rows
/// may only push, x >= 0: rows that would pull are open, and take no part, unless their gap would close then
/// (primal-dual active sets, Hintermueller et al. 2002; ten rounds). S is symmetric and at least semi-definite. Dim:
/// the rows are those along outlines (2) or on surfaces (3).
template <int Dim>
Solution solve_tractions(const System& system, const std::vector<bool>& only_pushes, const Eigen::VectorXd& guess);

}  // namespace geodrop
