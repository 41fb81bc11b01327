// Partly filled cells that would be too stiff for the step.
//
// The volume of one cell alone swings with (dt w)^2 = S = dt^2 K / V_c sum_i |int_c grad N_i|^2 / m_i, the m_i not
// below the mass of small-mass nodes, and grows without bound beyond S = 4. A full cell of water at a Courant number of
// 0.5 has 0.125 in 2D and 0.094 in 3D, and all full cells together 0.25, since they share their nodes. A cell with one
// particle between overfull ones, on nodes of a hundredth of a full mass, has up to 7.
#include "cell_pressure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "momentum.hpp"
#include "neighbourhood.hpp"
#include "seams.hpp"

namespace geodrop {
namespace {

/// Largest S of a cell that keeps its stiffness: full cells together have 2 (2D) or 8/3 (3D) times the S of one of
/// them, so that 1 keeps them below 4. With 1/2 and 2 dam breaks ended alike.
constexpr double most_swing = 1;

/// Integrals over cells from tables, whose unit of length is h.
template <int Dim>
double face_measure(const GridLayout<Dim>& layout) {
  return Dim == 2 ? layout.h : layout.h * layout.h;
}

/// Of a node, for the force of cell pressures [kg]. None counts as little: round-off decides between the two. In pores
/// the force n acts on the water and 1 - n on the soil.
template <int Dim>
double inertia(const Grid<Dim>& grid, int node, double light) {
  const double mass = std::max(grid.sum[node][3], light);
  if (grid.pore_share.empty()) return mass;
  const double n = grid.pore_share[node];
  return 1 / (n * n / mass + grid.grain_lightness[node]);
}

/// Whether a cell of an even grid could swing too wide: it cannot if it would not with all nodes as light as the
/// lightest.
template <int Dim>
bool may_swing(const Grid<Dim>& grid, int flat, double stiffness) {
  if (grid.layout.graded()) return true;
  constexpr double most_square = 0.5 * Dim;  // of sum |int grad N|^2: 1/2 along an axis, at most 1 across
  double lightest = std::numeric_limits<double>::infinity();
  for_rows_around<Dim>(grid.layout, [&](int offset, int, int) {
    for (int x = -1; x <= 1; ++x) lightest = std::min(lightest, inertia(grid, flat + offset + x, grid.light_mass));
  });
  return stiffness * most_square > most_swing * grid.cell_volume[flat] * lightest;
}

/// |int grad N|^2 of the node at offset a - 1 from a cell, h = 1.
template <int Dim>
double square_of_slope(const Grid<Dim>& grid, const std::array<int, Dim>& cell, const std::array<int, Dim>& a) {
  double square = 0;
  for (int component = 0; component < Dim; ++component) {
    double integral = 1;
    for (int axis = 0; axis < Dim; ++axis) {
      const auto& table = grid.integrals[axis];
      integral *= axis == component ? table.slope[cell[axis]][a[axis]] : table.value[cell[axis]][a[axis]];
    }
    square += integral * integral;
  }
  return square;
}

}  // namespace

template <int Dim>
double cell_swing(const Grid<Dim>& grid, const std::array<int, Dim>& cell, int flat, double dt) {
  double sum = 0;
  for_neighbourhood(grid.layout, flat, [&](int node, const std::array<int, Dim>& a) {
    std::array<int, Dim> at = cell;
    for (int axis = 0; axis < Dim; ++axis) at[axis] += a[axis] - 1;
    sum += square_of_slope<Dim>(grid, cell, a) / inertia(grid, node, light_mass<Dim>(grid, at));
  });
  const double volume = grid.cell_volume[flat];
  const double modulus = grid.cell_modulus.empty() ? grid.largest_modulus : grid.cell_modulus[flat] / volume;
  return modulus * std::pow(dt * face_measure(grid.layout), 2) * sum / volume;
}

template <int Dim>
void soften_light_cells(Grid<Dim>& grid, double dt) {
  const double stiffness = grid.largest_modulus * std::pow(dt * face_measure(grid.layout), 2);
  Array<double>& share = grid.volume_rate;  // free until the volume rate is computed
  for_each_active_real_row(grid, [&](int begin, int count, std::array<int, Dim> cell) {
    for (int flat = begin; flat < begin + count; ++flat, ++cell[0]) {
      share[flat] = 1;
      const bool acts = (grid.cell_flags[flat] & cell_filled) && grid.cell_volume[flat] > 0;
      if (!acts || !may_swing(grid, flat, stiffness)) continue;
      share[flat] = std::sqrt(std::min(1.0, most_swing / cell_swing<Dim>(grid, cell, flat, dt)));
    }
  });
  for (const PartCell& part : grid.part_cells) share[part.flat] = 1;  // theirs has joined the nodal force
  for_each_active_real_row(grid, [&](int begin, int count, const std::array<int, Dim>&) {
    for (int flat = begin; flat < begin + count; ++flat) grid.cell_pressure[flat] *= share[flat];
  });
  for_each_seam(grid.layout, [&](int axis) { copy_over_seam(grid.layout, axis, grid.cell_pressure); });
}

#define GEODROP_INSTANTIATE(D)                                                           \
  template double cell_swing<D>(const Grid<D>&, const std::array<int, D>&, int, double); \
  template void soften_light_cells<D>(Grid<D>&, double);
GEODROP_INSTANTIATE(2)
GEODROP_INSTANTIATE(3)
#undef GEODROP_INSTANTIATE

}  // namespace geodrop
