// Loops over the particles that add to the grid, slab by slab, without two threads at one node.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

#include <vector>

namespace geodrop {

/// Fewer particles than this are not worth waking threads for.
inline constexpr std::size_t particles_worth_threads = 2048;

template <int Dim>
bool holds_particles(const State<Dim>& state, const Grid<Dim>& grid, int slab) {
  for (const Body<Dim>& body : state.bodies)
    if (body.field == grid.field && body.slab_begin[slab] < body.slab_begin[slab + 1]) return true;
  return false;
}

/// Slabs of one colour that hold particles, ascending: the empty ones of a large domain are not shared out to threads.
template <int Dim>
std::vector<int> slabs_of_colour(const State<Dim>& state, const Grid<Dim>& grid, int colour) {
  const GridLayout<Dim>& layout = grid.layout;
  std::vector<int> out;
  const int z_slabs = Dim == 3 ? layout.slabs[Dim - 1] : 1;
  for (int z = colour / 2; z < z_slabs; z += 2)
    for (int y = colour % 2; y < layout.slabs[1]; y += 2)
      if (const int slab = y + z * layout.slabs[1]; holds_particles(state, grid, slab)) out.push_back(slab);
  return out;
}

/// f(body, begin, end) for the particles of every body of the grid's velocity field, slab by slab. Slabs of one colour
/// run in parallel, colours in order, so each node receives its contributions in the same order whatever the number of
/// threads.
template <int Dim, class F>
void for_each_slab_by_colour(const State<Dim>& state, const Grid<Dim>& grid, F&& f) {
  const bool threads = state.particles() >= particles_worth_threads;
  for (int colour = 0; colour < slab_colours<Dim>; ++colour) {
    const std::vector<int> slabs = slabs_of_colour(state, grid, colour);
    const auto n = static_cast<std::ptrdiff_t>(slabs.size());
#pragma omp parallel for schedule(dynamic, 1) if (threads)
    for (std::ptrdiff_t s = 0; s < n; ++s)
      for (const Body<Dim>& body : state.bodies) {
        if (body.field != grid.field) continue;
        const std::size_t begin = body.slab_begin[slabs[s]], end = body.slab_begin[slabs[s] + 1];
        if (begin < end) f(body, begin, end);
      }
  }
}

}  // namespace geodrop
