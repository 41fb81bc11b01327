// Partly filled cells, and parts of cells beside a sharp interface, that would be too stiff for the step.
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
#include "node_vectors.hpp"
#include "part_groups.hpp"
#include "seams.hpp"

namespace geodrop {
namespace {

/// Largest S of a cell that keeps its stiffness: full cells together have 2 (2D) or 8/3 (3D) times the S of one of
/// them, so that 1 keeps them below 4. With 1/2 and 2 dam breaks ended alike.
constexpr double most_swing = 1;

/// What acts of the pressure and the rate of one with a larger S.
double share_at(double swing) { return std::sqrt(most_swing / swing); }

/// Masses that count as none in S: of a row of nodes around a row of cells.
template <int Dim>
WideRow<Dim> light_row(const Grid<Dim>& grid, int count, const std::array<int, Dim>& cell, int y, int z) {
  std::array<int, Dim> node = cell;
  node[1] += y - 1;
  if constexpr (Dim == 3) node[2] += z - 1;
  WideRow<Dim> light{};
  if (grid.layout.graded() || !far_from_walls<Dim>(grid.layout, count, cell)) {
    for (int k = 0; k < count + 2; ++k) {
      node[0] = cell[0] + k - 1;
      light[k] = light_mass<Dim>(grid, node);
    }
  } else {
    std::fill_n(light.begin(), count + 2, grid.light_mass);
  }
  return light;
}

double square(double x) { return x * x; }

/// 1 / mass that the force of cell pressures moves at a node, from 1 / mass of the fluid: in pores the force n acts on
/// the water and 1 - n on the grains [1/kg].
template <int Dim>
double lightness(const Grid<Dim>& grid, int node, double of_fluid) {
  if (grid.pore_share.empty()) return of_fluid;
  return square(grid.pore_share[node]) * of_fluid + grid.grain_lightness[node];
}

/// Whether a cell of the row could have S > 1, if all nodes around the row that its pressure moves were as light as the
/// lightest of them. Without graded cells, whose integrals have no bound so close, and without pores.
template <int Dim>
bool may_swing(const Grid<Dim>& grid, int begin, int count, const std::array<int, Dim>& cell, double dt) {
  if (grid.layout.graded() || !grid.pore_share.empty()) return true;
  const auto moved = [&](int axis, int at, int a) {
    return grid.integrals[axis].slope[at][a] != 0 || grid.integrals[axis].value[at][a] != 0;
  };
  const int first = moved(0, cell[0], 0) ? -1 : 0, last = moved(0, cell[0] + count - 1, 2) ? count : count - 1;
  double lightest = std::numeric_limits<double>::infinity();
  for_rows_around<Dim>(grid.layout, [&](int offset, int y, int z) {
    if (!moved(1, cell[1], y) || (Dim == 3 && !moved(Dim - 1, cell[Dim - 1], z))) return;
    const Vec4* const sum = grid.sum.data() + begin + offset;
    for (int k = first; k <= last; ++k) lightest = std::min(lightest, sum[k][3]);
  });
  double least = std::numeric_limits<double>::infinity();  // of volumes
  for (int flat = begin; flat < begin + count; ++flat)
    if (grid.cell_flags[flat] & cell_filled) least = std::min(least, grid.cell_volume[flat]);
  constexpr double most_square = 0.5 * Dim;  // of sum |int grad N|^2: 1/2 along an axis, at most 1 across
  const double stiffness = grid.largest_modulus * square(dt * face_measure(grid.layout));
  double least_light = grid.light_mass;
  for (int axis = 0; axis < Dim; ++axis) {
    const int lower = cell[axis] - 1, upper = cell[axis] + (axis == 0 ? count : 1), wall = GridLayout<Dim>::pad;
    const int other_wall = wall + grid.layout.cells[axis];
    if (lower <= wall || (lower <= other_wall && upper >= other_wall)) least_light *= 0.5;
  }
  return stiffness * most_square > most_swing * least * std::max(lightest, least_light);
}

}  // namespace

template <int Dim>
CellRow<Dim> cell_swing(const Grid<Dim>& grid, int begin, int count, const std::array<int, Dim>& cell, double dt) {
  // Sums of 1 / mass over y and z, to be multiplied with squares of slopes along x, and with those of values.
  WideRow<Dim> along{}, across{};
  const auto entry = [&](const auto& table, int axis, int a) { return square(table[cell[axis]][a]); };
  for_rows_around<Dim>(grid.layout, [&](int offset, int y, int z) {
    const Vec4* const sum = grid.sum.data() + begin + offset - 1;
    const double value_y = entry(grid.integrals[1].value, 1, y), slope_y = entry(grid.integrals[1].slope, 1, y);
    const double value_z = Dim == 3 ? entry(grid.integrals[Dim - 1].value, Dim - 1, z) : 1.0;
    const double slope_z = Dim == 3 ? entry(grid.integrals[Dim - 1].slope, Dim - 1, z) : 0.0;
    const WideRow<Dim> light = light_row<Dim>(grid, count, cell, y, z);
    const double with_slope = value_y * value_z, with_value = slope_y * value_z + value_y * slope_z;
    for (int k = 0; k < count + 2; ++k) {
      const double of_fluid = 1 / std::max(sum[k][3], light[k]);
      const double inverse = lightness(grid, begin + offset - 1 + k, of_fluid);
      along[k] += with_slope * inverse;
      across[k] += with_value * inverse;
    }
  });
  const auto* const value = grid.integrals[0].value.data() + cell[0];
  const auto* const slope = grid.integrals[0].slope.data() + cell[0];
  const double scale = square(dt * face_measure(grid.layout));
  CellRow<Dim> swing{};
  for (int k = 0; k < count; ++k) {
    for (int a = 0; a < 3; ++a) swing[k] += square(slope[k][a]) * along[k + a] + square(value[k][a]) * across[k + a];
    const double volume = grid.cell_volume[begin + k];
    const double modulus = grid.cell_modulus.empty() ? grid.largest_modulus : grid.cell_modulus[begin + k] / volume;
    swing[k] *= modulus * scale / volume;
  }
  return swing;
}

namespace {

template <int Dim>
double size_squared(const std::array<double, Dim>& slope) {
  double sum = 0;
  for (int a = 0; a < Dim; ++a) sum += square(slope[a]);
  return sum;
}

/// 1 / mass that the force of a part's pressure moves at a node [1/kg].
template <int Dim>
double lightness_at(const Grid<Dim>& grid, int node) {
  return lightness(grid, node, 1 / std::max(grid.sum[node][3], light_mass<Dim>(grid, stored_cell(grid.layout, node))));
}

/// sum |slope|^2 / mass of parts that share a pressure, were no node moved by two of them, times their number: no less
/// than what is true, and found without a list of nodes.
template <int Dim>
double most_moved(const Grid<Dim>& grid, auto first, auto last) {
  double sum = 0;
  for (auto part = first; part != last; ++part) {
    std::size_t n = 0;
    for_neighbourhood(grid.layout, part->flat, [&](int node, const auto&) {
      if (const double size = size_squared<Dim>(part->slope[n++]); size > 0) sum += size * lightness_at(grid, node);
    });
  }
  return static_cast<double>(last - first) * sum;
}

/// sum |slope|^2 / mass of parts that share a pressure.
template <int Dim>
double moved_by_parts(const Grid<Dim>& grid, auto first, auto last) {
  std::vector<NodeVector<Dim>> moved;
  for (auto part = first; part != last; ++part) {
    std::size_t n = 0;
    for_neighbourhood(grid.layout, part->flat, [&](int node, const auto&) {
      moved.push_back({node, part->slope[n++]});
    });
  }
  add_up_by_node(moved);
  double sum = 0;
  for (const auto& [node, slope] : moved) sum += size_squared<Dim>(slope) * lightness_at(grid, node);
  return sum;
}

}  // namespace

template <int Dim>
void soften_light_parts(Grid<Dim>& grid, double dt) {
  for_each_group(grid.part_cells, [&](auto first, auto last) {
    if (!carries_pressure(grid, first->host)) return;
    const double volume = sum_of_group(grid.cell_volume, first, last);
    const double modulus =
        grid.cell_modulus.empty() ? grid.largest_modulus : sum_of_group(grid.cell_modulus, first, last) / volume;
    const double stiffness = square(dt) * modulus / volume;
    if (!(stiffness * most_moved(grid, first, last) > most_swing)) return;
    const double swing = stiffness * moved_by_parts(grid, first, last);
    if (!(swing > most_swing)) return;
    for (auto part = first; part != last; ++part) {
      part->share = share_at(swing);
      grid.cell_pressure[part->flat] *= part->share;
    }
  });
}

template <int Dim>
void soften_light_cells(Grid<Dim>& grid, double dt) {
  Array<double>& share = grid.volume_rate;  // free until the volume rate is computed
  const auto acts = [&](int flat) { return carries_pressure(grid, flat); };
  for_each_active_real_row(grid, [&](int begin, int count, std::array<int, Dim> cell) {
    std::fill_n(share.begin() + begin, count, 1.0);
    while (count > 0 && !acts(begin + count - 1)) --count;
    for (; count > 0 && !acts(begin); ++begin, ++cell[0]) --count;
    if (count == 0 || !may_swing<Dim>(grid, begin, count, cell, dt)) return;
    const CellRow<Dim> swing = cell_swing<Dim>(grid, begin, count, cell, dt);
    for (int k = 0; k < count; ++k)
      if (acts(begin + k) && swing[k] > most_swing) share[begin + k] = share_at(swing[k]);
  });
  for (const auto& part : grid.part_cells) share[part.flat] = 1;  // theirs has joined the nodal force
  for_each_active_real_row(grid, [&](int begin, int count, const std::array<int, Dim>&) {
    for (int flat = begin; flat < begin + count; ++flat) grid.cell_pressure[flat] *= share[flat];
  });
  for_each_seam(grid.layout, [&](int axis) { copy_over_seam(grid.layout, axis, grid.cell_pressure); });
}

#define GEODROP_INSTANTIATE(D)                                                                    \
  template CellRow<D> cell_swing<D>(const Grid<D>&, int, int, const std::array<int, D>&, double); \
  template void soften_light_parts<D>(Grid<D>&, double);                                          \
  template void soften_light_cells<D>(Grid<D>&, double);
GEODROP_INSTANTIATE(2)
GEODROP_INSTANTIATE(3)
#undef GEODROP_INSTANTIATE

}  // namespace geodrop
