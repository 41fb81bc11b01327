#include "clipped_cells.hpp"

#include <algorithm>
#include <cmath>

#include "clip_pieces.hpp"

namespace geodrop {
namespace {

class Clipper {
 public:
  explicit Clipper(ClippedCells& cells) : cells_(cells) {}

  void add(std::uint32_t triangle, const Facet& facet) {
    const double size = facet.normal.norm();
    if (!(size > 0)) return;
    const Vec<3> unit = facet.normal / size;
    for_each_piece_of(facet, cells_, [&](int c, const BoxCell& cell, const ConvexPiece& piece) {
      const Vec<3> normal = unit.cwiseProduct(cell.per_face);
      const auto share = for_each_fan(facet, size, piece, [&](const std::array<Vec<3>, 3>& fan, double area) {
        for (const TrianglePoint& q : triangle_degree_4)
          add_point(c, cell.place_of(q.share[0] * fan[0] + q.share[1] * fan[1] + q.share[2] * fan[2]),
                    q.weight * area * normal);
      });
      cells_.pieces.push_back({c, triangle, share});
    });
  }

 private:
  /// z from the middle of the cell [its widths]; `normal` times weight [its faces].
  void add_point(int c, const Vec<3>& z, const Vec<3>& normal) {
    cells_.inside[c] += normal[0] * (z[0] + 0.5);
    for (int a = 0; a < 3; ++a) {
      const double u = z[(a + 1) % 3], w = z[(a + 2) % 3], n = normal[a];
      ClippedCells::FaceMoments& m = cells_.upper_face[static_cast<std::size_t>(a)][c];
      m[0] += n;
      m[1] += n * u;
      m[2] += n * u * u;
      m[3] += n * w;
      m[4] += n * u * w;
      m[5] += n * u * u * w;
      m[6] += n * w * w;
      m[7] += n * u * w * w;
      m[8] += n * u * u * w * w;
    }
  }

  ClippedCells& cells_;
};

/// Coordinates of the box: cells are about nodes, the lower side of an even cell 0 is half a cell below its node.
double in_box(const GridLayout<3>& layout, const ClippedCells& cells, int axis, double x) {
  return (x - layout.lower[axis]) * layout.inv_h + 0.5 + GridLayout<3>::pad - cells.first[axis];
}

void place_planes(const GridLayout<3>& layout, int axis, ClippedCells& cells) {
  Array<double>& plane = cells.plane[static_cast<std::size_t>(axis)];
  plane.resize(cells.count[axis] + 1);
  for (int i = 0; i <= cells.count[axis]; ++i)
    plane[i] = layout.graded() ? in_box(layout, cells, axis, layout.knots[axis][cells.first[axis] + i].left) : i;
}

/// A cell at a wall at which the surface ends is the half of it in the domain.
void end_at_walls(const GridLayout<3>& layout, const Membrane<3>& membrane, ClippedCells& cells) {
  for (const std::uint32_t wall : membrane.triangles.open_edge[2]) {
    const SurfaceEnd end = end_at(layout, wall);
    plane_on_wall(layout, end, cells) = in_box(layout, cells, end.axis, end.place);
  }
}

}  // namespace

void place_box(const GridLayout<3>& layout, const Membrane<3>& membrane, ClippedCells& cells) {
  int size = 1;
  for (int a = 0; a < 3; ++a) {
    const auto [low, high] = std::minmax_element(membrane.x[a].begin(), membrane.x[a].end());
    cells.first[a] = layout.base(a, *low) + GridLayout<3>::pad - 1;
    cells.count[a] = layout.base(a, *high) + GridLayout<3>::pad + 2 - cells.first[a];
    size *= cells.count[a];
    place_planes(layout, a, cells);
  }
  end_at_walls(layout, membrane, cells);
  cells.even = !layout.graded() && membrane.triangles.open_edge[2].empty();
  cells.inside.assign(size, 0.0);
  for (auto& face : cells.upper_face) face.assign(size, {});
  cells.pieces.clear();
}

Vec<3> place_in(const GridLayout<3>& layout, const ClippedCells& cells, const std::array<double, 3>& x) {
  Vec<3> place;
  for (int a = 0; a < 3; ++a) place[a] = in_box(layout, cells, a, x[static_cast<std::size_t>(a)]);
  return place;
}

Facet facet_of(const GridLayout<3>& layout, const Membrane<3>& membrane, const ClippedCells& cells,
               std::size_t triangle) {
  const auto place = [&](std::size_t node) {
    return place_in(layout, cells, {membrane.x[0][node], membrane.x[1][node], membrane.x[2][node]});
  };
  const auto& corner = membrane.triangles.corner;
  return Facet({place(corner[0][triangle]), place(corner[1][triangle]), place(corner[2][triangle])});
}

void sum_beyond_faces(ClippedCells& cells) {
  const std::array<int, 3> stride{1, cells.count[0], cells.count[0] * cells.count[1]};
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t u = (a + 1) % 3, w = (a + 2) % 3;
#pragma omp parallel for schedule(static)
    for (int j = 0; j < cells.count[w]; ++j)
      for (int i = 0; i < cells.count[u]; ++i) {
        ClippedCells::FaceMoments beyond{};
        for (int k = cells.count[a] - 1; k >= 0; --k) {
          const int c = i * stride[u] + j * stride[w] + k * stride[a];
          ClippedCells::FaceMoments& face = cells.upper_face[a][c];
          const ClippedCells::FaceMoments own = face;
          face = beyond;
          if (a == 0) cells.inside[c] += beyond[0];
          for (std::size_t m = 0; m < own.size(); ++m) beyond[m] += own[m];
        }
      }
  }
}

void clip_cells(const GridLayout<3>& layout, const Membrane<3>& membrane, ClippedCells& cells) {
  place_box(layout, membrane, cells);
  Clipper clipper(cells);
  for (std::uint32_t t = 0; t < membrane.triangles.size(); ++t) clipper.add(t, facet_of(layout, membrane, cells, t));
  sum_beyond_faces(cells);
}

std::array<double, 9> face_integrals(const ClippedCells::FaceMoments& moments, const SpanShape& along_u,
                                     const SpanShape& along_w) {
  const SplinePowers of_u = spline_powers(along_u), of_w = spline_powers(along_w);
  std::array<double, 9> integral{};
  for (std::size_t w = 0; w < 3; ++w)
    for (std::size_t u = 0; u < 3; ++u)
      for (std::size_t b = 0; b < 3; ++b)
        for (std::size_t a = 0; a < 3; ++a) integral[u + 3 * w] += of_u[u][a] * of_w[w][b] * moments[a + 3 * b];
  return integral;
}

}  // namespace geodrop
