// Loops over the neighbours of a node or cell.
#pragma once

#include "blocks.hpp"

namespace geodrop {

/// Stored coordinates of a node or cell.
template <int Dim>
std::array<int, Dim> stored_cell(const GridLayout<Dim>& layout, int flat) {
  std::array<int, Dim> cell;
  for (int a = Dim - 1; a >= 0; --a) {
    cell[a] = flat / layout.stride[a];
    flat %= layout.stride[a];
  }
  return cell;
}

/// Flat index of the neighbour at offsets a in {0,1,2}^Dim of a node or cell with these stored coordinates. Along a
/// wall the neighbour beyond it is the mirror image; along a periodic seam, the cell on the other side.
template <int Dim>
int mirrored(const GridLayout<Dim>& layout, const std::array<int, Dim>& cell, const std::array<int, Dim>& a) {
  int flat = 0;
  for (int axis = 0; axis < Dim; ++axis) {
    int c = cell[axis] - GridLayout<Dim>::pad + a[axis] - 1;
    const int cells = layout.cells[axis];
    if (c < 0) c = layout.periodic(axis) ? c + cells : -c;
    if (c > cells) c = layout.periodic(axis) ? c - cells : 2 * cells - c;
    flat += (c + GridLayout<Dim>::pad) * layout.stride[axis];
  }
  return flat;
}

/// The cell that a point is in; x: coordinates of points, an array for each axis [m]. Inlined: loops over particles
/// would spend as much on the call.
template <int Dim, class Points>
[[gnu::always_inline]] inline std::array<int, Dim> place_of_cell_at(const GridLayout<Dim>& layout, const Points& x,
                                                                    std::size_t point) {
  std::array<int, Dim> cell;
  for (int a = 0; a < Dim; ++a) cell[a] = layout.base(a, x[a][point]);
  return cell;
}
/// Its flat index.
template <int Dim, class Points>
[[gnu::always_inline]] inline int cell_at(const GridLayout<Dim>& layout, const Points& x, std::size_t point) {
  return layout.index(place_of_cell_at(layout, x, point));
}

/// Calls f(flat neighbour, offsets a in {0,1,2}^Dim) for the 3^Dim neighbourhood.
template <int Dim, class F>
void for_neighbourhood(const GridLayout<Dim>& layout, int flat, F&& f) {
  std::array<int, Dim> a{};
  for (int z = 0; z < (Dim == 3 ? 3 : 1); ++z)
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 3; ++x) {
        a[0] = x;
        a[1] = y;
        int other = flat + (x - 1) + (y - 1) * layout.stride[1];
        if constexpr (Dim == 3) {
          a[2] = z;
          other += (z - 1) * layout.stride[2];
        }
        f(other, a);
      }
}

inline constexpr double binomial[3] = {0.25, 0.5, 0.25};

/// Of value(flat) over the neighbourhood of a node or cell, walls folded in.
template <int Dim, class F>
double binomial_mean(const GridLayout<Dim>& layout, const std::array<int, Dim>& cell, F&& value) {
  double mean = 0;
  for_neighbourhood(layout, 0, [&](int, const std::array<int, Dim>& a) {
    double weight = 1;
    for (int axis = 0; axis < Dim; ++axis) weight *= binomial[a[axis]];
    mean += weight * value(mirrored<Dim>(layout, cell, a));
  });
  return mean;
}

/// Calls f(offset of the row, y, z) for the rows along x around a node or cell; y, z in {0, 1, 2} (2D: z = 1 only).
template <int Dim, class F>
void for_rows_around(const GridLayout<Dim>& layout, F&& f) {
  for (int z = Dim == 3 ? 0 : 1; z < (Dim == 3 ? 3 : 2); ++z)
    for (int y = 0; y < 3; ++y) f((y - 1) * layout.stride[1] + (Dim == 3 ? (z - 1) * layout.stride[Dim - 1] : 0), y, z);
}

/// True if neither the nodes nor the cells around them touch a wall cell: all integrals are then the interior ones.
template <int Dim>
bool far_from_walls(const GridLayout<Dim>& layout, int count, const std::array<int, Dim>& node) {
  constexpr int margin = GridLayout<Dim>::pad + 2;
  for (int a = 0; a < Dim; ++a) {
    const int last = node[a] + (a == 0 ? count - 1 : 0);
    if (node[a] < margin || last > layout.cells[a] + 2 * GridLayout<Dim>::pad - margin) return false;
  }
  return true;
}

/// For each cell of a row whether filled(flat) holds in its whole neighbourhood.
template <int Dim, class F>
std::array<bool, GridLayout<Dim>::block_width[0]> all_around(const GridLayout<Dim>& layout, int begin, int count,
                                                             std::array<int, Dim> cell, F&& filled) {
  std::array<bool, GridLayout<Dim>::block_width[0]> all;
  all.fill(true);
  if (!far_from_walls<Dim>(layout, count, cell)) {
    for (int k = 0; k < count; ++k, ++cell[0])
      for_neighbourhood(layout, begin + k, [&](int, const std::array<int, Dim>& a) {
        all[k] = all[k] && filled(mirrored<Dim>(layout, cell, a));
      });
    return all;
  }
  std::array<bool, GridLayout<Dim>::block_width[0] + 2> column;  // cells beside each other across x, from begin - 1 on
  column.fill(true);
  for_rows_around<Dim>(layout, [&](int offset, int, int) {
    for (int k = 0; k < count + 2; ++k) column[k] = column[k] && filled(begin + offset + k - 1);
  });
  for (int k = 0; k < count; ++k) all[k] = column[k] && column[k + 1] && column[k + 2];
  return all;
}

}  // namespace geodrop
