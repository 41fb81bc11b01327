#include "stretches.hpp"

#include <algorithm>
#include <cmath>

#include "cell_slopes.hpp"
#include "cells_around.hpp"
#include "clipped_cells.hpp"
#include "cut_cells.hpp"
#include "membrane/outline.hpp"
#include "outline_pieces.hpp"
#include "wet_cells.hpp"

namespace geodrop {
namespace {

/// Shorter stretches than this join the next one: a corner of a cell pins no pressure down [cells].
constexpr double least_length = 0.25;

}  // namespace

double length_of(const Membrane<2>& membrane, const CutCells::Piece& piece) {
  return (piece.to - piece.from) * segment_length(membrane, static_cast<std::size_t>(piece.edge));
}

double cells_along(const GridLayout<2>& layout, const Membrane<2>& membrane, const CutCells& cells,
                   const CutCells::Piece& piece) {
  const auto [across, up] = spans_of(layout, flat_of(layout, cells, piece.cell));
  if (across.width == up.width) return length_of(membrane, piece) / across.width;
  const auto from = static_cast<std::size_t>(piece.edge), to = end_of_edge(from, membrane.nodes());
  const auto& [x, y] = membrane.x;
  return (piece.to - piece.from) * std::hypot((x[to] - x[from]) / across.width, (y[to] - y[from]) / up.width);
}

namespace {

/// Whether the end of a fold of empty cloth: both flanks and the end between them, within a cell and close together.
bool ends_fold(const Membrane<2>& membrane, const CutCells& cells, const Stretch& stretch, double width) {
  constexpr double opposed = 0.3, thin = 0.2;
  double across_x = 0, across_y = 0;
  for_each_piece(cells, stretch, [&](const CutCells::Piece& piece) {
    const auto from = static_cast<std::size_t>(piece.edge), to = end_of_edge(from, membrane.nodes());
    across_x += (piece.to - piece.from) * (membrane.x[0][to] - membrane.x[0][from]);
    across_y += (piece.to - piece.from) * (membrane.x[1][to] - membrane.x[1][from]);
  });
  return std::hypot(across_x, across_y) < std::min(opposed * stretch.size, thin * width);
}

}  // namespace

std::vector<Stretch> stretches_of(const Grid<2>& around, const Membrane<2>& membrane, const CutCells& cells) {
  const auto& pieces = cells.pieces;
  const std::size_t n = pieces.size();
  const auto wet = [&](std::size_t k) { return is_wet(around, flat_of(around.layout, cells, pieces[k].cell)); };
  std::size_t start = 0;  // where a cell begins
  while (start + 1 < n && pieces[start].cell == pieces[(start + n - 1) % n].cell) ++start;
  std::vector<Stretch> stretches;
  bool open = false;       // the last stretch goes on
  double last_length = 0;  // its length [cells]
  for (std::size_t k = 0; k < n;) {
    const std::size_t at = (start + k) % n;
    Stretch visit{at, 0, 0};
    double length = 0;  // [cells]
    for (; k < n && pieces[(start + k) % n].cell == pieces[at].cell; ++k, ++visit.count) {
      visit.size += length_of(membrane, pieces[(start + k) % n]);
      length += cells_along(around.layout, membrane, cells, pieces[(start + k) % n]);
    }
    const double width = least_width(around.layout, flat_of(around.layout, cells, pieces[at].cell));
    visit.wet = wet(at);
    if ((!visit.wet && membrane.pore_pressure.empty()) || ends_fold(membrane, cells, visit, width)) {
      open = false;
      continue;
    }
    if (open && visit.wet == stretches.back().wet && (length < least_length || last_length < least_length)) {
      stretches.back().count += visit.count;
      stretches.back().size += visit.size;
      last_length += length;
    } else {
      stretches.push_back(visit);
      last_length = length;
    }
    open = true;
  }
  return stretches;
}

std::vector<Stretch> stretches_of(const Grid<3>& around, const Membrane<3>& membrane, const ClippedSurface& cells) {
  const double h2 = around.layout.h * around.layout.h;
  std::vector<Stretch> stretches;
  for (const ClippedSurface::Patch& patch : cells.patches) {
    const bool wet = is_wet(around, flat_of(around.layout, cells, cells.flanks[patch.first_flank].cell));
    if (wet || !membrane.pore_pressure.empty())
      stretches.push_back({patch.first_flank, patch.flanks, patch.area * h2, wet});
  }
  return stretches;
}

std::vector<NodeVector<2>> normals_over(const GridLayout<2>& layout, const Membrane<2>& membrane, const CutCells& cells,
                                        const Stretch& stretch) {
  std::vector<NodeVector<2>> out;
  out.reserve(9 * stretch.count);
  for_each_piece(cells, stretch, [&](const CutCells::Piece& piece) {
    const PieceIntegral integral = integrate_piece(layout, membrane, cells, piece);
    const auto [nx, ny] = integral.normal;
    const int flat = flat_of(layout, cells, piece.cell);
    for (int n = 0; n < 9; ++n)
      out.push_back({node_around(layout, flat, n), {integral.mean[n] * nx, integral.mean[n] * ny}});
  });
  return out;
}

std::vector<NodeVector<3>> normals_over(const GridLayout<3>& layout, const ClippedSurface& cells,
                                        const Stretch& stretch) {
  const double h2 = layout.h * layout.h;
  std::vector<NodeVector<3>> out;
  for (std::size_t k = stretch.first; k < stretch.first + stretch.count; ++k) {
    const ClippedSurface::Flank& flank = cells.flanks[k];
    const int flat = flat_of(layout, cells, flank.cell);
    Slope<3> spline = flank.spline;
    fold_at_walls(layout, flat, spline);
    const bool far = far_from_walls<3>(layout, 1, stored_cell(layout, flat));
    for (int n = 0; n < 27; ++n) {
      const auto& [x, y, z] = spline[n];
      if (!far && x == 0 && y == 0 && z == 0) continue;  // beyond a wall, where no field has a mass
      out.push_back({node_around(layout, flat, n), {h2 * x, h2 * y, h2 * z}});
    }
  }
  if (stretch.count > 1) add_up_by_node(out);  // flanks of a patch have nodes in common
  return out;
}

}  // namespace geodrop
