// What the transfers and the material laws hand to each other, chunk by chunk.
#pragma once

#include "chunk.hpp"

namespace geodrop {

/// Negative volume times the stress that particles of a chunk carry to the grid [N m], components as in types.hpp.
template <int Dim>
struct ChunkStress {
  alignas(64) double s[stress_components<Dim>][chunk_size];
  alignas(64) double volume[chunk_size];  ///< [m3]
};

/// Components that act on the grid: in plane strain ZZ does not.
template <int Dim>
inline constexpr std::array<int, stress_components<Dim> - (Dim == 2)> acting_components = [] {
  if constexpr (Dim == 2)
    return std::array<int, 3>{0, 1, 3};
  else
    return std::array<int, 6>{0, 1, 2, 3, 4, 5};
}();

/// What the transfer of a chunk hands to the motion and to the material law.
template <int Dim>
struct ChunkRates {
  alignas(64) double increment[Dim * Dim][chunk_size];  ///< dt L, row-major [-]
  alignas(64) double volume[chunk_size];                ///< dt D [-]
  alignas(64) double velocity[Dim][chunk_size];         ///< sum N v' [m/s]
  alignas(64) double change[Dim][chunk_size];           ///< sum N (v' - v) [m/s]; only for Transfer::blend
  alignas(
      64) double fill_slope[Dim][chunk_size];  ///< gradient of the fill ratio [1/m]; 0 where particles must not shift
};

/// Volume [m3] and pressure [Pa] of particles [begin, begin + count).
template <int Dim>
void chunk_volumes(const Body<Dim>& body, std::size_t begin, int count, double* volume, double* pressure);

/// What particles [begin, begin + count) carry to the grid; `own` is 1 where a particle's own mean stress acts, else 0.
template <int Dim>
void carry_stress(const Body<Dim>& body, std::size_t begin, int count, const double* own, ChunkStress<Dim>& out);

/// Updates volume and stress of particles [begin, begin + count).
template <int Dim>
void strain_chunk(Body<Dim>& body, const ChunkRates<Dim>& rates, double dt, std::size_t begin, int count);

}  // namespace geodrop
