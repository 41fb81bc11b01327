// int grad N and int N over a cell, knot spans of any width, and over the part of it that an outline cuts off.
#pragma once

#include <geodrop/grid/grid.hpp>

#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "cells_around.hpp"
#include "clipped_cells.hpp"
#include "cut_cells.hpp"
#include "grid/momentum.hpp"
#include "outline_pieces.hpp"

namespace geodrop {

/// int N and int N' of the nodes below, at and above over (a part of) a span of each axis [its width, -].
template <std::size_t dim>
struct AlongAxes {
  std::array<std::array<double, 3>, dim> value, slope;
};

/// int grad N over a cell, by the integrals along its axes.
template <std::size_t dim>
Slope<dim> product_of(const std::array<SpanShape, dim>& cell, const AlongAxes<dim>& along) {
  Slope<dim> whole;
  for (std::size_t n = 0; n < whole.size(); ++n) {
    const std::array<std::size_t, 3> at{n % 3, n / 3 % 3, n / 9};
    for (std::size_t a = 0; a < dim; ++a) {
      double product = 1;
      for (std::size_t b = 0; b < dim; ++b)
        if (b != a) product *= cell[b].width;
      for (std::size_t b = 0; b < dim; ++b) product *= (b == a ? along.slope : along.value)[b][at[b]];
      whole[n][a] = product;
    }
  }
  return whole;
}

/// int grad N over a cell.
template <std::size_t dim>
Slope<dim> whole_cell(const std::array<SpanShape, dim>& cell) {
  AlongAxes<dim> along;
  for (std::size_t a = 0; a < dim; ++a) {
    along.value[a] = cell[a].values();
    along.slope[a] = cell[a].slopes();
  }
  return product_of(cell, along);
}

/// Hands what the nodes beyond walls have on to their mirror images, as grid/momentum's fold_walls does, and leaves out
/// what walls hold.
template <int Dim>
void fold_at_walls(const GridLayout<Dim>& layout, int flat, std::type_identity_t<Slope<Dim>>& slope) {
  const std::array<int, Dim> place = stored_cell(layout, flat);
  if (far_from_walls<Dim>(layout, 1, place)) return;
  constexpr std::array<int, 3> step{1, 3, 9};
  for (int axis = 0; axis < Dim; ++axis) {
    if (!on_wall(layout, axis, place[axis])) continue;
    const bool lower = place[axis] == layout.pad;
    const WallKind wall = lower ? layout.lower_wall[axis] : layout.upper_wall[axis];
    for (int n = 0; n < nodes_around<Dim>; ++n) {
      if (n / step[axis] % 3 != (lower ? 0 : 2)) continue;
      for (int a = 0; a < Dim; ++a) {
        slope[n + (lower ? 2 : -2) * step[axis]][a] += mirror_sign(wall, axis, a) * slope[n][a];
        slope[n][a] = 0;
      }
    }
  }
  for (int n = 0; n < nodes_around<Dim>; ++n) {
    const std::array<bool, Dim> held = held_by_walls(layout, node_around(layout, flat, n));
    for (int a = 0; a < Dim; ++a)
      if (held[a]) slope[n][a] = 0;
  }
}

/// int N and int N' of the nodes below, at and above over the half of a span that is in the domain.
struct HalfSpan {
  std::array<double, 3> value, slope;
};
inline HalfSpan half_span(const SpanShape& span, bool upper_half) {
  const auto [below, above] = upper_half ? std::pair(span.below, span.above) : std::pair(span.above, span.below);
  HalfSpan half{{below / 24, 0.5 - below / 24 - 7 * above / 24, 7 * above / 24},
                {-below / 4, (below - 3 * above) / 4, 3 * above / 4}};
  if (upper_half) return half;
  std::swap(half.value[0], half.value[2]);
  std::swap(half.slope[0], half.slope[2]);
  for (double& slope : half.slope) slope = -slope;
  return half;
}

/// int grad N over what the domain has of a cell, half of it at a wall.
template <int Dim>
Slope<Dim> slopes_in_domain(const GridLayout<Dim>& layout, int flat) {
  const std::array<int, Dim> place = stored_cell(layout, flat);
  const CellSpans<Dim> spans = spans_of(layout, flat);
  if (far_from_walls<Dim>(layout, 1, place)) return whole_cell(spans);
  AlongAxes<Dim> along;
  for (int a = 0; a < Dim; ++a) {
    const bool at_wall = on_wall(layout, a, place[a]);
    const HalfSpan half = half_span(spans[a], place[a] == layout.pad);
    along.value[a] = at_wall ? half.value : spans[a].values();
    along.slope[a] = at_wall ? half.slope : spans[a].slopes();
  }
  Slope<Dim> in_domain = product_of(spans, along);
  fold_at_walls(layout, flat, in_domain);
  return in_domain;
}

/// Adds int N n over the part of a face inside; the face is on the side `side` (0 below, 1 above) of the cell.
inline void add_face(const FaceMoments& moments, int axis, int side, const CellSpans<2>& cell, Slope<2>& slope) {
  const SpanShape &across = cell[axis], &face = cell[1 - axis];
  const std::array<double, 3> along = face_integrals(moments, face.below, face.above);
  const double sign = side == 1 ? 1 : -1, beyond = side == 1 ? across.above : across.below;
  for (int n = 0; n < 3; ++n)
    for (const int k : {side, side + 1}) {
      const int node = axis == 0 ? k + 3 * n : n + 3 * k;
      slope[node][axis] += sign * (k == 1 ? 1 - beyond : beyond) * face.width * along[n];
    }
}
inline void add_face(const ClippedCells::FaceMoments& moments, int axis, int side, const CellSpans<3>& cell,
                     Slope<3>& slope) {
  constexpr std::array<int, 3> step{1, 3, 9};
  const int u = (axis + 1) % 3, w = (axis + 2) % 3;
  const std::array<double, 9> along = face_integrals(moments, cell[u], cell[w]);
  const double sign = side == 1 ? 1 : -1, beyond = side == 1 ? cell[axis].above : cell[axis].below;
  for (const int k : {side, side + 1}) {
    const double size = sign * (k == 1 ? 1 - beyond : beyond) * cell[u].width * cell[w].width;
    for (int n = 0; n < 9; ++n) slope[k * step[axis] + n % 3 * step[u] + n / 3 * step[w]][axis] += size * along[n];
  }
}

/// a_ic of a cut cell without what the membrane adds.
inline Slope<2> faces_of(const CutCells& cells, int c, const CellSpans<2>& cell) {
  Slope<2> slope{};
  add_face(cells.right_face[c], 0, 1, cell, slope);
  add_face(cells.right_face[c - 1], 0, 0, cell, slope);
  add_face(cells.top_face[c], 1, 1, cell, slope);
  add_face(cells.top_face[c - cells.count[0]], 1, 0, cell, slope);
  return slope;
}
/// Of a face on a wall the normal velocity is 0: it adds nothing once fold_at_walls has been.
inline Slope<3> faces_of(const ClippedCells& cells, int c, const CellSpans<3>& cell) {
  const std::array<int, 3> stride{1, cells.count[0], cells.count[0] * cells.count[1]};
  Slope<3> slope{};
  for (std::size_t a = 0; a < 3; ++a) {
    const int axis = static_cast<int>(a);
    if (cell[a].part != SpanShape::Part::lower_half) add_face(cells.upper_face[a][c], axis, 1, cell, slope);
    if (cell[a].part != SpanShape::Part::upper_half) add_face(cells.upper_face[a][c - stride[a]], axis, 0, cell, slope);
  }
  return slope;
}

/// int N over a cell.
template <std::size_t dim>
SplineVolumes<dim> whole_value(const std::array<SpanShape, dim>& cell) {
  std::array<std::array<double, 3>, dim> along;
  for (std::size_t a = 0; a < dim; ++a) along[a] = cell[a].values();
  SplineVolumes<dim> value;
  for (std::size_t n = 0; n < value.size(); ++n) {
    const std::array<std::size_t, 3> at{n % 3, n / 3 % 3, n / 9};
    value[n] = cell[0].width * along[0][at[0]];
    for (std::size_t a = 1; a < dim; ++a) value[n] = value[n] * cell[a].width * along[a][at[a]];
  }
  return value;
}

/// int N over the part of a cell inside without what the membrane adds, by the divergence theorem along x.
inline SplineVolumes<2> beside_right_face(const CutCells& cells, int c, const CellSpans<2>& cell) {
  const std::array<double, 3> x = cell[0].values();
  const std::array<double, 3> along = face_integrals(cells.right_face[c], cell[1].below, cell[1].above);
  SplineVolumes<2> value;
  for (int n = 0; n < 9; ++n) value[n] = cell[0].width * x[n % 3] * cell[1].width * along[n / 3];
  return value;
}
inline SplineVolumes<3> beside_right_face(const ClippedCells& cells, int c, const CellSpans<3>& cell) {
  const std::array<double, 3> x = means_over(cell[0]);
  const std::array<double, 9> along = face_integrals(cells.upper_face[0][c], cell[1], cell[2]);
  const double size = cell[0].width * cell[1].width * cell[2].width;
  SplineVolumes<3> value;
  for (int n = 0; n < 27; ++n) value[n] = size * x[n % 3] * along[n / 3];
  return value;
}

}  // namespace geodrop
