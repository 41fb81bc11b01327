#include "clipped_cells.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "geometry/clip_triangle.hpp"

namespace geodrop {
namespace {

/// A point of a quadrature on triangles, exact for polynomials of degree 4 (Dunavant 1985).
struct TrianglePoint {
  std::array<double, 3> share;
  double weight;
};
constexpr double near_a = 0.445948490915965, near_w = 0.223381589678011, far_a = 0.091576213509771,
                 far_w = 0.109951743655322;
constexpr std::array<TrianglePoint, 6> degree_4{{{{near_a, near_a, 1 - 2 * near_a}, near_w},
                                                 {{near_a, 1 - 2 * near_a, near_a}, near_w},
                                                 {{1 - 2 * near_a, near_a, near_a}, near_w},
                                                 {{far_a, far_a, 1 - 2 * far_a}, far_w},
                                                 {{far_a, 1 - 2 * far_a, far_a}, far_w},
                                                 {{1 - 2 * far_a, far_a, far_a}, far_w}}};

/// A corner of a triangle or of a piece: place in the box [cells], with the shares of the triangle's corners.
Vec<3> to_vector(const SpacePoint& x) { return {x[0], x[1], x[2]}; }

/// Cells that a piece reaches along an axis.
std::pair<int, int> reach(const ConvexPiece& piece, std::size_t axis) {
  double low = piece.at[0][axis], high = low;
  for (std::size_t k = 1; k < piece.count; ++k) {
    low = std::min(low, piece.at[k][axis]);
    high = std::max(high, piece.at[k][axis]);
  }
  const int from = static_cast<int>(std::floor(low));
  return {from, std::max(from, static_cast<int>(std::ceil(high)) - 1)};
}

/// f(cell, piece) for the pieces of a polygon along an axis and those after it.
template <std::size_t axis, class F>
void split_into_cells(ConvexPiece rest, std::array<int, 3>& cell, F& f) {
  if constexpr (axis == 3) {
    f(cell, rest);
  } else {
    const auto [from, to] = reach(rest, axis);
    for (int i = from; i <= to && rest.count > 0; ++i) {
      ConvexPiece own = rest, beyond;
      beyond.count = 0;
      if (i < to) split(rest, axis, i + 1, own, beyond);
      cell[axis] = i;
      if (own.count > 0) split_into_cells<axis + 1>(own, cell, f);
      rest = beyond;
    }
  }
}

/// A triangle of the surface in the coordinates of the box.
struct Facet {
  std::array<Vec<3>, 3> corner;
  Vec<3> normal;                          ///< area times unit normal [cells2]
  Eigen::Matrix<double, 2, 3> to_shares;  ///< of corners 1 and 2, from the way from corner 0

  explicit Facet(const std::array<Vec<3>, 3>& corners) : corner(corners) {
    const Vec<3> one = corner[1] - corner[0], other = corner[2] - corner[0];
    normal = 0.5 * one.cross(other);
    const double aa = one.dot(one), ab = one.dot(other), bb = other.dot(other), det = aa * bb - ab * ab;
    to_shares.row(0) = (bb * one - ab * other).transpose() / det;
    to_shares.row(1) = (aa * other - ab * one).transpose() / det;
  }
};

class Clipper {
 public:
  explicit Clipper(ClippedCells& cells) : cells_(cells) {}

  void add(std::uint32_t triangle, const Facet& facet) {
    ConvexPiece whole;
    whole.count = 0;
    for (const Vec<3>& x : facet.corner) whole.add({x[0], x[1], x[2]});
    const double size = facet.normal.norm();
    if (!(size > 0)) return;
    std::array<int, 3> cell{};
    auto take = [&](const std::array<int, 3>& at, const ConvexPiece& piece) {
      add_piece(triangle, facet, size, at, piece);
    };
    split_into_cells<0>(whole, cell, take);
  }

