// Cloth that slides along the line that it lies on: how rest length flows until friction and tension balance.
//
// The line moves with the grid; q_k is the rest length that passes node k forwards, r_s = r_s^old + q_s - q_(s+1) that
// of segment s, of length L_s. The minimum of the convex
//   sum_s Phi(r_s) + sum_k (F_k |q_k| + z_k q_k^2 / 2 - g_k q_k),  Phi = J (r - L + L ln(L/r)) for r < L, else 0,
// has Phi' = -T with T_s = J max(0, L_s/r_s - 1), hence |T_k - T_(k-1) + g_k| <= F_k where the cloth sticks, and equal
// to F_k (+ z_k |q_k|) where it slides: stick, slip and slack follow without cases.
#pragma once

#include <cstddef>
#include <vector>

namespace geodrop {

/// A line of cloth with n segments: segment s runs from node s to node s + 1. Closed: n nodes, the last segment ends at
/// node 0. Open: n + 1 nodes, and nothing passes its ends. All per metre of depth.
struct Cloth {
  bool closed = true;
  double stiffness = 0;          ///< J [N/m]
  std::vector<double> length;    ///< L, of segments now [m], > 0
  std::vector<double> friction;  ///< F, of nodes: most that is handed on to what is below [N/m], >= 0
  std::vector<double> drag;      ///< z, of nodes [N/m2], > 0
  std::vector<double> load;      ///< g, of nodes: along the line, forwards [N/m]
  std::vector<double> rest;      ///< r, of segments: before, and then after [m], > 0
  std::vector<double> tension;   ///< of segments, at a step before: where the search begins [N/m], >= 0
  std::vector<double> passed;    ///< q, of nodes [m]: result

  std::size_t segments() const { return length.size(); }
  std::size_t nodes() const { return closed ? segments() : segments() + 1; }
  /// For n segments; values are not kept.
  void resize(std::size_t segments, bool as_closed);
};

/// Finds the minimum by its dual, a convex function of the tensions T >= 0,
///   sum_s (T_s r_s^old - J L_s ln(1 + T_s/J)) + sum_k max(0, |T_k - T_(k-1) + g_k| - F_k)^2 / (2 z_k),
/// whose gradient is what a segment has of rest length less what its tension asks for. Newton's method (Bertsekas 1982,
/// for bounds) with a tridiagonal matrix, from the tensions of the step before: stick, slip and slack need no search.
/// Where that takes more than some rounds, from more drag to less. Keeps its arrays from one step to the next.
class ClothSlide {
 public:
  /// False if it has not converged within `most_rounds`: nothing slides then. All z > 0.
  bool solve(Cloth& cloth);

  static constexpr int most_rounds = 200;

 private:
  static bool slack(double tension, double gradient) { return tension == 0 && gradient >= 0; }
  double passes(std::size_t k, double step) const;
  double find_gradient(const std::vector<double>& tension);
  void find_direction();
  void solve_tridiagonal();
  double advance(double least_gradient);
  bool descend(double softening, int rounds);

  Cloth* cloth_ = nullptr;
  std::vector<double> tension_, trial_, gradient_;
  std::vector<double> lightness_;                                           ///< of nodes: 1 / drag
  std::vector<double> lower_, diagonal_, upper_, right_, corner_, factor_;  // of Newton's system
};

/// The minimum without friction, as over a fluid, with a vanishing drag: one tension on each stretch without loads. On
/// a closed line the sum of the loads goes into the drag, evenly. F and z are not read.
void slide_freely(Cloth& cloth);

}  // namespace geodrop
