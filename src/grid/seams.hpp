// Periodic axes. Node k and node k + cells are one node, stored twice: nodes -pad..pad below, cells-pad..cells+pad
// above.
//
//     ghosts   domain                ghosts
//     -2 -1 |  0  1  2 ... c-2 c-1  c | c+1 c+2
//      |  |    |  |  |      |   |   |    |   |
//      +--|----|--|--|------+   |   |    |   |      k and k + c hold the same sums, velocities, cells
//         +----|--|--|----------+   |    |   |
//
// Without periodic walls all of this is a test of one flag per axis and step.
#pragma once

#include <geodrop/grid/grid.hpp>

namespace geodrop {

/// A seam needs its stored nodes twice over without overlap.
inline constexpr int fewest_periodic_cells = 2 * GridLayout<2>::pad + 1;

/// Calls f(axis) for each periodic axis.
template <int Dim, class F>
void for_each_seam(const GridLayout<Dim>& layout, F&& f) {
  for (int axis = 0; axis < Dim; ++axis)
    if (layout.periodic(axis)) f(axis);
}

/// Calls f(stored node, its image a period above, coordinate of the node along the axis), ghosts of the other axes
/// included.
template <int Dim, class F>
void for_each_seam_pair(const GridLayout<Dim>& layout, int axis, F&& f) {
  constexpr int pad = GridLayout<Dim>::pad;
  const int stride = layout.stride[axis], lines = layout.nodes() / layout.stored[axis];
  for (int line = 0; line < lines; ++line) {
    const int first = line % stride + line / stride * stride * layout.stored[axis];
    for (int node = -pad; node <= pad; ++node) {
      const int flat = first + (node + pad) * stride;
      f(flat, flat + layout.cells[axis] * stride, node);
    }
  }
}

/// What particles on both sides gave is added up; both sides hold the sum.
template <int Dim, class T>
void sum_over_seam(const GridLayout<Dim>& layout, int axis, Array<T>& field) {
  for_each_seam_pair(layout, axis,
                     [&](int low, int high, int) { field[low] = field[high] = field[low] + field[high]; });
}

/// Ghosts, and the upper wall node, become copies of the nodes that they stand for.
template <int Dim, class T>
void copy_over_seam(const GridLayout<Dim>& layout, int axis, Array<T>& field) {
  for_each_seam_pair(layout, axis, [&](int low, int high, int node) {
    if (node < 0)
      field[low] = field[high];
    else
      field[high] = field[low];
  });
}

/// The node 0..cells-1 along periodic axes that `flat` stands for.
template <int Dim>
int node_of_seam(const GridLayout<Dim>& layout, int flat) {
  constexpr int pad = GridLayout<Dim>::pad;
  int found = flat;
  for_each_seam(layout, [&](int axis) {
    const int node = flat / layout.stride[axis] % layout.stored[axis] - pad, cells = layout.cells[axis];
    found += ((node + cells) % cells - node) * layout.stride[axis];
  });
  return found;
}

}  // namespace geodrop
