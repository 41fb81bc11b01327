// Integrals over the pieces of an outline, each within one cell.
#pragma once

#include <geodrop/grid.hpp>
#include <geodrop/state.hpp>

#include <array>
#include <cmath>

#include "../kernels/bases.hpp"
#include "../membrane/cut_cells.hpp"
#include "../membrane/polygon.hpp"

namespace geodrop {

/// int N of the three nodes along an axis, from the lower face of the cell to u [h]; u from -1/2 to 1/2.
inline std::array<double, 3> integrals_to(double u) {
  const double below = 0.5 - u, above = 0.5 + u;
  const double first = (1 - below * below * below) / 6, last = above * above * above / 6;
  return {first, above - first - last, last};  // the three add up to one
}

struct PieceIntegral {
  std::array<double, 9> mean{};    ///< of N of the 3 x 3 nodes around the cell, x fastest [-]
  std::array<double, 9> beside{};  ///< of the integral of N along x from the cell's left face to the piece [h]
  std::array<double, 2> normal{};  ///< outward, as long as the piece [m]
};

/// Three Gauss points are exact: N is of degree four along a straight line, its integral along x of degree five.
inline PieceIntegral integrate_piece(const GridLayout<2>& layout, const Membrane<2>& membrane, const CutCells& cells,
                                     const CutCells::Piece& piece) {
  const auto& [x, y] = membrane.x;
  const std::size_t from = piece.edge, to = end_of_edge(from, membrane.nodes());
  const double dx = x[to] - x[from], dy = y[to] - y[from], part = piece.to - piece.from;
  const std::array<double, 2> centre = {layout.node(0, cells.first[0] + piece.cell % cells.count[0] - layout.pad),
                                        layout.node(1, cells.first[1] + piece.cell / cells.count[0] - layout.pad)};
  PieceIntegral out;
  out.normal = {cells.sense * part * dy, -cells.sense * part * dx};
  constexpr double offset[] = {-0.7745966692414834, 0, 0.7745966692414834}, weight[] = {5.0 / 18, 4.0 / 9, 5.0 / 18};
  for (int g = 0; g < 3; ++g) {
    const double share = piece.from + 0.5 * (1 + offset[g]) * part;
    const double across = (x[from] + share * dx - centre[0]) * layout.inv_h;
    const ThreeWeights u = Bspline2::at(across, 0);
    const std::array<double, 3> left = integrals_to(across);
    const ThreeWeights v = Bspline2::at((y[from] + share * dy - centre[1]) * layout.inv_h, 0);
    const double along_x[] = {u.w0, u.w1, u.w2}, along_y[] = {v.w0, v.w1, v.w2};
    for (int n = 0; n < 9; ++n) {
      out.mean[n] += weight[g] * along_x[n % 3] * along_y[n / 3];
      out.beside[n] += weight[g] * left[n % 3] * along_y[n / 3];
    }
  }
  return out;
}

/// Whether a membrane is there and has a sharp interface.
inline bool acts_sharply(const Membrane<2>& membrane) { return membrane.sharp && membrane.field != waiting; }

/// Flat index of node n of the 3 x 3 around a cell.
inline int node_around(const GridLayout<2>& layout, int flat, int n) {
  return flat + n % 3 - 1 + (n / 3 - 1) * layout.stride[1];
}

}  // namespace geodrop
