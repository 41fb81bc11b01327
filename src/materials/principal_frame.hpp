// One eigenvector of a symmetric 3 x 3 matrix, the best separated one, without iteration or branches; the other two
// follow from the 2 x 2 problem in the plane across it. After Eberly, "A robust eigensolver for 3x3 symmetric
// matrices" (Geometric Tools). A double eigenvalue is always in that plane, where its directions do not matter.
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

/// Column of the adjugate of M with the largest diagonal entry: spans the null space of M, which is of rank 2.
template <class R>
[[gnu::always_inline]] inline std::array<R, 3> null_vector(const Stress<3, R>& M) {
  const auto [xx, yy, zz, xy, yz, xz] = M;
  const R a_xx = yy * zz - yz * yz, a_yy = xx * zz - xz * xz, a_zz = xx * yy - xy * xy;
  const R a_xy = yz * xz - xy * zz, a_xz = xy * yz - yy * xz, a_yz = xy * xz - xx * yz;
  const auto y_leads = a_yy > a_xx;
  const auto z_leads = a_zz > max(a_xx, a_yy);
  return {select(z_leads, a_xz, select(y_leads, a_xy, a_xx)), select(z_leads, a_yz, select(y_leads, a_yy, a_xy)),
          select(z_leads, a_zz, select(y_leads, a_yz, a_xz))};
}

/// Eigenvector of `stress` whose eigenvalue is farthest from the other two; its length means nothing.
template <class R>
[[gnu::always_inline]] inline std::array<R, 3> separated_eigenvector(const Stress<3, R>& stress) {
  constexpr double third = 1.0 / 3.0, sixth = 1.0 / 6.0;
  // Floor of the deviator [Pa^2]: far below any stress; gives an isotropic one a harmless direction. Its square is
  // met below and must not underflow.
  const double smallest_square = 1e-120;
  const R mean = third * (stress[0] + stress[1] + stress[2]);
  const R xx = stress[0] - mean, yy = stress[1] - mean, zz = stress[2] - mean;
  const R xy = stress[3], yz = stress[4], xz = stress[5];
  // The eigenvalues of the deviator are 2 p cos(alpha + 2 pi k / 3), p^2 = s:s / 6, cos(3 alpha) = det / (2 p^3).
  const R p2 = max(sixth * norm_squared<3, R>({xx, yy, zz, xy, yz, xz}), R(smallest_square));
  const R p = sqrt(p2);
  const R det = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
  const R ratio = min(0.5 * abs(det) / (p * p2), R(1.0));
  const R separated = 2.0 * p * cos_third(ratio);
  const R eigenvalue = select(det < 0.0, -separated, separated);
  return null_vector<R>({xx - eigenvalue, yy - eigenvalue, zz - eigenvalue, xy, yz, xz});
}

/// Householder reflection I - beta h h^T. It is its own inverse and its own transpose.
template <class R>
struct Reflection {
  std::array<R, 3> h;
  R beta;
};

/// The reflection that turns v, of any length but zero, into the z axis (or -z).
template <class R>
[[gnu::always_inline]] inline Reflection<R> reflection_to_z(const std::array<R, 3>& v) {
  const auto& [x, y, z] = v;
  const R length = sqrt(x * x + y * y + z * z);
  const R h_z = z + select(z < 0.0, -length, length);
  return {{x, y, h_z}, 1.0 / (length * abs(h_z))};
}

/// H S H of a symmetric tensor.
template <class R>
[[gnu::always_inline]] inline Stress<3, R> reflect(const Reflection<R>& reflection, const Stress<3, R>& s) {
  const auto& [x, y, z] = reflection.h;
  const R& beta = reflection.beta;
  // H S H = S - h w^T - w h^T with q = beta S h, w = q - (beta/2) (h.q) h.
  const R q_x = beta * (s[0] * x + s[3] * y + s[5] * z);
  const R q_y = beta * (s[3] * x + s[1] * y + s[4] * z);
  const R q_z = beta * (s[5] * x + s[4] * y + s[2] * z);
  const R along = 0.5 * beta * (x * q_x + y * q_y + z * q_z);
  const R w_x = q_x - along * x, w_y = q_y - along * y, w_z = q_z - along * z;
  return {s[0] - 2.0 * x * w_x,     s[1] - 2.0 * y * w_y,     s[2] - 2.0 * z * w_z,
          s[3] - x * w_y - y * w_x, s[4] - y * w_z - z * w_y, s[5] - x * w_z - z * w_x};
}

}  // namespace geodrop