 private:
  void add_piece(std::uint32_t triangle, const Facet& facet, double size, const std::array<int, 3>& at,
                 const ConvexPiece& piece) {
    const int c = at[0] + cells_.count[0] * (at[1] + cells_.count[1] * at[2]);
    const Vec<3> middle(at[0] + 0.5, at[1] + 0.5, at[2] + 0.5), unit = facet.normal / size;
    ClippedCells::Piece part{c, triangle, {}};
    for (std::size_t k = 1; k + 1 < piece.count; ++k) {
      const std::array<Vec<3>, 3> fan{to_vector(piece.at[0]), to_vector(piece.at[k]), to_vector(piece.at[k + 1])};
      const double area = 0.5 * (fan[1] - fan[0]).cross(fan[2] - fan[0]).dot(unit);
      if (area == 0) continue;
      const Eigen::Vector2d shares = area / size * facet.to_shares * ((fan[0] + fan[1] + fan[2]) / 3 - facet.corner[0]);
      part.share[0] += area / size - shares[0] - shares[1];
      part.share[1] += shares[0];
      part.share[2] += shares[1];
      for (const TrianglePoint& q : degree_4)
        add_point(c, q.share[0] * fan[0] + q.share[1] * fan[1] + q.share[2] * fan[2] - middle, q.weight * area * unit);
    }
    cells_.pieces.push_back(part);
  }

  /// z from the middle of the cell; `normal` times weight.
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

/// From what the pieces in each cell project to what lies beyond each face.
void sum_up(ClippedCells& cells) {
  const std::array<int, 3> stride{1, cells.count[0], cells.count[0] * cells.count[1]};
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t u = (a + 1) % 3, w = (a + 2) % 3;
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

/// A box with a cell to spare on all sides.
void place_box(const GridLayout<3>& layout, const Membrane<3>& membrane, ClippedCells& cells) {
  int size = 1;
  for (int a = 0; a < 3; ++a) {
    const auto [low, high] = std::minmax_element(membrane.x[a].begin(), membrane.x[a].end());
    cells.first[a] = layout.base(a, *low) + GridLayout<3>::pad - 1;
    cells.count[a] = layout.base(a, *high) + GridLayout<3>::pad + 2 - cells.first[a];
    size *= cells.count[a];
  }
  cells.inside.assign(size, 0.0);
  for (auto& face : cells.upper_face) face.assign(size, {});
  cells.pieces.clear();
}

}  // namespace

void clip_cells(const GridLayout<3>& layout, const Membrane<3>& membrane, ClippedCells& cells) {
  place_box(layout, membrane, cells);
  Clipper clipper(cells);
  // Cells are about nodes: the lower side of cell 0 is half a cell below its node.
  const auto in_box = [&](std::size_t node) {
    Vec<3> x;
    for (int a = 0; a < 3; ++a)
      x[a] = (membrane.x[a][node] - layout.lower[a]) * layout.inv_h + 0.5 + GridLayout<3>::pad - cells.first[a];
    return x;
  };
  const auto& corner = membrane.triangles.corner;
  for (std::uint32_t t = 0; t < membrane.triangles.size(); ++t)
    clipper.add(t, Facet({in_box(corner[0][t]), in_box(corner[1][t]), in_box(corner[2][t])}));
  sum_up(cells);
}

std::array<double, 9> face_integrals(const ClippedCells::FaceMoments& moments) {
  // Coefficients of 1, z, z^2 of the three splines on a cell.
  constexpr double spline[3][3] = {{0.125, -0.5, 0.5}, {0.75, 0, -1}, {0.125, 0.5, 0.5}};
  std::array<double, 9> integral{};
  for (std::size_t w = 0; w < 3; ++w)
    for (std::size_t u = 0; u < 3; ++u)
      for (std::size_t b = 0; b < 3; ++b)
        for (std::size_t a = 0; a < 3; ++a) integral[u + 3 * w] += spline[u][a] * spline[w][b] * moments[a + 3 * b];
  return integral;
}

}  // namespace geodrop
