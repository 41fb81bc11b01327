// One eigenvector of a symmetric 3 x 3 matrix, the best separated one, without iteration or branches; the other two
// follow from the 2 x 2 problem in the plane across it. After Eberly, "A robust eigensolver for 3x3 symmetric
// matrices" (Geometric Tools). A double eigenvalue is always in that plane, where its directions do not matter.
//
// Jacobi sweeps were the alternative: 12 rotations, each with two square roots and two divisions, against three
// and five here in all.
#pragma once

#include "strain.hpp"

#include <array>

namespace geodrop {

/// Orthonormal axes; `axis` is an eigenvector.
template <class R>
struct PrincipalFrame {
  std::array<R, 3> u, w, axis;
};

/// cos(acos(r) / 3) for 0 <= r <= 1, to round-off: the largest root of 4 c^3 - 3 c = r.
template <class R>
[[gnu::always_inline]] inline R cos_third(const R& r) {
  // Interpolation of degree 7 at Chebyshev points, error 1.3e-8, then one Newton step. No acos near r = 1, where a
  // double eigenvalue would lose half its digits.
  constexpr double coefficients[] = {0.8660254163908416,    0.16666504306328017,  -0.048077350345927194,
                                     0.02439238383784481,   -0.014289564843531721, 0.007664301779637839,
                                     -0.0029228305191963955, 0.0005426077173638078};
  R c = broadcast<R>(coefficients[7]);
#pragma GCC unroll 7
  for (int k = 6; k >= 0; --k) c = c * r + coefficients[k];
  const R square = c * c;
  return c - ((4.0 * square - 3.0) * c - r) / (12.0 * square - 3.0);
}

/// Two unit vectors across a unit vector (Duff et al. 2017, "Building an orthonormal basis, revisited").
template <class R>
[[gnu::always_inline]] inline PrincipalFrame<R> complete_frame(const std::array<R, 3>& axis) {
  const auto& [x, y, z] = axis;
  const R sign = select(z < 0.0, broadcast<R>(-1.0), broadcast<R>(1.0));
  const R a = -1.0 / (sign + z);
  const R b = x * y * a;
  return {{1.0 + sign * x * x * a, sign * b, -sign * x}, {b, sign + y * y * a, -y}, axis};
}

/// Unit vector along the column of the adjugate of M with the largest diagonal entry; M is of rank 2.
template <class R>
[[gnu::always_inline]] inline std::array<R, 3> null_vector(const Stress<3, R>& M) {
  const auto [xx, yy, zz, xy, yz, xz] = M;
  const R a_xx = yy * zz - yz * yz, a_yy = xx * zz - xz * xz, a_zz = xx * yy - xy * xy;
  const R a_xy = yz * xz - xy * zz, a_xz = xy * yz - yy * xz, a_yz = xy * xz - xx * yz;
  const auto y_leads = a_yy > a_xx;
  const R lead = max(a_xx, a_yy);
  const auto z_leads = a_zz > lead;
  const R v0 = select(z_leads, a_xz, select(y_leads, a_xy, a_xx));
  const R v1 = select(z_leads, a_yz, select(y_leads, a_yy, a_xy));
  const R v2 = select(z_leads, a_zz, select(y_leads, a_yz, a_xz));
  const R inverse = 1.0 / sqrt(v0 * v0 + v1 * v1 + v2 * v2);
  return {v0 * inverse, v1 * inverse, v2 * inverse};
}

/// Frame whose axis belongs to the eigenvalue of `stress` that is farthest from the other two.
template <class R>
[[gnu::always_inline]] inline PrincipalFrame<R> principal_frame(const Stress<3, R>& stress) {
  constexpr double third = 1.0 / 3.0, sixth = 1.0 / 6.0;
  // Floor of the deviator [Pa^2]: far below any stress; gives an isotropic one a harmless frame.
  const double smallest_square = 1e-200;
  const R mean = third * (stress[0] + stress[1] + stress[2]);
  Stress<3, R> B{stress[0] - mean, stress[1] - mean, stress[2] - mean, stress[3], stress[4], stress[5]};
  const R inverse_scale = 1.0 / sqrt(max(sixth * norm_squared<3, R>(B), broadcast<R>(smallest_square)));
  for (R& component : B) component *= inverse_scale;
  // The eigenvalues of B are 2 cos(alpha + 2 pi k / 3) with cos(3 alpha) = det(B) / 2.
  const R half_det = 0.5 * (B[0] * (B[1] * B[2] - B[4] * B[4]) - B[3] * (B[3] * B[2] - B[4] * B[5]) +
                            B[5] * (B[3] * B[4] - B[1] * B[5]));
  const R separated = 2.0 * cos_third(min(abs(half_det), broadcast<R>(1.0)));
  const R eigenvalue = select(half_det < 0.0, -separated, separated);
  return complete_frame(null_vector<R>({B[0] - eigenvalue, B[1] - eigenvalue, B[2] - eigenvalue, B[3], B[4], B[5]}));
}

}  // namespace geodrop
