// Slopes of whole cells as an operator, for systems of equations: from vectors at nodes to cells, and back.
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

/// g_ic = int_c grad N_i of whole cells (Grid::integrals, h = 1), or the squares of its components. It is a product
/// over the axes: first come sums over the rows around a row, then those along it.
template <int Dim>
class CellSlopes {
 public:
  enum class Of { slopes, squares };

  CellSlopes(const Grid<Dim>& grid, Of of) : layout_(grid.layout) {
    const auto entry = [&](double x) { return of == Of::squares ? x * x : x; };
    for (int axis = 0; axis < Dim; ++axis)
      for (int a = 0; a < 3; ++a) {
        for (const auto& value : grid.integrals[axis].value) value_[axis][a].push_back(entry(value[a]));
        for (const auto& slope : grid.integrals[axis].slope) slope_[axis][a].push_back(entry(slope[a]));
      }
  }

  /// sum_i v_i . g_ic of a row of cells.
  CellRow<Dim> flow(const RowAt<Dim>& cells, const NodeVectors<Dim>& v) const {
    WideRow<Dim> along{}, across{};  // components along x, to be multiplied with slopes; the others, with values
    for_rows_around<Dim>(layout_, [&](int offset, int y, int z) {
      const std::array<double, Dim> w = weights(cells.first, {0, y, z});
      const int from = cells.begin + offset - 1;
      for (int k = 0; k < cells.count + 2; ++k) {
        along[k] += w[0] * v[0][from + k];
        for (int component = 1; component < Dim; ++component) across[k] += w[component] * v[component][from + k];
      }
    });
    CellRow<Dim> sum{};
    for (int a = 0; a < 3; ++a) {
      const double* const value = value_[0][a].data() + cells.first[0];
      const double* const slope = slope_[0][a].data() + cells.first[0];
      for (int k = 0; k < cells.count; ++k) sum[k] += slope[k] * along[k + a] + value[k] * across[k + a];
    }
    return sum;
  }

  /// sum_c p_c g_ic of a row of nodes. The cell at offset a - 1 from a node sees it at 1 - a, as its entry 2 - a.
  RowForce<Dim> force(const RowAt<Dim>& nodes, const std::vector<double>& p) const {
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
        const Table& table = component == 0 ? slope_[0] : value_[0];
        const double* const entry = table[2 - a].data() + nodes.first[0] + a - 1;
        for (int k = 0; k < nodes.count; ++k) force[component][k] += entry[k] * sums[component][k + a];
      }
    return force;
  }

 private:
  using Table = std::array<std::vector<double>, 3>;  // of entry a, by stored coordinate

  /// For each component, what the axes but x multiply it with, at entries a of a row of cells.
  std::array<double, Dim> weights(const std::array<int, Dim>& cell, const std::array<int, 3>& a) const {
    std::array<double, Dim> weight;
    for (int component = 0; component < Dim; ++component) {
      weight[component] = 1;
      for (int axis = 1; axis < Dim; ++axis)
        weight[component] *= (component == axis ? slope_ : value_)[axis][a[axis]][cell[axis]];
    }
    return weight;
  }

  const GridLayout<Dim>& layout_;
  std::array<Table, Dim> value_, slope_;
};

}  // namespace geodrop
