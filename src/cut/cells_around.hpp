// Sizes of cells and the nodes around them, in the plane and in space.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

#include <algorithm>
#include <array>

#include "grid/momentum.hpp"
#include "grid/neighbourhood.hpp"

namespace geodrop {

/// Whether a membrane is there and has a sharp interface.
template <int Dim>
bool acts_sharply(const Membrane<Dim>& membrane) {
  return membrane.sharp && membrane.field != waiting;
}

/// The field of grains around sharp membranes, those of coupled soils whose pores the water of field 0 fills; -1: none.
template <int Dim>
int grains_around(const Grids<Dim>& grids) {
  for (const Grid<Dim>& grid : grids)
    if (grid.pore_water == 0) return grid.field;
  return -1;
}

/// Whether a field is around sharp membranes.
template <int Dim>
bool is_around(const Grids<Dim>& grids, int field) {
  return field == 0 || grids[field].pore_water == 0;
}

/// Whether particles of a body may be in cells that a sharp membrane cuts: of its content, of the water in the pores of
/// that, of what is around.
template <int Dim>
bool is_beside(const Body<Dim>& body, const Membrane<Dim>& membrane, const Grids<Dim>& grids) {
  return body.field != waiting && (is_around(grids, body.field) || body.field == membrane.field ||
                                   body.field == grids[membrane.field].pore_water);
}

/// Whether a node of a field is beside cells of which a sharp membrane takes a part.
template <int Dim>
bool beside_cut(const Grid<Dim>& grid, int flat) {
  bool cut = false;
  if (!grid.taken.empty())
    for_neighbourhood(grid.layout, flat,
                      [&](int cell, const std::array<int, Dim>&) { cut = cut || grid.taken[cell] > 0; });
  return cut;
}

/// The knot span of a cell along one axis.
template <int Dim>
SpanShape span_of(const GridLayout<Dim>& layout, int axis, int flat) {
  return layout.span_shape(axis, stored_cell(layout, flat)[axis]);
}

/// The knot spans of a cell along the axes.
template <int Dim>
using CellSpans = std::array<SpanShape, Dim>;

template <int Dim>
CellSpans<Dim> spans_of(const GridLayout<Dim>& layout, int flat) {
  CellSpans<Dim> spans;
  for (int a = 0; a < Dim; ++a) spans[a] = span_of(layout, a, flat);
  return spans;
}

/// The same, at a wall those of the half in the domain.
template <int Dim>
CellSpans<Dim> spans_in_domain(const GridLayout<Dim>& layout, int flat) {
  CellSpans<Dim> spans = spans_of(layout, flat);
  const std::array<int, Dim> place = stored_cell(layout, flat);
  if (far_from_walls<Dim>(layout, 1, place)) return spans;
  for (int a = 0; a < Dim; ++a) {
    if (!on_wall(layout, a, place[a])) continue;
    spans[a].width *= 0.5;
    spans[a].part = place[a] == layout.pad ? SpanShape::Part::upper_half : SpanShape::Part::lower_half;
  }
  return spans;
}

/// Area or volume of a cell, walls or not [m2, m3].
template <int Dim>
double cell_size(const GridLayout<Dim>& layout, int flat) {
  double size = span_of(layout, 0, flat).width;
  for (int a = 1; a < Dim; ++a) size *= span_of(layout, a, flat).width;
  return size;
}

/// What the domain has of a cell: half at a wall [m2, m3].
template <int Dim>
double size_in_domain(const GridLayout<Dim>& layout, int flat) {
  const std::array<int, Dim> place = stored_cell(layout, flat);
  double size = cell_size(layout, flat);
  for (int a = 0; a < Dim; ++a) {
    if (on_wall(layout, a, place[a])) size *= 0.5;
  }
  return size;
}

/// Share of a cell that bodies of other fields and rigid bodies have [-].
template <int Dim>
double taken_of(const Grid<Dim>& grid, int flat) {
  double share = grid.taken.empty() ? 0.0 : grid.taken[flat];
  if (!grid.rigid_cells.empty()) share += grid.rigid_cells[flat];
  return std::min(share, 1.0);
}

/// A box of cells as places, wider by about half a cell: for the many particles that are not there a comparison takes
/// the place of the search for their cell.
template <int Dim>
class BoxOfCells {
 public:
  /// first, last: stored coordinates of the cells, both in the box.
  BoxOfCells(const GridLayout<Dim>& layout, const std::array<int, Dim>& first, const std::array<int, Dim>& last) {
    for (int a = 0; a < Dim; ++a) {
      lower_[a] = layout.node(a, first[a] - 1 - GridLayout<Dim>::pad);
      upper_[a] = layout.node(a, last[a] + 1 - GridLayout<Dim>::pad);
    }
  }

  /// The box around an outline.
  BoxOfCells(const GridLayout<Dim>& layout, const Outline<Dim>& cells)
      : BoxOfCells(layout, cells.first, last_of(cells)) {}

  /// x: coordinates of points, an array for each axis.
  bool may_hold(const std::array<Array<double>, Dim>& x, std::size_t point) const {
    for (int a = 0; a < Dim; ++a)
      if (!(x[a][point] >= lower_[a] && x[a][point] <= upper_[a])) return false;
    return true;
  }

 private:
  static std::array<int, Dim> last_of(const Outline<Dim>& cells) {
    std::array<int, Dim> last;
    for (int a = 0; a < Dim; ++a) last[a] = cells.first[a] + cells.count[a] - 1;
    return last;
  }

  std::array<double, Dim> lower_, upper_;
};

/// Width of a cell where it is narrowest [m].
template <int Dim>
double least_width(const GridLayout<Dim>& layout, int flat) {
  double width = span_of(layout, 0, flat).width;
  for (int a = 1; a < Dim; ++a) width = std::min(width, span_of(layout, a, flat).width);
  return width;
}

/// Flat index of node or cell n of those around a cell, x fastest.
template <int Dim>
int node_around(const GridLayout<Dim>& layout, int flat, int n) {
  flat += n % 3 - 1 + (n / 3 % 3 - 1) * layout.stride[1];
  if constexpr (Dim == 3) flat += (n / 9 - 1) * layout.stride[2];
  return flat;
}

/// Share of each cell of a box inside [-].
inline const Array<double>& inside_of(const CutCells& box) { return box.area; }
inline const Array<double>& inside_of(const ClippedCells& box) { return box.inside; }

}  // namespace geodrop
