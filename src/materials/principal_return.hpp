// Return of an elastic trial stress to the Mohr-Coulomb pyramid with a tension cut-off, in principal space.
// Exact in closed form: every facet, edge and corner has its own linear formula, and `select` picks one.
//
// With s1 >= s2 >= s3, tension positive, k = 2 c cos(phi):
//   shear planes  f_ij = (1 + sin phi) s_i - (1 - sin phi) s_j - k,  (ij) = (13), (12), (23)
//   flow          g_ij = (1 + sin psi) s_i - (1 - sin psi) s_j       (non-associated)
//   cut-off       s_i <= t, associated (Rankine); t <= c cot(phi)
// A return subtracts D : (sum of multipliers times flow), D from lambda = K - 2G/3 and G. It is accepted where its
// multipliers are not negative and no other surface is violated, which is exact for linear elasticity and planes.
//
// With psi = 0 plastic flow on the shear planes keeps the mean stress, so no flow rule can bring a trial whose
// mean stress lies above c cot(phi) back to the apex. Wherever no multipliers exist, the rule here is explicit: the
// stress becomes the corner (t, t, m), where m is the s3 at which the shear planes meet the cut-off; m = t at the
// apex. Reference: Clausen, Damkilde & Andersen (2007) for the regions, without the cut-off.
#pragma once

#include <geodrop/base/packet.hpp>
#include <geodrop/materials/materials.hpp>

namespace geodrop {

/// Principal stresses [Pa], first >= second >= third.
template <class R>
struct Principal {
  R first, second, third;
};

template <class R, class Mask>
[[gnu::always_inline]] inline Principal<R> select(const Mask& mask, const Principal<R>& yes, const Principal<R>& no) {
  return {select(mask, yes.first, no.first), select(mask, yes.second, no.second), select(mask, yes.third, no.third)};
}

/// Angles of friction and dilatancy: of a material, or of each point (S a packet).
template <class S>
struct FlowAngles {
  S sin_phi, cos_phi, sin_psi;
};

/// What the return needs of a material; loop-invariant if S is double, so the compiler moves it out of the loop over
/// points.
template <class S>
struct YieldSurface {
  double lambda, shear;      ///< Lame's constants [Pa]
  S plus_phi, minus_phi;     ///< 1 + sin(phi), 1 - sin(phi)
  S plus_psi, minus_psi;     ///< 1 + sin(psi), 1 - sin(psi)
  S strength;                ///< k = 2 c cos(phi) [Pa]
  S cutoff;                  ///< t [Pa]
  S meeting;                 ///< m, s3 where f_13 = 0 and s1 = t [Pa]
  S flow_first, flow_third;  ///< D : flow of g_13, first and third component [Pa]
  S flow_volume;             ///< its second component, 2 lambda sin(psi) [Pa]
  S stiffness;               ///< f_13 : D : g_13 [Pa]
  S compression_edge;        ///< f_13 : D : g_12, s2 = s3 [Pa]
  S extension_edge;          ///< f_13 : D : g_23, s1 = s2 [Pa]

  [[gnu::always_inline]] explicit YieldSurface(const MohrCoulomb& soil)
      : YieldSurface(soil, {soil.sin_phi, soil.cos_phi, soil.sin_psi}, soil.tension_cutoff) {}

