// One eigenvector of a symmetric 3 x 3 matrix, the best separated one, without iteration or branches, as its dyad; what
// is left acts in the plane across it. A double eigenvalue is always in that plane, where its directions do not matter.
// After Eberly, "A robust eigensolver for 3x3 symmetric matrices" (Geometric Tools).
//
// Jacobi sweeps were the alternative: 12 rotations, each with two square roots and two divisions, against two and
// three here in all.
#pragma once

#include "strain.hpp"

#include <array>

namespace geodrop {

/// cos(acos(r) / 3) for 0 <= r <= 1, to round-off: the largest root of 4 c^3 - 3 c = r.
template <class R>
[[gnu::always_inline]] inline R cos_third(const R& r) {
  // Interpolation of degree 7 at Chebyshev points, error 1.3e-8, then one Newton step. No acos near r = 1, where a
  // double eigenvalue would lose half its digits. Paired as by Estrin, to shorten the chain of dependent products.
  constexpr double a[] = {0.8660254163908416,    0.16666504306328017,  -0.048077350345927194,  0.02439238383784481,
                          -0.014289564843531721, 0.007664301779637839, -0.0029228305191963955, 0.0005426077173638078};
  const R r2 = r * r;
  const R low = (a[0] + a[1] * r) + r2 * (a[2] + a[3] * r);
  const R high = (a[4] + a[5] * r) + r2 * (a[6] + a[7] * r);
  const R c = low + r2 * r2 * high;
  const R c2 = c * c;
  return c - ((4.0 * c2 - 3.0) * c - r) / (12.0 * c2 - 3.0);
}

/// An eigenvector n of a symmetric tensor: its eigenvalue, and n n^T in the order of a stress.
template <class R>
struct EigenAxis {
  R eigenvalue;
  Stress<3, R> dyad;
};

/// Squared scale of a deviator, p^2 = s:s / 6 [Pa^2]. Its floor is far below any stress and gives an isotropic one a
/// harmless direction; its square is met below and must not underflow.
template <class R>
[[gnu::always_inline]] inline R squared_scale(const Stress<3, R>& s) {
  constexpr double sixth = 1.0 / 6.0, smallest_square = 1e-120;
  return max(sixth * norm_squared<3, R>(s), R(smallest_square));
}

/// The axis of the deviator `s` whose eigenvalue is farthest from the other two; p2 is its squared scale.
template <class R>
[[gnu::always_inline]] inline EigenAxis<R> separated_axis(const Stress<3, R>& s, const R& p2) {
  // The eigenvalues are 2 p cos(alpha + 2 pi k / 3) with cos(3 alpha) = det / (2 p^3).
  const auto& [xx, yy, zz, xy, yz, xz] = s;
  const R p = sqrt(p2), inverse = 1.0 / p2;
  const R det = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
  const R ratio = min(0.5 * abs(det) * inverse * (inverse * p), R(1.0));
  const R separated = 2.0 * p * cos_third(ratio);
  const R eigenvalue = select(det < 0.0, -separated, separated);
  // The adjugate of a matrix of rank 2 is a multiple of n n^T; its trace is 6 to 9 p^2 here.
  const R a = xx - eigenvalue, b = yy - eigenvalue, c = zz - eigenvalue;
  const R n_xx = b * c - yz * yz, n_yy = a * c - xz * xz, n_zz = a * b - xy * xy;
  const R scale = 1.0 / (n_xx + n_yy + n_zz);
  return {eigenvalue,
          {scale * n_xx, scale * n_yy, scale * n_zz, scale * (yz * xz - xy * c), scale * (xy * xz - a * yz),
           scale * (xy * yz - b * xz)}};
}

}  // namespace geodrop
