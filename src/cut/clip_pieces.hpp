// The pieces of a triangle in the cells of a box, and what the clipping of a surface begins and ends with.
#pragma once

#include <geodrop/geometry/triangle_surface.hpp>
#include <geodrop/grid/grid.hpp>
#include <geodrop/state/state.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "geometry/clip_triangle.hpp"
#include "geometry/triangle_rule.hpp"

namespace geodrop {

inline Vec<3> to_vector(const SpacePoint& x) { return {x[0], x[1], x[2]}; }

/// Where a cell of a box is, and how large [h].
struct BoxCell {
  Vec<3> middle, width, per_width;  ///< per_width: 1 / width
  Vec<3> per_face;                  ///< 1 / area of the face across each axis

  BoxCell(const ClippedCells& cells, const std::array<int, 3>& at) {
    for (std::size_t a = 0; a < 3; ++a) {
      const double lower = cells.plane[a][at[a]], upper = cells.plane[a][at[a] + 1];
      middle[a] = 0.5 * (lower + upper);
      width[a] = upper - lower;
      per_width[a] = 1 / width[a];
    }
    for (int a = 0; a < 3; ++a) per_face[a] = per_width[(a + 1) % 3] * per_width[(a + 2) % 3];
  }
  BoxCell(const ClippedCells& cells, int c)
      : BoxCell(cells,
                {c % cells.count[0], c / cells.count[0] % cells.count[1], c / (cells.count[0] * cells.count[1])}) {}

  /// From its middle, in its widths.
  Vec<3> place_of(const Vec<3>& x) const { return (x - middle).cwiseProduct(per_width); }
  /// Area of a piece with this unit normal, as the cell sees it.
  double faces_of(double area, const Vec<3>& normal) const {
    if (per_width[0] == per_width[1] && per_width[0] == per_width[2]) return area * per_face[0];
    return area * normal.cwiseProduct(per_face).norm();
  }
};

/// Cells that a piece reaches along an axis.
inline std::pair<int, int> reach(const ClippedCells& cells, const ConvexPiece& piece, std::size_t axis) {
  double low = piece.at[0][axis], high = low;
  for (std::size_t k = 1; k < piece.count; ++k) {
    low = std::min(low, piece.at[k][axis]);
    high = std::max(high, piece.at[k][axis]);
  }
  if (cells.even) {
    const int from = static_cast<int>(std::floor(low));
    return {from, std::max(from, static_cast<int>(std::ceil(high)) - 1)};
  }
  const Array<double>& plane = cells.plane[axis];
  const int from = static_cast<int>(std::upper_bound(plane.begin(), plane.end(), low) - plane.begin()) - 1;
  return {from,
          std::max(from, static_cast<int>(std::lower_bound(plane.begin(), plane.end(), high) - plane.begin()) - 1)};
}

/// f(cell, piece) for the pieces of a polygon along an axis and those after it.
template <std::size_t axis, class F>
void split_into_cells(const ClippedCells& cells, ConvexPiece rest, std::array<int, 3>& cell, F& f) {
  if constexpr (axis == 3) {
    f(cell, rest);
  } else {
    const auto [from, to] = reach(cells, rest, axis);
    for (int i = from; i <= to && rest.count > 0; ++i) {
      ConvexPiece own = rest, beyond;
      beyond.count = 0;
      if (i < to) split(rest, axis, cells.plane[axis][i + 1], own, beyond);
      cell[axis] = i;
      if (own.count > 0) split_into_cells<axis + 1>(cells, own, cell, f);
      rest = beyond;
    }
  }
}

/// A triangle of the surface in the coordinates of the box [h].
struct Facet {
  std::array<Vec<3>, 3> corner;
  Vec<3> normal;                          ///< area times unit normal [h2]
  Eigen::Matrix<double, 2, 3> to_shares;  ///< of corners 1 and 2, from the way from corner 0

  explicit Facet(const std::array<Vec<3>, 3>& corners) : corner(corners) {
    const Vec<3> one = corner[1] - corner[0], other = corner[2] - corner[0];
    normal = 0.5 * one.cross(other);
    const double aa = one.dot(one), ab = one.dot(other), bb = other.dot(other), det = aa * bb - ab * ab;
    to_shares.row(0) = (bb * one - ab * other).transpose() / det;
    to_shares.row(1) = (aa * other - ab * one).transpose() / det;
  }
};

/// f(local cell, where it is, piece) for the pieces of a triangle in the cells of a box.
template <class F>
void for_each_piece_of(const Facet& facet, const ClippedCells& cells, F&& f) {
  ConvexPiece whole;
  whole.count = 0;
  for (const Vec<3>& x : facet.corner) whole.add({x[0], x[1], x[2]});
  std::array<int, 3> cell{};
  const auto visit = [&](const std::array<int, 3>& at, const ConvexPiece& piece) {
    f(at[0] + cells.count[0] * (at[1] + cells.count[1] * at[2]), BoxCell(cells, at), piece);
  };
  split_into_cells<0>(cells, whole, cell, visit);
}

/// f(corners, area) for the triangles of a piece; the integrals of the linear functions of the facet's corners over the
/// piece, over the facet's area `size`.
template <class F>
std::array<double, 3> for_each_fan(const Facet& facet, double size, const ConvexPiece& piece, F&& f) {
  const Vec<3> unit = facet.normal / size;
  std::array<double, 3> share{};
  for (std::size_t k = 1; k + 1 < piece.count; ++k) {
    const std::array<Vec<3>, 3> fan{to_vector(piece.at[0]), to_vector(piece.at[k]), to_vector(piece.at[k + 1])};
    const double area = 0.5 * (fan[1] - fan[0]).cross(fan[2] - fan[0]).dot(unit);
    if (area == 0) continue;
    const Eigen::Vector2d shares = area / size * facet.to_shares * ((fan[0] + fan[1] + fan[2]) / 3 - facet.corner[0]);
    share[0] += area / size - shares[0] - shares[1];
    share[1] += shares[0];
    share[2] += shares[1];
    f(fan, area);
  }
  return share;
}

/// The end of a surface at a wall, by its wall_number.
inline SurfaceEnd end_at(const GridLayout<3>& layout, std::uint32_t wall) {
  const int axis = static_cast<int>(wall / 2);
  const bool upper = wall % 2 == 1;
  return {axis, upper, upper ? layout.upper[axis] : layout.lower[axis]};
}

/// Coordinate of the plane of a box that is on a wall [h].
inline double& plane_on_wall(const GridLayout<3>& layout, const SurfaceEnd& end, ClippedCells& cells) {
  const int at_lower = GridLayout<3>::pad - cells.first[end.axis];
  return cells.plane[static_cast<std::size_t>(end.axis)][end.upper ? at_lower + layout.cells[end.axis] + 1 : at_lower];
}

/// A box of cells around a membrane with a cell to spare on all sides, with nothing in it.
void place_box(const GridLayout<3>& layout, const Membrane<3>& membrane, ClippedCells& cells);

/// A triangle of a membrane in the coordinates of its box.
Facet facet_of(const GridLayout<3>& layout, const Membrane<3>& membrane, const ClippedCells& cells,
               std::size_t triangle);

/// A point in the coordinates of a box [h].
Vec<3> place_in(const GridLayout<3>& layout, const ClippedCells& cells, const std::array<double, 3>& x);

/// From what the pieces in each cell project to what lies beyond each face.
void sum_beyond_faces(ClippedCells& cells);

}  // namespace geodrop
