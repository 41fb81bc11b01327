// How fast particles can swing on the nodes around them: what elasticity and membranes allow at most.
//
// With quadratic splines sum_i grad N_i grad N_i^T / N_i <= 6 / h^2 I at any place, so that nodes that move by v_i
// (their masses shared out by N_i m_p) strain a particle by no more than |L|^2 = sum over components of L^2 <= 6 / h^2
// sum_i N_i |v_i|^2. Its energy is half of L : D : L, with D the tensor of elasticity, hence
//
//   omega^2 <= 6 D_max / (rho h^2) = 6 d c_eff^2 / h^2,   c_eff^2 = D_max / (rho d),   D_max the largest eigenvalue of
//   D.
//
// A fluid has D_max = d K, and c_eff is the speed of sound; an isotropic solid max(2 (lambda + G), 2 G) in plane strain
// and max(3 K, 2 G) in space, below the d (lambda + 2 G) of compression waves along each axis at once.
#pragma once

#include <algorithm>
#include <cmath>

namespace geodrop {

/// Linear elasticity beside a membrane, all divided by the density [m2/s2].
struct ElasticSpeeds {
  double bulk, shear;  ///< K, G
  /// In the plane of the membrane: J / h in 2D, the largest eigenvalue of its stiffness over h in 3D.
  double membrane = 0;
};

/// c_eff^2 = D_max / d [m2/s2]. The membrane adds a t t t t to D (t along it), in space at most a for any stretch of
/// its plane.
template <int Dim>
double stiffest_mode(const ElasticSpeeds& s) {
  const double lambda = s.bulk - 2.0 / 3.0 * s.shear, along = lambda + 2 * s.shear, a = s.membrane;
  // Stretches of the line, or equal ones of the plane, of the membrane, and the stretch across: the larger root. The
  // smaller is that of shear alone.
  const double in_plane = Dim == 2 ? along + a : along + lambda + a;
  const double coupling = Dim == 2 ? lambda : std::sqrt(2.0) * lambda;
  const double stretches = 0.5 * (in_plane + along) + std::hypot(0.5 * (in_plane - along), coupling);
  const double unequal = 2 * s.shear + a;  // of the plane
  return (Dim == 2 ? stretches : std::max(stretches, unequal)) / Dim;
}

}  // namespace geodrop
