// Which pressure cells are filled, and their pressure.
#include "cell_pressure.hpp"

#include "neighbourhood.hpp"
#include "seams.hpp"

#include <atomic>

namespace geodrop {
namespace {

template <int Dim>
double cell_width_product(const Grid<Dim>& grid, const std::array<int, Dim>& cell) {
  double product = 1;
  for (int a = 0; a < Dim; ++a) product *= grid.integrals[a].width[cell[a]];
  return product;
}

template <int Dim>
double cell_measure(const GridLayout<Dim>& layout) {
  return Dim == 2 ? layout.h * layout.h : layout.h * layout.h * layout.h;
}

/// cell_fill := V / V_c, not yet smoothed; what bodies across a sharp interface and rigid bodies have of a cell
/// counts as full.
template <int Dim>
void raw_fill(Grid<Dim>& grid, Array<double>& fill) {
  const double inv_measure = 1 / cell_measure(grid.layout);
  for_each_active_real_row(grid, [&](int begin, int count, std::array<int, Dim> cell) {
    for (int k = 0; k < count; ++k, ++cell[0])
      fill[begin + k] = (grid.cell_volume[begin + k] + (grid.occupied.empty() ? 0.0 : grid.occupied[begin + k])) *
                        inv_measure / cell_width_product<Dim>(grid, cell);
    for (const Array<double>* share : {&grid.taken, &grid.rigid_cells})
      if (!share->empty())
        for (int k = begin; k < begin + count; ++k) fill[k] += (*share)[k];
  });
}

/// Binomially smoothed fill ratio of cells along x.
template <int Dim>
std::array<double, GridLayout<Dim>::block_width[0]> smoothed_fill(const GridLayout<Dim>& layout,
                                                                  const Array<double>& fill, int begin, int count,
                                                                  std::array<int, Dim> cell) {
  std::array<double, GridLayout<Dim>::block_width[0]> smooth{};
  if (!far_from_walls<Dim>(layout, count, cell)) {
    for (int k = 0; k < count; ++k, ++cell[0])
      smooth[k] = binomial_mean<Dim>(layout, cell, [&fill](int flat) { return fill[flat]; });
    return smooth;
  }
  for_rows_around<Dim>(layout, [&](int offset, int y, int z) {
    const double weight = binomial[y] * (Dim == 3 ? binomial[z] : 1.0);
    const double* const row = fill.data() + begin + offset;
    for (int k = 0; k < count; ++k)
      smooth[k] += weight * (binomial[0] * (row[k - 1] + row[k + 1]) + binomial[1] * row[k]);
  });
  return smooth;
}

/// Cells near a membrane do not shift: a shifted particle could slip through it. A sharp one keeps sides.
template <int Dim>
void block_shift_near_membranes(const State<Dim>& state, Grid<Dim>& grid) {
  for (const Membrane<Dim>& membrane : state.membranes) {
    if (membrane.sharp) continue;
    for (std::size_t k = 0; k < membrane.nodes(); ++k)
      for_neighbourhood(grid.layout, cell_at(grid.layout, membrane.x, k), [&](int other, const auto&) {
        grid.cell_flags[other] &= static_cast<std::uint8_t>(~cell_shiftable);
      });
  }
}

/// Whether particles and a rigid body fill a cell together.
template <int Dim>
bool filled_with_rigid(const Grid<Dim>& grid, int flat) {
  if (grid.rigid_cells.empty() || grid.rigid_cells[flat] == 0) return false;
  const double whole = cell_measure(grid.layout) * cell_width_product<Dim>(grid, stored_cell(grid.layout, flat));
  return grid.cell_volume[flat] >= (filled_ratio - grid.rigid_cells[flat]) * whole;
}

/// A cell is shiftable where its whole neighbourhood is filled, by rigid bodies too.
template <int Dim>
void mark_shiftable(const State<Dim>& state, Grid<Dim>& grid) {
  // Neighbours in other blocks read the filled bit while this thread, the only one that writes the byte, sets the
  // shiftable bit.
  constexpr auto relaxed = std::memory_order_relaxed;
  std::uint8_t* const flags = grid.cell_flags.data();
  const auto filled = [&grid, flags](int cell) {
    return (std::atomic_ref(flags[cell]).load(relaxed) & cell_filled) != 0 || filled_with_rigid(grid, cell);
  };
  for_each_active_real_row(grid, [&](int begin, int count, const std::array<int, Dim>& cell) {
    const auto full = all_around<Dim>(grid.layout, begin, count, cell, filled);
    for (int k = 0; k < count; ++k)
      if (full[k]) {
        const std::atomic_ref flag(flags[begin + k]);
        flag.store(static_cast<std::uint8_t>(flag.load(relaxed) | cell_shiftable), relaxed);
      }
  });
  block_shift_near_membranes(state, grid);
}

}  // namespace

template <int Dim>
void average_cell_pressure(const State<Dim>& state, Grid<Dim>& grid, bool shift) {
  for_each_seam(grid.layout, [&](int axis) {
    sum_over_seam(grid.layout, axis, grid.cell_volume);
    sum_over_seam(grid.layout, axis, grid.cell_pressure);
    if (!grid.cell_modulus.empty()) sum_over_seam(grid.layout, axis, grid.cell_modulus);
    if (!grid.pore_modulus.empty()) sum_over_seam(grid.layout, axis, grid.pore_modulus);
    if (!grid.pore_volume.empty()) sum_over_seam(grid.layout, axis, grid.pore_volume);
  });
  Array<double>& fill = grid.volume_rate;  // free until the volume rate is computed
  raw_fill(grid, fill);
  for_each_active_real_row(grid, [&](int begin, int count, const std::array<int, Dim>& cell) {
    const auto smooth = smoothed_fill<Dim>(grid.layout, fill, begin, count, cell);
    for (int k = 0; k < count; ++k) {
      const int flat = begin + k;
      const bool holds = grid.cell_volume[flat] > 0, shared = !grid.taken.empty() && grid.taken[flat] > 0;
      const bool enough = smooth[k] >= filled_ratio || (!grid.pore_modulus.empty() && grid.pore_modulus[flat] > 0);
      const bool filled = enough && (holds || shared);
      grid.cell_flags[flat] = filled ? cell_filled : 0;
      grid.cell_pressure[flat] = filled && holds ? grid.cell_pressure[flat] / grid.cell_volume[flat] : 0.0;
    }
  });
  if (shift) mark_shiftable(state, grid);
  for_each_seam(grid.layout, [&](int axis) {
    copy_over_seam(grid.layout, axis, grid.cell_pressure);
    copy_over_seam(grid.layout, axis, grid.cell_flags);
  });
}

template void average_cell_pressure<2>(const State<2>&, Grid<2>&, bool);
template void average_cell_pressure<3>(const State<3>&, Grid<3>&, bool);

}  // namespace geodrop