  [[gnu::always_inline]] YieldSurface(const MohrCoulomb& soil, const FlowAngles<S>& angles, const S& tension)
      : lambda(soil.bulk_modulus - 2.0 / 3.0 * soil.shear_modulus),
        shear(soil.shear_modulus),
        plus_phi(1.0 + angles.sin_phi),
        minus_phi(1.0 - angles.sin_phi),
        plus_psi(1.0 + angles.sin_psi),
        minus_psi(1.0 - angles.sin_psi),
        strength(2.0 * soil.cohesion * angles.cos_phi),
        cutoff(tension),
        meeting((plus_phi * cutoff - strength) / minus_phi),
        flow_first(2.0 * lambda * angles.sin_psi + 2.0 * shear * plus_psi),
        flow_third(2.0 * lambda * angles.sin_psi - 2.0 * shear * minus_psi),
        flow_volume(2.0 * lambda * angles.sin_psi),
        stiffness(4.0 * lambda * angles.sin_phi * angles.sin_psi +
                  4.0 * shear * (1.0 + angles.sin_phi * angles.sin_psi)),
        compression_edge(4.0 * lambda * angles.sin_phi * angles.sin_psi + 2.0 * shear * plus_phi * plus_psi),
        extension_edge(4.0 * lambda * angles.sin_phi * angles.sin_psi + 2.0 * shear * minus_phi * minus_psi) {}
};
YieldSurface(const MohrCoulomb&)->YieldSurface<double>;

/// f of a pair of principal stresses [Pa]; yielding where positive.
template <class S, class R>
[[gnu::always_inline]] inline R shear_yield(const YieldSurface<S>& surface, const R& high, const R& low) {
  return surface.plus_phi * high - surface.minus_phi * low - surface.strength;
}

template <class S, class R>
[[gnu::always_inline]] inline auto violates(const YieldSurface<S>& surface, const Principal<R>& trial) {
  return (shear_yield(surface, trial.first, trial.third) > 0.0) | (trial.first > surface.cutoff);
}

/// Where the stresses of a mean and a squared scale p^2 = s:s / 6 leave the cone inscribed in the yield surface; inside
/// of it none of them yields, whatever round-off makes of it.
//
// s1 and s3 are m + 2 p cos(alpha), m + 2 p cos(alpha + 2 pi / 3); f_13 = 2 sin(phi) m - k + 2 p (...), of which the
// bracket is sqrt(3 + sin(phi)^2) at most, and s1 <= m + 2 p.
template <class S, class R>
[[gnu::always_inline]] inline auto leaves_cone(const YieldSurface<S>& y, const R& mean, const R& p2) {
  constexpr double round_off = 1e-13;
  const S twice_sine = y.plus_phi - y.minus_phi;
  const S slope = (12.0 + twice_sine * twice_sine) * (1 + round_off);
  const R margin = round_off * abs(mean);
  const R shear_room = y.strength - twice_sine * mean - margin, tension_room = y.cutoff - mean - margin;
  const R room = min(shear_room, tension_room);
  return (room <= 0.0) | (slope * p2 >= shear_room * shear_room) |
         (4.0 * p2 * (1 + round_off) >= tension_room * tension_room);
}

/// Returns where the cut-off is active: its plane, its edge, its line with the shear plane, its corners.
template <class S, class R>
[[gnu::always_inline]] inline Principal<R> return_to_cutoff(const YieldSurface<S>& y, const Principal<R>& trial) {
  const R t = y.cutoff, m = y.meeting;
  const auto& [x1, x2, x3] = trial;

  // Line s1 = t, s3 = m of g_13 and the cut-off; with s2 kept between its ends also where no multipliers exist, or
  // round-off denies them (soil that rests in the corner (t, m, m) and is sheared there).
  const double modulus = y.lambda + 2.0 * y.shear;
  const S scale = 1.0 / (4.0 * y.shear * y.minus_psi * (y.lambda + y.shear));
  const R shear_multiplier = (y.lambda * (x1 - t) - modulus * (x3 - m)) * scale;
  const R cutoff_multiplier = (y.flow_first * (x3 - m) - y.flow_third * (x1 - t)) * scale;
  const R line2 = x2 - y.flow_volume * shear_multiplier - y.lambda * cutoff_multiplier;
  Principal<R> best{t, min(max(line2, R(m)), R(t)), m};

  // Corner (t, t, t): the trial strain from there, (2G e_i) = y_i - nu/(1 + nu) tr y, is tensile along all axes.
  const double nu_ratio = y.lambda / (3.0 * y.lambda + 2.0 * y.shear);
  const R sum = x1 + x2 + x3;
  best = select(x3 - t - nu_ratio * (sum - 3.0 * t) >= 0.0, Principal<R>{t, t, t}, best);

  // Corner (t, m, m) of g_13, g_12 and the cut-off: multipliers follow component by component.
  const R spread = nu_ratio * (sum - t - 2.0 * m);
  const R e1 = x1 - t - spread, e2 = x2 - m - spread, e3 = x3 - m - spread;
  best = select((e2 <= 0.0) & (y.minus_psi * e1 + y.plus_psi * (e2 + e3) >= 0.0), Principal<R>{t, m, m}, best);

  // Edge s1 = s2 = t. Beyond its end is the corner (t, t, t), also where round-off denies that corner its multiplier:
  // in plane strain a soil without stress is stretched along two axes only, so its trial lies exactly between the two.
  const R plane = (x1 - t) * (y.lambda / modulus);
  const R on_plane2 = x2 - plane, on_plane3 = x3 - plane;
  const R edge3 = min(x3 - (x1 + x2 - 2.0 * t) * (y.lambda / (2.0 * (y.lambda + y.shear))), t);
  best = select((on_plane2 > t) & (edge3 >= m), Principal<R>{t, t, edge3}, best);

  best = select((shear_multiplier >= 0.0) & (cutoff_multiplier >= 0.0) & (line2 >= m) & (line2 <= t),
                Principal<R>{t, line2, m}, best);

  // Plane s1 = t.
  return select((x1 > t) & (on_plane2 <= t) & (on_plane3 >= m), Principal<R>{t, on_plane2, on_plane3}, best);
}

/// Edges of the pyramid where the return to its shear plane breaks the order of the stresses.
template <class S, class R>
[[gnu::always_inline]] inline Principal<R> return_to_edges(const YieldSurface<S>& y, const Principal<R>& trial,
                                                           const R& f13, const Principal<R>& plane) {
  const auto& [x1, x2, x3] = trial;
  // Triaxial compression, s2 = s3: sum of the multipliers of g_13 and g_12.
  const R compression = (f13 + shear_yield(y, x1, x2)) * (1.0 / (y.stiffness + y.compression_edge));
  const R compression1 = x1 - y.flow_first * compression;
  const R compression3 = 0.5 * (x2 + x3) - 0.5 * (y.flow_volume + y.flow_third) * compression;

  // Triaxial extension, s1 = s2: sum of the multipliers of g_13 and g_23.
  const R extension = (f13 + shear_yield(y, x2, x3)) * (1.0 / (y.stiffness + y.extension_edge));
  const R extension1 = 0.5 * (x1 + x2) - 0.5 * (y.flow_volume + y.flow_first) * extension;
  const R extension3 = x3 - y.flow_third * extension;

  const Principal<R> best =
      select(plane.second < plane.third, Principal<R>{compression1, compression3, compression3}, plane);
  return select((plane.second > plane.first) & (extension1 <= y.cutoff),
                Principal<R>{extension1, extension1, extension3}, best);
}

/// The stress on the yield surface that belongs to a sorted trial stress [Pa] outside of it; `outside` tells which
/// lanes that holds for, the others get their trial stress back.
template <class S, class R, class Mask>
[[gnu::always_inline]] inline Principal<R> return_to_yield(const YieldSurface<S>& y, const Principal<R>& trial,
                                                           const Mask& outside) {
  const auto& [x1, x2, x3] = trial;
  const R f13 = shear_yield(y, x1, x3);

  // Shear plane. Where it breaks the order of the stresses, one of the edges is next.
  const R multiplier = f13 * (1.0 / y.stiffness);
  const Principal<R> plane{x1 - y.flow_first * multiplier, x2 - y.flow_volume * multiplier,
                           x3 - y.flow_third * multiplier};
  const auto below = plane.second < plane.third;
  const auto above = plane.second > plane.first;
  Principal<R> best = plane;
  if (any_lane((below | above) & outside)) best = return_to_edges(y, trial, f13, plane);
  best = select(outside, best, trial);
  const auto open = (best.first > y.cutoff) | (best.second > best.first) | (outside & (f13 <= 0.0));
  if (any_lane(open)) best = select(open, return_to_cutoff(y, trial), best);
  return best;
}

}  // namespace geodrop
