#include "sort_particles.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <geodrop/base/error.hpp>
#include <numeric>

#include "blocks.hpp"

namespace geodrop {
namespace {

/// `what` ends with an open bracket in which the place goes.
template <int Dim>
[[noreturn]] void throw_lost(const State<Dim>& state, const Body<Dim>& body, std::size_t p, const std::string& what,
                             const std::string& hint) {
  std::string place;
  for (int a = 0; a < Dim; ++a) place += fmt::format(" {:g}", body.x[a][p]);
  throw RunError(fmt::format("stage sort_particles: body '{}', particle id {} {}x ={}) at t = {:g} s, step {}{}",
                             body.name, body.id[p], what, place, state.t, state.step, hint));
}

template <int Dim>
[[noreturn]] void throw_outside(const State<Dim>& state, const Body<Dim>& body, std::size_t p) {
  throw_lost(state, body, p, "left the domain or is not finite (",
             "; a smaller solver.courant often helps, see the last frame");
}

template <int Dim>
[[noreturn]] void throw_crushed(const State<Dim>& state, const Body<Dim>& body, std::size_t p) {
  throw_lost(state, body, p, fmt::format("has no volume left (J = {:g}, ", body.J[p]),
             ": it was squeezed to nothing or turned inside out; see the last frame");
}

/// Number of base cells along each axis when every slab is complete: keys are dense in (slab, cell of slab).
template <int Dim>
struct KeySpace {
  std::array<int, Dim> extent;  ///< cells of a slab per axis
  int cells_per_slab = 1;

  explicit KeySpace(const GridLayout<Dim>& layout) {
    for (int a = 0; a < Dim; ++a) {
      extent[a] = a == 0 ? layout.cells[0] + 1 : slab_width<Dim>;
      cells_per_slab *= extent[a];
    }
  }

  std::uint32_t key(const GridLayout<Dim>& layout, const std::array<int, Dim>& base) const {
    int slab = 0, cell = 0;
    for (int a = Dim - 1; a >= 1; --a) {
      slab = slab * layout.slabs[a] + base[a] / slab_width<Dim>;
      cell = cell * extent[a] + base[a] % slab_width<Dim>;
    }
    cell = cell * extent[0] + base[0];
    return static_cast<std::uint32_t>(slab * cells_per_slab + cell);
  }
};

template <int Dim>
void find_keys(const State<Dim>& state, const Body<Dim>& body, const GridLayout<Dim>& layout,
               const KeySpace<Dim>& space, Array<std::uint32_t>& keys) {
  const auto n = static_cast<std::ptrdiff_t>(body.size());
  keys.resize(body.size());
  std::ptrdiff_t bad = n, crushed = n;
#pragma omp parallel for schedule(static) reduction(min : bad, crushed)
  for (std::ptrdiff_t p = 0; p < n; ++p) {
    std::array<int, Dim> base;
    bool inside = true;
    for (int a = 0; a < Dim; ++a) {
      const double x = body.x[a][p];
      inside = inside && x >= layout.lower[a] && x <= layout.upper[a];
      base[a] = inside ? layout.base(a, x) : 0;
    }
    if (!inside) bad = std::min(bad, p);
    if (!(body.J[p] > 0)) crushed = std::min(crushed, p);
    keys[p] = space.key(layout, base);
  }
  if (crushed != n) throw_crushed(state, body, static_cast<std::size_t>(crushed));
  if (bad != n) throw_outside(state, body, static_cast<std::size_t>(bad));
}

/// Particles beyond a periodic wall come in at the other one.
template <int Dim>
void wrap_particles(Body<Dim>& body, const GridLayout<Dim>& layout) {
  for (int a = 0; a < Dim; ++a) {
    if (!layout.periodic(a)) continue;
    const auto n = static_cast<std::ptrdiff_t>(body.size());
    double* const x = body.x[a].data();
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t p = 0; p < n; ++p)
      if (x[p] < layout.lower[a] || x[p] > layout.upper[a]) x[p] = layout.wrapped(a, x[p]);
  }
}

/// Renumbers the keys so that empty slabs have none, in the same order: counting over all cells of a large, mostly
/// empty domain would cost more than the rest of the step. Returns how many slabs are left; `rank` counts them up to
/// each slab.
std::uint32_t drop_empty_slabs(std::uint32_t cells_per_slab, Array<std::uint32_t>& keys, Array<std::uint32_t>& rank) {
  const auto n = static_cast<std::ptrdiff_t>(keys.size());
  for (const std::uint32_t key : keys) rank[key / cells_per_slab + 1] = 1;
  std::partial_sum(rank.begin(), rank.end(), rank.begin());
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t p = 0; p < n; ++p) {
    const std::uint32_t slab = keys[p] / cells_per_slab;
    keys[p] -= (slab - rank[slab]) * cells_per_slab;
  }
  return rank.back();
}

