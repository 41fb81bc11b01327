// MUSL (Sulsky, Zhou & Schreyer 1995): particles take their new velocity from the grid, then the grid takes its
// velocity anew from them; positions and strains follow the second. Where a node is nearly empty the first nodal
// velocity may be anything, the second lies between those of the particles.
//
//   v_p = a (v_p + sum N (v' - v)) + (1 - a) sum N v',    v''_i = sum N m v_p / sum N m
#pragma once

#include "transfer/ranges.hpp"

namespace geodrop {

template <int Dim, class Basis, class Arithmetic>
void update_velocity_range(Body<Dim>& body, const Grid<Dim>& grid, const GatherOptions& options, std::size_t begin,
                           std::size_t end) {
  ChunkWeights<Dim, Basis> weights;
  const double keep = options.keep, damping = options.damping;
  for (std::size_t p = begin; p < end; p += chunk_size) {
    const int count = static_cast<int>(std::min<std::size_t>(chunk_size, end - p));
    compute_weights(grid.layout, pointers(body.x, p), body.half_size, count, weights);
    for (int k = 0; k < count; ++k) {
      const GatherSums<Dim> s = sums_of<Dim, Basis, Transfer::blend, Arithmetic>(grid, weights, k);
      for (int a = 0; a < Dim; ++a) {
        double& v = body.v[a][p + k];
        v = damping * (keep * (v + s.change[a]) + (1 - keep) * s.value[a]);
      }
    }
  }
}

/// Adds N m (u, 1): the vector u of each particle and, in lane 3, unit_mass.
template <int Dim, class Basis, class Arithmetic>
void sum_by_mass_range(const Body<Dim>& body, const ByMass<Dim>& what, const GridLayout<Dim>& layout, Vec4* sum,
                       std::size_t begin, std::size_t end) {
  ChunkWeights<Dim, Basis> weights;
  for (std::size_t p = begin; p < end; p += chunk_size) {
    const int count = static_cast<int>(std::min<std::size_t>(chunk_size, end - p));
    compute_weights(layout, pointers(body.x, p), body.half_size, count, weights);
    for (int k = 0; k < count; ++k) {
      const double m = body.mass[p + k];
      ScatterRecord<Dim> record{};
      for (int a = 0; a < Dim; ++a) record.value[a] = m * what.u[a][p + k];
      record.value[3] = m * what.unit_mass;
      add_particle<Dim, Basis, false, Arithmetic>(record, layout, weights, k, sum, nullptr);
    }
  }
}

}  // namespace geodrop
