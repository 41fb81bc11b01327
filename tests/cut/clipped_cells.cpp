// Cells clipped by triangles: shares, faces and pieces fit together to round-off.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "cut/cells_around.hpp"
#include "cut/clipped_cells.hpp"
#include "membrane/triangles.hpp"
#include "support/near.hpp"
#include "support/surfaces.hpp"

using namespace geodrop;
using namespace geodrop::test;

TEST_CASE("Shares of cells add up to the volume inside; pieces to the triangles") {
  for (const GridLayout<3>& layout : even_and_graded())
    for (const TriangleSurface& surface : surfaces()) {
      const Membrane<3> membrane = membrane_of(surface);
      ClippedCells cells;
      clip_cells(layout, membrane, cells);
      double sum = 0;
      for (std::size_t c = 0; c < cells.size(); ++c)
        sum += cells.inside[c] * cell_size(layout, flat_of(layout, cells, static_cast<int>(c)));
      CHECK(sum == near(volume(surface), 1e-13));
      Array<double> shares(surface.triangles.size(), 0.0);
      for (const ClippedCells::Piece& piece : cells.pieces)
        for (const double share : piece.share) {
          shares[piece.triangle] += share;
          CHECK(share > -1e-12);
        }
      for (std::size_t t = 0; t < shares.size(); ++t)
        if (normal_of(membrane, t).norm() > 0) CHECK(shares[t] == near(1.0, 1e-10));
    }
}

namespace {

/// Of the faces and pieces of a cell: sum n = 0, and sum x n = V (identity), by the divergence theorem.
void check_closed(const GridLayout<3>& layout, const Membrane<3>& membrane) {
  ClippedCells cells;
  clip_cells(layout, membrane, cells);
  const std::array<int, 3> stride{1, cells.count[0], cells.count[0] * cells.count[1]};
  std::vector<Eigen::Matrix3d> moment(cells.size(), Eigen::Matrix3d::Zero());
  std::vector<Vec<3>> normal(cells.size(), Vec<3>::Zero());
  std::vector<bool> cut(cells.size(), false);
  const auto middle = [&](int c) {
    Vec<3> x;
    for (int a = 0; a < 3; ++a)
      x[a] = layout.node(a, cells.first[a] - GridLayout<3>::pad + c / stride[a] % cells.count[a]);
    return x;
  };
  for (const ClippedCells::Piece& piece : cells.pieces) {
    const Vec<3> area = 0.5 * normal_of(membrane, piece.triangle);
    cut[piece.cell] = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec<3> x = vector_at(membrane.x, membrane.triangles.corner[k][piece.triangle]) - middle(piece.cell);
      normal[piece.cell] += piece.share[k] * area;
      moment[piece.cell] += piece.share[k] * x * area.transpose();
    }
  }
  for (int c = 0; c < static_cast<int>(cells.size()); ++c) {
    if (!cut[c]) continue;
    const int flat = flat_of(layout, cells, c);
    const CellSpans<3> spans = spans_of(layout, flat);
    for (int a = 0; a < 3; ++a)
      for (const double side : {0.5, -0.5}) {
        const int u = (a + 1) % 3, w = (a + 2) % 3;
        const ClippedCells::FaceMoments& m = cells.upper_face[a][side > 0 ? c : c - stride[a]];
        const double area = (side > 0 ? 1 : -1) * spans[u].width * spans[w].width;
        normal[c][a] += area * m[0];
        moment[c](a, a) += area * side * spans[a].width * m[0];
        moment[c](u, a) += area * spans[u].width * m[1];
        moment[c](w, a) += area * spans[w].width * m[3];
      }
    CHECK(normal[c].norm() < 1e-13);
    CHECK((moment[c] - cell_size(layout, flat) * cells.inside[c] * Eigen::Matrix3d::Identity()).norm() < 1e-13);
  }
}

}  // namespace

