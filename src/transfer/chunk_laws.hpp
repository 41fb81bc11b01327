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

/// Arrays of a body that together take more than this [byte] have left the cache when the next stage comes: the share
/// of one core in a last cache of 32 MB for eight. Prefetched and streamed they cost 6 to 12 % more at 1.6 to 3.2 MB
/// (water in 2D), 9 to 12 % less at 4.8 MB, 20 % less at 8 to 18 MB (soil, water in 3D); soil in 2D gains 5 % at 2.4
/// MB.
inline constexpr std::size_t cached_bytes = 4 << 20;

/// Whether the arrays that scatter and gather pass through leave the cache in between.
template <int Dim>
bool leaves_cache(const Body<Dim>& body) {
  std::size_t numbers = 0;
  for_each_array<particle_role::scattered | particle_role::gathered>(
      body, [&](const Array<double>& values) { numbers += values.size(); });
  return numbers * sizeof(double) > cached_bytes;
}

/// Particle data that a kernel wants next, asked for while it works on the chunk before: two dozen arrays are more
/// than the processor foresees by itself (8 to 14 % of a step with 1e6 particles; into the second-level cache only,
/// half of that). Bodies that stay in a cache do without (it cost them 2 to 4 %).
template <int Dim>
class NextChunk {
 public:
  explicit NextChunk(const Body<Dim>& body) : from_memory_(leaves_cache(body)) {}

  bool from_memory() const { return from_memory_; }
  void add(const Array<double>& field) {
    if (from_memory_ && !field.empty()) fields_[count_++] = field.data();
  }

  /// Asks for the share of particle k of the chunk at p: all of them ask for all lines of the next chunk. Addresses
  /// past the end do no harm.
  void fetch(std::size_t p, int k) const {
    constexpr int line = 64 / sizeof(double), lines = chunk_size / line;
    const std::size_t at = p + chunk_size + k % lines * line;
    for (int f = k / lines; f < count_; f += chunk_size / lines) __builtin_prefetch(fields_[f] + at);
  }

 private:
  bool from_memory_;
  int count_ = 0;
  std::array<const double*, count_arrays<particle_role::scattered | particle_role::gathered>(particle_fields<Dim>)>
      fields_;
};

/// What scatter, or gather, wants: the fields of this role.
template <unsigned role, int Dim>
NextChunk<Dim> next_to(const Body<Dim>& body) {
  NextChunk<Dim> next(body);
  for_each_array<role>(body, [&](const Array<double>& values) { next.add(values); });
  return next;
}

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
