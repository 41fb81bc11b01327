// Slopes of whole cells as an operator: from vectors at nodes to cells, and back.
#pragma once

#include <geodrop/grid/grid.hpp>

#include <array>
#include <utility>

#include "cell_pressure.hpp"
#include "neighbourhood.hpp"
#include "node_vectors.hpp"

namespace geodrop {

/// Cells or nodes that stand in a row of a block.
template <int Dim>
struct RowAt {
  int begin, count;            ///< flat indices
  std::array<int, Dim> first;  ///< stored coordinates
};

/// Integrals over cells along each axis, from the tables of a grid.
template <int Dim>
struct GridIntegrals {
  const Grid<Dim>& grid;

  double value(int axis, int a, int cell) const { return grid.integrals[axis].value[cell][a]; }
  double slope(int axis, int a, int cell) const { return grid.integrals[axis].slope[cell][a]; }
};

/// The same, entry by entry, which vectors of cells read faster, or their squares.
template <int Dim>
class IntegralColumns {
 public:
  enum class Of { integrals, squares };

  IntegralColumns(const Grid<Dim>& grid, Of of) {
    const auto entry = [&](double x) { return of == Of::squares ? x * x : x; };
    for (int axis = 0; axis < Dim; ++axis)
      for (int a = 0; a < 3; ++a) {
        for (const auto& value : grid.integrals[axis].value) value_[axis][a].push_back(entry(value[a]));
        for (const auto& slope : grid.integrals[axis].slope) slope_[axis][a].push_back(entry(slope[a]));
      }
  }

  double value(int axis, int a, int cell) const { return value_[axis][a][cell]; }
  double slope(int axis, int a, int cell) const { return slope_[axis][a][cell]; }

 private:
  std::array<std::array<std::vector<double>, 3>, Dim> value_, slope_;
};

/// g_ic = int_c grad N_i of whole cells (h = 1, walls included), or the squares of its components, by the integrals
/// along each axis. It is a product over the axes: first come sums over the rows around a row, then those along it.
template <int Dim, class Integrals>
class CellSlopes {
 public:
  CellSlopes(const GridLayout<Dim>& layout, Integrals integrals) : layout_(layout), integrals_(std::move(integrals)) {}

  /// sum_i v_i . g_ic of a row of cells; v(component, node).
  CellRow<Dim> flow(const RowAt<Dim>& cells, const auto& v) const {
    WideRow<Dim> along{}, across{};  // components along x, to be multiplied with slopes; the others, with values
    for_rows_around<Dim>(layout_, [&](int offset, int y, int z) {
      const std::array<double, Dim> w = weights(cells.first, y, z);
      const int from = cells.begin + offset - 1;
      for (int k = 0; k < cells.count + 2; ++k) {
        along[k] += w[0] * v(0, from + k);
        for (int component = 1; component < Dim; ++component) across[k] += w[component] * v(component, from + k);
      }
    });
    CellRow<Dim> sum{};
    for (int k = 0, cell = cells.first[0]; k < cells.count; ++k, ++cell)
      for (int a = 0; a < 3; ++a)
        sum[k] += integrals_.slope(0, a, cell) * along[k + a] + integrals_.value(0, a, cell) * across[k + a];
    return sum;
  }

  /// sum_c p_c g_ic of a row of nodes; p: an array. The cell at offset a - 1 from a node sees it at 1 - a, as its entry
  /// 2 - a.
  RowForce<Dim> force(const RowAt<Dim>& nodes, const auto& p) const {
    std::array<WideRow<Dim>, Dim> sums{};
    for_rows_around<Dim>(layout_, [&](int offset, int y, int z) {
      std::array<int, Dim> cell = nodes.first;
      cell[1] += y - 1;
      if constexpr (Dim == 3) cell[2] += z - 1;
      const std::array<double, Dim> w = weights(cell, 2 - y, 2 - z);
      const double* const row = p.data() + nodes.begin + offset - 1;
      for (int k = 0; k < nodes.count + 2; ++k)
        for (int component = 0; component < Dim; ++component) sums[component][k] += w[component] * row[k];
    });
    RowForce<Dim> force{};
    for (int k = 0, node = nodes.first[0]; k < nodes.count; ++k, ++node)
      for (int a = 0; a < 3; ++a) {
        force[0][k] += integrals_.slope(0, 2 - a, node + a - 1) * sums[0][k + a];
        const double value = integrals_.value(0, 2 - a, node + a - 1);
        for (int component = 1; component < Dim; ++component) force[component][k] += value * sums[component][k + a];
      }
    return force;
  }

 private:
  /// For each component, what the axes but x multiply it with, at entries y, z of a row of cells.
  std::array<double, Dim> weights(const std::array<int, Dim>& cell, int y, int z) const {
    const double value_y = integrals_.value(1, y, cell[1]), slope_y = integrals_.slope(1, y, cell[1]);
    if constexpr (Dim == 2) {
      return {value_y, slope_y};
    } else {
      const double value_z = integrals_.value(2, z, cell[2]), slope_z = integrals_.slope(2, z, cell[2]);
      return {value_y * value_z, slope_y * value_z, value_y * slope_z};
    }
  }

  const GridLayout<Dim>& layout_;
  Integrals integrals_;
};

template <int Dim>
CellSlopes<Dim, GridIntegrals<Dim>> cell_slopes(const Grid<Dim>& grid) {
  return {grid.layout, GridIntegrals<Dim>{grid}};
}

}  // namespace geodrop
