// Keeps particles in memory in the order of their base cells, slab by slab, and tells which blocks they may touch.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

namespace geodrop {

/// Brings the particles into another order: the one at order[p] comes to p.
template <class P>
void permute(P& particles, const Array<std::uint32_t>& order) {
  std::tuple<Array<double>, Array<std::uint32_t>> scratch;
  for_each_array<particle_role::per_particle>(particles, [&]<class T>(Array<T>& values) {
    if (values.empty()) return;
    auto& sorted = std::get<Array<T>>(scratch);
    sorted.resize(values.size());
    const auto n = static_cast<std::ptrdiff_t>(order.size());
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t p = 0; p < n; ++p) sorted[p] = values[order[p]];
    values.swap(sorted);
  });
}

/// Stable counting sort of every body by (slab, base cell) if particles may have left the cell in which the last sort
/// found them, i.e. if the accumulated drift reached one cell; otherwise does nothing. Also renews the active blocks.
/// Throws RunError naming body and particle if a particle is not a finite point of the domain, or its volume ratio not
/// above 0.
template <int Dim>
void sort_particles_if_due(State<Dim>& state, Grids<Dim>& grids);

/// Largest drift since the sort that the colouring and the active blocks allow, in (finest) cells.
inline constexpr double allowed_drift_cells = 0.99;

}  // namespace geodrop
