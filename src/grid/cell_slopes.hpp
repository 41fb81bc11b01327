// Slopes of whole cells as an operator: from vectors at nodes to cells, and back.
#pragma once

#include <geodrop/grid/grid.hpp>

#include <array>
#include <vector>

#include "cell_pressure.hpp"
#include "neighbourhood.hpp"

namespace geodrop {

/// Vectors at the nodes of a grid, one array for each component, by flat index.
template <int Dim>
using NodeVectors = std::array<std::vector<double>, Dim>;

/// Cells or nodes that stand in a row of a block.
template <int Dim>
struct RowAt {
  int begin, count;            ///< flat indices
  std::array<int, Dim> first;  ///< stored coordinates
};

template <int Dim>
using CellIntegrals = std::array<typename Grid<Dim>::AxisIntegrals, Dim>;

/// The squares of int_c N_i and int_c N_i' along each axis.
template <int Dim>
CellIntegrals<Dim> squares_of(CellIntegrals<Dim> integrals) {
  for (auto& axis : integrals)
    for (int a = 0; a < 3; ++a)
      for (auto* const table : {&axis.value[a], &axis.slope[a]})
        for (double& entry : *table) entry *= entry;
  return integrals;
}

/// g_ic = int_c grad N_i of whole cells (Grid::integrals, h = 1, walls included), or with squares_of the squares of its
/// components. It is a product over the axes: first come sums over the rows around a row, then those along it.
template <int Dim>
class CellSlopes {
 public:
  CellSlopes(const GridLayout<Dim>& layout, const CellIntegrals<Dim>& integrals)
      : layout_(layout), integrals_(integrals) {}

  /// sum_i v_i . g_ic of a row of cells; v(component, node).
  CellRow<Dim> flow(const RowAt<Dim>& cells, const auto& v) const {
    WideRow<Dim> along{}, across{};  // components along x, to be multiplied with slopes; the others, with values
    for_rows_around<Dim>(layout_, [&](int offset, int y, int z) {
      const std::array<double, Dim> w = weights(cells.first, {0, y, z});
      const int from = cells.begin + offset - 1;
      for (int k = 0; k < cells.count + 2; ++k) {
        along[k] += w[0] * v(0, from + k);
        for (int component = 1; component < Dim; ++component) across[k] += w[component] * v(component, from + k);
      }
    });
    CellRow<Dim> sum{};
    for (int a = 0; a < 3; ++a) {
      const double* const value = integrals_[0].value[a].data() + cells.first[0];
      const double* const slope = integrals_[0].slope[a].data() + cells.first[0];
      for (int k = 0; k < cells.count; ++k) sum[k] += slope[k] * along[k + a] + value[k] * across[k + a];
    }
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
      const std::array<double, Dim> w = weights(cell, {0, 2 - y, 2 - z});
      const double* const row = p.data() + nodes.begin + offset - 1;
      for (int component = 0; component < Dim; ++component)
        for (int k = 0; k < nodes.count + 2; ++k) sums[component][k] += w[component] * row[k];
    });
    RowForce<Dim> force{};
    for (int component = 0; component < Dim; ++component)
      for (int a = 0; a < 3; ++a) {
        const auto& table = component == 0 ? integrals_[0].slope : integrals_[0].value;
        const double* const entry = table[2 - a].data() + nodes.first[0] + a - 1;
        for (int k = 0; k < nodes.count; ++k) force[component][k] += entry[k] * sums[component][k + a];
      }
    return force;
  }

 private:
  /// For each component, what the axes but x multiply it with, at entries a of a row of cells.
  std::array<double, Dim> weights(const std::array<int, Dim>& cell, const std::array<int, 3>& a) const {
    std::array<double, Dim> weight;
    for (int component = 0; component < Dim; ++component) {
      weight[component] = 1;
      for (int axis = 1; axis < Dim; ++axis) {
        const auto& tables = integrals_[axis];
        weight[component] *= (component == axis ? tables.slope : tables.value)[a[axis]][cell[axis]];
      }
    }
    return weight;
  }

  const GridLayout<Dim>& layout_;
  const CellIntegrals<Dim>& integrals_;
};

}  // namespace geodrop