template <int Dim>
void sort_body(const State<Dim>& state, Body<Dim>& body, const GridLayout<Dim>& layout) {
  wrap_particles(body, layout);
  const KeySpace<Dim> space(layout);
  const int slabs = layout.slab_count();
  Array<std::uint32_t> keys;
  find_keys(state, body, layout, space, keys);

  Array<std::uint32_t> rank(slabs + 1, 0);
  const std::uint32_t full_slabs = drop_empty_slabs(space.cells_per_slab, keys, rank);

  Array<std::uint32_t> begin(static_cast<std::size_t>(full_slabs) * space.cells_per_slab + 1, 0);
  for (const std::uint32_t key : keys) ++begin[key + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  body.slab_begin.resize(slabs + 1);
  for (int s = 0; s <= slabs; ++s) body.slab_begin[s] = begin[static_cast<std::size_t>(rank[s]) * space.cells_per_slab];

  if (std::is_sorted(keys.begin(), keys.end())) return;
  Array<std::uint32_t> order(body.size());
  for (std::size_t p = 0; p < keys.size(); ++p) order[begin[keys[p]]++] = static_cast<std::uint32_t>(p);
  permute(body, order);
}

/// Marks the blocks of all nodes that a particle can touch until the next sort: its base cell, one cell of drift,
/// one node of support. `x` need not be sorted.
template <int Dim>
void mark_blocks(const std::array<Array<double>, Dim>& x, const GridLayout<Dim>& layout,
                 std::vector<std::uint8_t>& marks) {
  constexpr int reach = 2;
  const std::size_t n = x[0].size();
  int last = -1;
  for (std::size_t p = 0; p < n; ++p) {
    std::array<int, Dim> base;
    for (int a = 0; a < Dim; ++a) base[a] = layout.base(a, x[a][p]);
    if (const int flat = layout.index(base); flat == last)
      continue;
    else
      last = flat;
    for (int corner = 0; corner < (1 << Dim); ++corner) {
      int block = 0;
      for (int a = Dim - 1; a >= 0; --a) {
        const int node = base[a] + GridLayout<Dim>::pad + ((corner >> a & 1) ? reach : -reach);
        block = block * layout.blocks[a] + node / GridLayout<Dim>::block_width[a];
      }
      marks[block] = 1;
    }
  }
}

/// Both sides of a periodic seam are one place: blocks there are active together.
template <int Dim>
void mark_across_seams(const GridLayout<Dim>& layout, std::vector<std::uint8_t>& marks) {
  for (int a = 0, stride = 1; a < Dim; stride *= layout.blocks[a], ++a) {
    if (!layout.periodic(a)) continue;
    for (int node = 0; node <= 2 * GridLayout<Dim>::pad; ++node) {
      const int low = node / GridLayout<Dim>::block_width[a];
      const int high = (node + layout.cells[a]) / GridLayout<Dim>::block_width[a];
      for (int block = 0; block < layout.block_count(); ++block) {
        if (block / stride % layout.blocks[a] != low) continue;
        const int image = block + (high - low) * stride;
        marks[block] = marks[image] = marks[block] | marks[image];
      }
    }
  }
}

/// Zeroes fields in a block that goes to sleep: neighbours may still read it.
template <int Dim>
void clear_block(Grid<Dim>& grid, std::uint32_t block) {
  for_each_row_of_block(grid.layout, block, [&](int begin, int count, const auto&) {
    zero_row<grid_role::zero_asleep>(grid, begin, count);
  });
}

/// A line that leaves the domain has no blocks to mark.
template <int Dim>
void require_inside(const State<Dim>& state, const std::string& name, const std::array<Array<double>, Dim>& x,
                    const GridLayout<Dim>& layout) {
  for (int a = 0; a < Dim; ++a)
    for (const double at : x[a]) {
      if (at >= layout.particle_lower[a] && at <= layout.particle_upper[a]) continue;
      throw RunError(fmt::format(
          "a node of '{}' left the domain or is not finite at t = {:g} s, step {}; a smaller solver.courant often "
          "helps, see the last frame",
          name, state.t, state.step));
    }
}

template <int Dim>
void renew_active_blocks(const State<Dim>& state, Grid<Dim>& grid) {
  std::vector<std::uint8_t> marks(grid.layout.block_count(), 0);
  for (const Membrane<Dim>& membrane : state.membranes)
    require_inside<Dim>(state, membrane.name, membrane.x, grid.layout);
  for (const ViscousBoundary<Dim>& boundary : state.viscous_boundaries)
    require_inside<Dim>(state, boundary.name, boundary.x, grid.layout);
  for (const Body<Dim>& body : state.bodies)
    if (body.field == grid.field) mark_blocks<Dim>(body.x, grid.layout, marks);
  for (const Membrane<Dim>& membrane : state.membranes)
    if (membrane.field == grid.field) mark_blocks<Dim>(membrane.x, grid.layout, marks);
  for (const ViscousBoundary<Dim>& boundary : state.viscous_boundaries)
    if (boundary.field == grid.field) mark_blocks<Dim>(boundary.x, grid.layout, marks);
  mark_across_seams(grid.layout, marks);
  for (const std::uint32_t block : grid.active_blocks)
    if (!marks[block]) clear_block(grid, block);
  grid.active_blocks.clear();
  for (std::size_t b = 0; b < marks.size(); ++b)
    if (marks[b]) grid.active_blocks.push_back(static_cast<std::uint32_t>(b));
}

}  // namespace

template <int Dim>
void sort_particles_if_due(State<Dim>& state, Grids<Dim>& grids) {
  const GridLayout<Dim>& layout = grids.front().layout;
  const bool due = state.drift < 0 || state.drift >= allowed_drift_cells * layout.finest;
  const bool resumed = !due && grids.front().active_blocks.empty();
  if (!due && !resumed) return;
  if (due) {
    for (Body<Dim>& body : state.bodies) sort_body(state, body, layout);
    state.drift = 0;
  }
  for (Grid<Dim>& grid : grids) renew_active_blocks(state, grid);
}

template void sort_particles_if_due<2>(State<2>&, Grids<2>&);
template void sort_particles_if_due<3>(State<3>&, Grids<3>&);

}  // namespace geodrop