TEST_CASE("What lies inside a cell is closed: faces and pieces have no resultant, and the moment of its volume") {
  // The shares come from one axis, the faces from three, and the pieces from the triangles: this ties them to each
  // other.
  for (const GridLayout<3>& layout : even_and_graded())
    for (const TriangleSurface& surface : surfaces()) check_closed(layout, membrane_of(surface));
}

TEST_CASE("A face inside as a whole has the moments of a square") {
  const GridLayout<3> layout = small_grid(0.25);
  ClippedCells cells;
  clip_cells(layout, membrane_of(surfaces()[0]), cells);
  const ClippedCells::FaceMoments square{1, 0, 1.0 / 12, 0, 0, 0, 1.0 / 12, 0, 1.0 / 144};
  int whole = 0;
  for (const auto& faces : cells.upper_face)
    for (const ClippedCells::FaceMoments& m : faces) {
      if (m[0] < 1 - 1e-12) continue;
      ++whole;
      for (std::size_t k = 0; k < m.size(); ++k) CHECK(std::abs(m[k] - square[k]) < 1e-13);
    }
  CHECK(whole > 300);
}

TEST_CASE("Faces that an upright box covers in part have the moments of rectangles") {
  const std::array<std::array<double, 2>, 3> box{{{-0.3, 0.33}, {-0.2, 0.41}, {-0.1, 0.27}}};
  TriangleSurface surface;
  for (int k = 0; k < 8; ++k) surface.points.push_back({box[0][k % 2], box[1][k / 2 % 2], box[2][k / 4]});
  surface.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                       {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  REQUIRE(fault_of(surface).empty());
  const GridLayout<3> layout = small_grid(0.25);
  ClippedCells cells;
  clip_cells(layout, membrane_of(surface), cells);
  const std::array<int, 3> stride{1, cells.count[0], cells.count[0] * cells.count[1]};
  const auto middle = [&](int a, int c) {
    return layout.node(a, cells.first[a] - GridLayout<3>::pad + c / stride[a] % cells.count[a]);
  };
  /// int z^power over what of a cell lies between the sides of the box along an axis.
  const auto integral = [&](int a, int c, int power) {
    const auto place = [&](double x) { return std::clamp((x - middle(a, c)) / layout.h, -0.5, 0.5); };
    return (std::pow(place(box[a][1]), power + 1) - std::pow(place(box[a][0]), power + 1)) / (power + 1);
  };
  for (int a = 0; a < 3; ++a)
    for (int c = 0; c < static_cast<int>(cells.size()); ++c) {
      const double level = middle(a, c) + layout.h / 2;
      const bool inside = level > box[a][0] && level < box[a][1];
      for (int m = 0; m < 9; ++m) {
        const double exact = inside ? integral((a + 1) % 3, c, m % 3) * integral((a + 2) % 3, c, m / 3) : 0.0;
        CHECK(std::abs(cells.upper_face[a][c][m] - exact) < 1e-14);
      }
    }
}

TEST_CASE("Splines over a whole face add up to its area, and a half face to those of the half line") {
  ClippedCells::FaceMoments whole{1, 0, 1.0 / 12, 0, 0, 0, 1.0 / 12, 0, 1.0 / 144};
  double sum = 0;
  for (const double each : face_integrals(whole)) sum += each;
  CHECK(sum == near(1.0, 1e-15));
  CHECK(face_integrals(whole)[4] == near(4.0 / 9, 1e-14));  // (2/3)^2
  CHECK(face_integrals(whole)[0] == near(1.0 / 36, 1e-14));
  // 0 < u < 1/2: 1, u, u^2 integrate to 1/2, 1/8, 1/24; the spline above to 7/48, the middle one to 1/3, below 1/48.
  const ClippedCells::FaceMoments half{0.5, 0.125, 1.0 / 24, 0, 0, 0, 1.0 / 24, 1.0 / 96, 1.0 / 288};
  CHECK(face_integrals(half)[5] == near(7.0 / 48 * 2 / 3, 1e-14));
  CHECK(face_integrals(half)[4] == near(1.0 / 3 * 2 / 3, 1e-14));
  CHECK(face_integrals(half)[3] == near(1.0 / 48 * 2 / 3, 1e-14));
}
