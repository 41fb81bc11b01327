// The material laws at work on chunks of particles: what a chunk carries to the grid, and what the grid's rates do to
// it. Compiled once per dimension (constitutive_2d.cpp, _3d.cpp), whatever the basis and the transfer.
#pragma once

#include "../materials/laws.hpp"
#include "chunk_laws.hpp"

namespace geodrop {

/// Calls f(law) with the body's concrete law. A chain of get_if because std::visit does not inline into clones.
template <class F, class... Law>
void with_law(const std::variant<Law...>& material, F&& f) {
  const auto one = [&]<class L>(const L* law) {
    if (law) f(*law);
    return law != nullptr;
  };
  (one(std::get_if<Law>(&material)) || ...);
}

/// Volume [m3] and pressure [Pa] of a chunk of particles.
template <int Dim>
void volumes_and_pressures(const Body<Dim>& body, const Newtonian& water, std::size_t begin, int count, double* volume,
                           double* pressure) {
  const double* const J = body.J.data() + begin;
  const double* const mass = body.mass.data() + begin;
  const double inv_rho = 1 / water.density, K = water.bulk_modulus;
  for (int k = 0; k < count; ++k) {
    volume[k] = mass[k] * inv_rho * J[k];
    pressure[k] = K * (1 / J[k] - 1);
  }
  if (!water.cavitates()) return;
  for (int k = 0; k < count; ++k) pressure[k] = std::max(pressure[k], -water.tension_cutoff);
}

/// Soil and elastic solids.
template <int Dim, class Solid>
void volumes_and_pressures(const Body<Dim>& body, const Solid& solid, std::size_t begin, int count, double* volume,
                           double* pressure) {
  const double density = solid.density;
  const double* const pore = body.pore_pressure.empty() ? nullptr : body.pore_pressure.data() + begin;
  for (int k = 0; k < count; ++k) {
    const std::size_t p = begin + k;
    volume[k] = body.mass[p] * body.J[p] / density;
    pressure[k] = (pore ? pore[k] : 0.0) - (body.stress[0][p] + body.stress[1][p] + body.stress[2][p]) / 3;
  }
}

template <int Dim>
void carried_stress(const Body<Dim>& body, const Newtonian& water, std::size_t begin, int count, const double* own,
                    ChunkStress<Dim>& out) {
  const double* const mass = body.mass.data() + begin;
  const double* const J = body.J.data() + begin;
  const double inv_rho = 1 / water.density, K = water.bulk_modulus;
  alignas(64) double pressure_force[chunk_size];  // V p
#pragma omp simd
  for (int k = 0; k < count; ++k) {
    out.volume[k] = mass[k] * inv_rho * J[k];
    pressure_force[k] = own[k] * K * mass[k] * inv_rho * (1 - J[k]);
  }
  if (water.cavitates())
    for (int k = 0; k < count; ++k)
      pressure_force[k] = std::max(pressure_force[k], -own[k] * out.volume[k] * water.tension_cutoff);
  for (const int c : acting_components<Dim>) {
    if (c < 3)
      std::copy_n(pressure_force, count, out.s[c]);
    else
      std::fill_n(out.s[c], count, 0.0);
    if (!water.viscous()) continue;
    const double* const viscous = body.stress[c].data() + begin;
#pragma omp simd
    for (int k = 0; k < count; ++k) out.s[c][k] -= out.volume[k] * viscous[k];
  }
}

/// Soil and elastic solids: total stress sigma' - u 1, less its mean where the cell carries that.
template <int Dim, class Solid>
void carried_stress(const Body<Dim>& body, const Solid& solid, std::size_t begin, int count, const double* own,
                    ChunkStress<Dim>& out) {
  alignas(64) double removed[chunk_size];
  const double* const mass = body.mass.data() + begin;
  const double* const J = body.J.data() + begin;
  const double* const xx = body.stress[0].data() + begin;
  const double* const yy = body.stress[1].data() + begin;
  const double* const zz = body.stress[2].data() + begin;
  const double inv_rho = 1 / solid.density;
#pragma omp simd
  for (int k = 0; k < count; ++k) {
    out.volume[k] = mass[k] * inv_rho * J[k];
    removed[k] = (1 - own[k]) * (xx[k] + yy[k] + zz[k]) / 3;
  }
  if (!body.pore_pressure.empty()) {
    const double* const pore = body.pore_pressure.data() + begin;
#pragma omp simd
    for (int k = 0; k < count; ++k) removed[k] += own[k] * pore[k];
  }
  for (const int c : acting_components<Dim>) {
    const double* const sigma = body.stress[c].data() + begin;
    const double normal = c < 3 ? 1.0 : 0.0;
#pragma omp simd
    for (int k = 0; k < count; ++k) out.s[c][k] = -out.volume[k] * (sigma[k] - normal * removed[k]);
  }
}

template <int Dim, class R>
std::array<R, Dim * Dim> load_increment(const ChunkRates<Dim>& rates, int k) {
  std::array<R, Dim * Dim> out;
  for (int c = 0; c < Dim * Dim; ++c) out[c] = load<R>(&rates.increment[c][k]);
  return out;
}

template <int Dim, class R>
void update_point(Body<Dim>& body, const Newtonian& water, const ChunkRates<Dim>& rates, double dt, std::size_t p,
                  int k) {
  store(&body.J[p], load<R>(&body.J[p]) * (1 + load<R>(&rates.volume[k])));
  if (!water.viscous()) return;
  const auto s = viscous_stress<Dim, R>(water, dt, load_increment<Dim, R>(rates, k));
  for (int c = 0; c < stress_components<Dim>; ++c) store(&body.stress[c][p], s[c]);
}

template <int Dim, class R>
std::array<R, stress_components<Dim>> load_stress(const Body<Dim>& body, std::size_t p) {
  std::array<R, stress_components<Dim>> sigma;
  for (int c = 0; c < stress_components<Dim>; ++c) sigma[c] = load<R>(&body.stress[c][p]);
  return sigma;
}

template <int Dim, class R>
void update_point(Body<Dim>& body, const LinearElastic& solid, const ChunkRates<Dim>& rates, double, std::size_t p,
                  int k) {
  const R volume = load<R>(&rates.volume[k]);
  auto sigma = load_stress<Dim, R>(body, p);
  update_stress<Dim, R>(solid, load_increment<Dim, R>(rates, k), volume, sigma);
  for (int c = 0; c < stress_components<Dim>; ++c) store(&body.stress[c][p], sigma[c]);
  store(&body.J[p], load<R>(&body.J[p]) * (1 + volume));
}

template <int Dim, class R>
void update_point(Body<Dim>& body, const MohrCoulomb& soil, const ChunkRates<Dim>& rates, double, std::size_t p,
                  int k) {
  const R volume = load<R>(&rates.volume[k]);
  auto sigma = load_stress<Dim, R>(body, p);
  const R strain = update_stress<Dim, R>(soil, load_increment<Dim, R>(rates, k), volume, sigma);
  for (int c = 0; c < stress_components<Dim>; ++c) store(&body.stress[c][p], sigma[c]);
  store(&body.deviatoric_strain[p], load<R>(&body.deviatoric_strain[p]) + strain);
  store(&body.J[p], load<R>(&body.J[p]) * (1 + volume));
  if (!body.pore_pressure.empty())
    store(&body.pore_pressure[p], load<R>(&body.pore_pressure[p]) + pore_pressure_increment(soil, volume));
}

/// J takes dvol as it is: particles' volumes change by what flows through the surface, to round-off.
template <int Dim, class R>
void update_point(Body<Dim>& body, const MohrCoulombWithVoids& soil, const ChunkRates<Dim>& rates, double,
                  std::size_t p, int k) {
  const R volume = load<R>(&rates.volume[k]);
  auto sigma = load_stress<Dim, R>(body, p);
  R gap = load<R>(&body.gap[p]);
  const VoidStep<R> step = update_stress<Dim, R>(soil, load_increment<Dim, R>(rates, k), volume, sigma, gap);
  for (int c = 0; c < stress_components<Dim>; ++c) store(&body.stress[c][p], sigma[c]);
  store(&body.gap[p], gap);
  store(&body.deviatoric_strain[p], load<R>(&body.deviatoric_strain[p]) + step.deviatoric_strain);
  store(&body.J[p], load<R>(&body.J[p]) * (1 + volume));
  if (!body.pore_pressure.empty())
    store(&body.pore_pressure[p],
          load<R>(&body.pore_pressure[p]) + pore_pressure_increment<R>(soil, step.volumetric_strain));
}

/// J is det F: the volume rate of the cell has no part in it.
template <int Dim, class R>
void update_point(Body<Dim>& body, const NeoHookean& solid, const ChunkRates<Dim>& rates, double, std::size_t p,
                  int k) {
  std::array<R, Dim * Dim> F;
  for (int c = 0; c < Dim * Dim; ++c) F[c] = load<R>(&body.deformation[c][p]);
  deform<Dim, R>(load_increment<Dim, R>(rates, k), F);
  const R J = determinant<R>(F);
  const auto sigma = neo_hookean_stress<Dim, R>(solid, F, J);
  for (int c = 0; c < Dim * Dim; ++c) store(&body.deformation[c][p], F[c]);
  for (int c = 0; c < stress_components<Dim>; ++c) store(&body.stress[c][p], sigma[c]);
  store(&body.J[p], J);
}

template <int Dim, class Law>
void update_chunk(Body<Dim>& body, const Law& law, const ChunkRates<Dim>& rates, double dt, std::size_t p, int count) {
  const Law local = law;  // through the reference its constants would be read again for each packet (up to 8 % in 2D)
  int k = 0;
  for (; k + packet_width <= count; k += packet_width) update_point<Dim, Packet>(body, local, rates, dt, p + k, k);
  for (; k < count; ++k) update_point<Dim, double>(body, local, rates, dt, p + k, k);
}

}  // namespace geodrop
