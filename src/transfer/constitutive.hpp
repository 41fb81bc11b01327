// The material laws at work on chunks of particles: what a chunk carries to the grid, and what the grid's rates do to
// it. Compiled once per dimension (constitutive_2d.cpp, _3d.cpp), whatever the basis and the transfer.
#pragma once

#include "chunk_laws.hpp"
#include "materials/laws.hpp"

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
  if (water.has_gas())
    for (int k = 0; k < count; ++k) pressure[k] = fluid_pressure(water, J[k], body.gas[begin + k]);
  if (water.has_still_level())
    for (int k = 0; k < count; ++k) pressure[k] += water.of_weight(body.x[Dim - 1][begin + k]);
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

/// The pressure is the mean over soil and voids, which bear nothing.
template <int Dim>
void volumes_and_pressures(const Body<Dim>& body, const MohrCoulombWithVoids& soil, std::size_t begin, int count,
                           double* volume, double* pressure) {
  volumes_and_pressures(body, static_cast<const MohrCoulomb&>(soil), begin, count, volume, pressure);
  if (!soil.bears_while_open()) return;
  for (int k = 0; k < count; ++k) {
    const std::size_t p = begin + k;
    pressure[k] += void_share(soil, body.gap[p]) * (body.stress[0][p] + body.stress[1][p] + body.stress[2][p]) / 3;
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
  if (water.has_gas())
    for (int k = 0; k < count; ++k)
      pressure_force[k] = own[k] * out.volume[k] * fluid_pressure(water, J[k], body.gas[begin + k]);
  if (water.has_still_level())
    for (int k = 0; k < count; ++k)
      pressure_force[k] += own[k] * out.volume[k] * water.of_weight(body.x[Dim - 1][begin + k]);
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

/// Voids bear nothing.
template <int Dim>
void carried_stress(const Body<Dim>& body, const MohrCoulombWithVoids& soil, std::size_t begin, int count,
                    const double* own, ChunkStress<Dim>& out) {
  carried_stress(body, static_cast<const MohrCoulomb&>(soil), begin, count, own, out);
  if (!soil.bears_while_open()) return;
  for (int k = 0; k < count; ++k) {
    const std::size_t p = begin + k;
    const double removed = (1 - own[k]) * (body.stress[0][p] + body.stress[1][p] + body.stress[2][p]) / 3;
    const double voids = out.volume[k] * void_share(soil, body.gap[p]);
    for (const int c : acting_components<Dim>) out.s[c][k] += voids * (body.stress[c][p] - (c < 3 ? removed : 0.0));
  }
}

template <int Dim, class Law>
void update_chunk(Body<Dim>& body, const Law& law, const ChunkRates<Dim>& rates, double dt, std::size_t p, int count) {
  const Law local = law;  // through the reference its constants would be read again for each packet (up to 8 % in 2D)
  int k = 0;
  for (; k + packet_width <= count; k += packet_width) update_point<Dim, Packet>(body, local, rates, dt, p + k, k);
  for (; k < count; ++k) update_point<Dim, double>(body, local, rates, dt, p + k, k);
}

}  // namespace geodrop
