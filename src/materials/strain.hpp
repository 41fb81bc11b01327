// Strain increments and the rotation of stress, shared by all laws. One point or one packet of points.
//
// The velocity-gradient increment dL = dt grad v is row-major: dL[a * Dim + b] = dt dv_a/dx_b.
#pragma once

#include <geodrop/base/packet.hpp>
#include <geodrop/base/types.hpp>

#include <array>

namespace geodrop {

template <int Dim, class R>
using Gradient = std::array<R, Dim * Dim>;
template <int Dim, class R>
using Stress = std::array<R, stress_components<Dim>>;

/// Deviator of sym(dL), as tensor components in the order of a stress. In plane strain e_zz = 0, so the
/// deviator is the three-dimensional one: tr/3 is taken from xx and yy, and zz = -tr/3.
template <int Dim, class R>
[[gnu::always_inline]] inline Stress<Dim, R> deviator(const Gradient<Dim, R>& dL) {
  constexpr double third = 1.0 / 3.0;
  if constexpr (Dim == 2) {
    const R mean = third * (dL[0] + dL[3]);
    return {dL[0] - mean, dL[3] - mean, -mean, 0.5 * (dL[1] + dL[2])};
  } else {
    const R mean = third * (dL[0] + dL[4] + dL[8]);
    return {dL[0] - mean,          dL[4] - mean,          dL[8] - mean,
            0.5 * (dL[1] + dL[3]), 0.5 * (dL[5] + dL[7]), 0.5 * (dL[2] + dL[6])};
  }
}

/// Double contraction e:e of a symmetric tensor.
template <int Dim, class R>
[[gnu::always_inline]] inline R norm_squared(const Stress<Dim, R>& e) {
  R shear = e[3] * e[3];
  if constexpr (Dim == 3) shear += e[4] * e[4] + e[5] * e[5];
  return e[0] * e[0] + e[1] * e[1] + e[2] * e[2] + 2.0 * shear;
}

/// Q stress Q^T with the incremental rotation of Hughes & Winget (1980), Q = (I - W/2)^-1 (I + W/2),
/// W = skew(dL). Q is orthogonal for any increment. A spin w turns by 2 atan(w/2) = w - w^3/12 + ...
template <class R>
[[gnu::always_inline]] inline void rotate(const Gradient<2, R>& dL, Stress<2, R>& stress) {
  // The half-difference and xy of a stress turn by twice the angle. With tan(angle / 2) = h its cosine and sine are
  // even / (1 + h^2)^2 and odd / (1 + h^2)^2; the division runs beside the products.
  const R h = 0.25 * (dL[1] - dL[2]);
  const R minus = 1.0 - h * h, plus = 1.0 + h * h;
  const R even = minus * minus - 4.0 * h * h, odd = 4.0 * h * minus;
  const R scale = 1.0 / (plus * plus);
  const R mean = 0.5 * (stress[0] + stress[1]);
  const R half_difference = 0.5 * (stress[0] - stress[1]);
  const R turned = (even * half_difference + odd * stress[3]) * scale;
  stress[3] = (even * stress[3] - odd * half_difference) * scale;
  stress[0] = mean + turned;
  stress[1] = mean - turned;
}

template <class R>
[[gnu::always_inline]] inline void rotate(const Gradient<3, R>& dL, Stress<3, R>& stress) {
  // Half the axial vector t of W gives Q = (1 - f t.t) I + f (t t^T + [t]x), f = 2 / (1 + t.t).
  const R tx = 0.25 * (dL[7] - dL[5]), ty = 0.25 * (dL[2] - dL[6]), tz = 0.25 * (dL[3] - dL[1]);
  const R square = tx * tx + ty * ty + tz * tz;
  const R f = 2.0 / (1.0 + square);
  const R diagonal = 1.0 - f * square;
  const R q[9] = {diagonal + f * tx * tx, f * (tx * ty - tz),     f * (tx * tz + ty),
                  f * (tx * ty + tz),     diagonal + f * ty * ty, f * (ty * tz - tx),
                  f * (tx * tz - ty),     f * (ty * tz + tx),     diagonal + f * tz * tz};
  const auto [xx, yy, zz, xy, yz, xz] = stress;
  R b[9];  // Q stress
#pragma GCC unroll 3
  for (int a = 0; a < 3; ++a) {
    b[3 * a] = q[3 * a] * xx + q[3 * a + 1] * xy + q[3 * a + 2] * xz;
    b[3 * a + 1] = q[3 * a] * xy + q[3 * a + 1] * yy + q[3 * a + 2] * yz;
    b[3 * a + 2] = q[3 * a] * xz + q[3 * a + 1] * yz + q[3 * a + 2] * zz;
  }
  const auto entry = [&](int i, int j) __attribute__((always_inline)) {
    return b[3 * i] * q[3 * j] + b[3 * i + 1] * q[3 * j + 1] + b[3 * i + 2] * q[3 * j + 2];
  };
  stress = {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(0, 2)};
}

/// What spins moves along the tangent of its circle in a step, x += dt v, and lies farther out after it: dL gains this
/// stretch of the second order, -W W / 2 with W = skew(dL), from ln sqrt(dF^T dF), dF = I + dL. Returns its trace.
template <int Dim, class R>
[[gnu::always_inline]] inline R add_stretch_of_spin(Gradient<Dim, R>& dL) {
  if constexpr (Dim == 2) {
    const R w = 0.5 * (dL[1] - dL[2]);
    const R stretch = 0.5 * w * w;
    dL[0] += stretch;
    dL[3] += stretch;
    return stretch + stretch;
  } else {
    const R x = 0.5 * (dL[7] - dL[5]), y = 0.5 * (dL[2] - dL[6]), z = 0.5 * (dL[3] - dL[1]);
    const R xx = 0.5 * x * x, yy = 0.5 * y * y, zz = 0.5 * z * z;
    const R xy = 0.5 * x * y, yz = 0.5 * y * z, xz = 0.5 * x * z;
    dL[0] += yy + zz;
    dL[4] += xx + zz;
    dL[8] += xx + yy;
    dL[1] = dL[1] - xy;
    dL[3] = dL[3] - xy;
    dL[5] = dL[5] - yz;
    dL[7] = dL[7] - yz;
    dL[2] = dL[2] - xz;
    dL[6] = dL[6] - xz;
    return 2.0 * (xx + yy + zz);
  }
}

/// stress += 2 G deviator + K dvol I, zz included in plane strain.
template <int Dim, class R, class Law>
[[gnu::always_inline]] inline void add_elastic(const Law& law, const Stress<Dim, R>& deviatoric, const R& dvol,
                                               Stress<Dim, R>& stress) {
  const double two_g = 2.0 * law.shear_modulus;
  const R mean = law.bulk_modulus * dvol;
#pragma GCC unroll 6
  for (int k = 0; k < stress_components<Dim>; ++k) stress[k] += two_g * deviatoric[k] + (k < 3 ? mean : R{});
}

// What a law's update_point(points, law, rates, dt, p, k) is made of: it advances the state variables of particle p, or
// of a packet from p on, by rates of entry k of a chunk, see transfer/chunk_laws.hpp.

template <int Dim, class R>
std::array<R, Dim * Dim> load_increment(const auto& rates, int k) {
  std::array<R, Dim * Dim> out;
  for (int c = 0; c < Dim * Dim; ++c) out[c] = load<R>(&rates.increment[c][k]);
  return out;
}

template <int Dim, class R>
std::array<R, stress_components<Dim>> load_stress(const auto& points, std::size_t p) {
  std::array<R, stress_components<Dim>> sigma;
  for (int c = 0; c < stress_components<Dim>; ++c) sigma[c] = load<R>(&points.stress[c][p]);
  return sigma;
}

inline double bulk_modulus(double youngs_modulus, double poissons_ratio) {
  return youngs_modulus / (3.0 * (1.0 - 2.0 * poissons_ratio));
}

inline double shear_modulus(double youngs_modulus, double poissons_ratio) {
  return youngs_modulus / (2.0 * (1.0 + poissons_ratio));
}

}  // namespace geodrop
