// MUSL (Sulsky, Zhou & Schreyer 1995): particles take their new velocity from the grid, then the grid takes its
// velocity anew from them; positions and strains follow the second. Where a node is nearly empty the first nodal
// velocity may be anything, the second lies between those of the particles.
//
//   v_p = a (v_p + sum N (v' - v)) + (1 - a) sum N v',    v''_i = sum N m v_p / sum N m
#pragma once

#include "ranges.hpp"

namespace geodrop {

template <int Dim, class Basis>
void update_velocity_range(Body<Dim>& body, const Grid<Dim>& grid, const GatherOptions& options, std::size_t begin,
                           std::size_t end) {
  ChunkWeights<Dim, Basis> weights;
  const double keep = options.keep, damping = options.damping;
  for (std::size_t p = begin; p < end; p += chunk_size) {
    const int count = static_cast<int>(std::min<std::size_t>(chunk_size, end - p));
    compute_weights(grid.layout, positions(body, p), body.half_size, count, weights);
    for (int k = 0; k < count; ++k) {
      const GatherSums<Dim> s = sums_of<Dim, Basis, Transfer::blend>(grid, weights, k);
      for (int a = 0; a < Dim; ++a) {
        double& v = body.v[a][p + k];
        v = damping * (keep * (v + s.change[a]) + (1 - keep) * s.value[a]);
      }
    }
  }
}

/// Adds N m v and N m.
template <int Dim, class Basis>
void sum_momentum_range(const Body<Dim>& body, Grid<Dim>& grid, std::size_t begin, std::size_t end) {
  ChunkWeights<Dim, Basis> weights;
  for (std::size_t p = begin; p < end; p += chunk_size) {
    const int count = static_cast<int>(std::min<std::size_t>(chunk_size, end - p));
    compute_weights(grid.layout, positions(body, p), body.half_size, count, weights);
    for (int k = 0; k < count; ++k) {
      const double m = body.mass[p + k];
      Vec4 momentum{};
      for (int a = 0; a < Dim; ++a) momentum[a] = m * body.v[a][p + k];
      momentum[3] = m;
      ScatterRecord<Dim> record{};
      record.value = momentum;
      add_particle<Dim, Basis, false>(record, grid, weights, k);
    }
  }
}

}  // namespace geodrop
