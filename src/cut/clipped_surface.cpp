#include "clipped_surface.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

#include "cells_around.hpp"
#include "clip_pieces.hpp"
#include "clipped_cells.hpp"
#include "geometry/corner.hpp"
#include "geometry/surface_ends.hpp"

namespace geodrop {
namespace {

using Flank = ClippedSurface::Flank;

/// Smaller flanks join another one [face of a cell].
constexpr double least_area = 0.25;

/// Exact for polynomials of degree 7, twelve points (Gatermann 1988): three turns of four.
constexpr std::array<TrianglePoint, 4> degree_7{
    {{{0.06238226509439084, 0.06751786707392436, 0.8700998678316848}, 0.05303405631486900},
     {{0.05522545665692000, 0.3215024938520156, 0.6232720494910644}, 0.08776281742889622},
     {{0.03432430294509488, 0.6609491961867980, 0.3047265008681072}, 0.05755008556995056},
     {{0.5158423343536001, 0.2777161669764050, 0.2064414986699949}, 0.13498637401961758}}};

/// Moments int u^a v^b w^c dA of a piece [h2], at 9 a + b + 3 c; u, v, w from the middle of its cell [its widths].
constexpr std::size_t moment_count = 36;

struct RawPiece {
  ClippedCells::Piece piece;
  double area, faces;
  std::array<double, 3> normal;  ///< unit
  std::array<double, moment_count> moments;
};

void add_point(const Vec<3>& z, double weight, std::array<double, moment_count>& moments) {
  const std::array<double, 4> u{weight, weight * z[0], weight * z[0] * z[0], weight * z[0] * z[0] * z[0]};
  const std::array<double, 3> v{1, z[1], z[1] * z[1]}, w{1, z[2], z[2] * z[2]};
  std::array<double, 9> across;
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t b = 0; b < 3; ++b) across[b + 3 * c] = v[b] * w[c];
  for (std::size_t a = 0; a < 4; ++a)
    for (std::size_t k = 0; k < 9; ++k) moments[9 * a + k] += u[a] * across[k];
}

void add_triangle(std::uint32_t triangle, const Facet& facet, const ClippedCells& cells, std::vector<RawPiece>& out) {
  const double size = facet.normal.norm();
  if (!(size > 0)) return;
  const Vec<3> unit = facet.normal / size;
  for_each_piece_of(facet, cells, [&](int c, const BoxCell& cell, const ConvexPiece& piece) {
    RawPiece& raw = out.emplace_back(RawPiece{{c, triangle, {}}, 0, 0, {unit[0], unit[1], unit[2]}, {}});
    raw.piece.share = for_each_fan(facet, size, piece, [&](const std::array<Vec<3>, 3>& fan, double area) {
      raw.area += area;
      for (const TrianglePoint& q : degree_7)
        for (std::size_t turn = 0; turn < 3; ++turn) {
          const Vec<3> x = q.share[0] * fan[turn] + q.share[1] * fan[(turn + 1) % 3] + q.share[2] * fan[(turn + 2) % 3];
          add_point(cell.place_of(x), q.weight * area, raw.moments);
        }
    });
    raw.faces = cell.faces_of(raw.area, unit);
  });
}

/// All pieces, in the order of the triangles.
std::vector<RawPiece> cut_triangles(const GridLayout<3>& layout, const Membrane<3>& membrane,
                                    const ClippedCells& cells) {
  constexpr std::size_t chunk = 128;  // triangles
  const std::size_t triangles = membrane.triangles.size();
  const auto chunks = static_cast<std::ptrdiff_t>((triangles + chunk - 1) / chunk);
  std::vector<std::vector<RawPiece>> parts(chunks);
#pragma omp parallel for schedule(dynamic)
  for (std::ptrdiff_t k = 0; k < chunks; ++k) {
    const std::size_t begin = k * chunk, end = std::min(begin + chunk, triangles);
    parts[k].reserve(4 * chunk);
    for (std::size_t t = begin; t < end; ++t)
      add_triangle(static_cast<std::uint32_t>(t), facet_of(layout, membrane, cells, t), cells, parts[k]);
  }
  std::vector<RawPiece> all;
  all.reserve(std::accumulate(parts.begin(), parts.end(), std::size_t{0},
                              [](std::size_t n, const auto& part) { return n + part.size(); }));
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

/// The pieces of each cell that has any.
struct Sorted {
  std::vector<std::uint32_t> order;  ///< pieces cell by cell, in the order of the triangles
  std::vector<std::uint32_t> begin;  ///< of each such cell in `order`, and its end
};

Sorted sort_by_cell(const std::vector<RawPiece>& pieces) {
  Sorted out;
  out.order.resize(pieces.size());
  std::iota(out.order.begin(), out.order.end(), 0U);
  std::stable_sort(out.order.begin(), out.order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return pieces[a].piece.cell < pieces[b].piece.cell; });
  for (std::uint32_t k = 0; k < out.order.size(); ++k)
    if (k == 0 || pieces[out.order[k]].piece.cell != pieces[out.order[k - 1]].piece.cell) out.begin.push_back(k);
  out.begin.push_back(static_cast<std::uint32_t>(out.order.size()));
  return out;
}

/// int u^a v^b w^c n dA of a flank [h2].
struct FlankSums {
  double area = 0, faces = 0;
  std::array<std::array<double, moment_count>, 3> moments{};

  void add(const RawPiece& piece) {
    area += piece.area;
    faces += piece.faces;
    for (std::size_t d = 0; d < 3; ++d)
      for (std::size_t k = 0; k < moment_count; ++k) moments[d][k] += piece.normal[d] * piece.moments[k];
  }
};

/// What a flank projects to the faces of its cell, and its part of the cell; sum_beyond_faces does the rest.
void add_to_cell(const FlankSums& sums, const BoxCell& cell, int c, ClippedCells& cells) {
  const auto& [x, y, z] = sums.moments;
  const double across_x = cell.per_face[0], across_y = cell.per_face[1], across_z = cell.per_face[2];
  cells.inside[c] += across_x * (x[9] + 0.5 * x[0]);
  for (std::size_t b = 0; b < 3; ++b)
    for (std::size_t a = 0; a < 3; ++a) {
      cells.upper_face[0][c][a + 3 * b] += across_x * x[a + 3 * b];      // y, z
      cells.upper_face[1][c][a + 3 * b] += across_y * y[9 * b + 3 * a];  // z, x
      cells.upper_face[2][c][a + 3 * b] += across_z * z[9 * a + b];      // x, y
    }
}

/// Sums over powers of u, v, w of what the splines of the nodes around have of them, times the moments.
template <std::size_t count>
std::array<double, 27> of_nodes(const std::array<double, moment_count>& moments,
                                const std::array<std::array<double, count>, 3>& of_u, const SplinePowers& of_v,
                                const SplinePowers& of_w) {
  std::array<double, 27> out{};
  for (std::size_t i = 0; i < 3; ++i) {
    std::array<double, 9> along_u{}, along_v{};
    for (std::size_t a = 0; a < count; ++a)
      for (std::size_t k = 0; k < 9; ++k) along_u[k] += of_u[i][a] * moments[9 * a + k];
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t b = 0; b < 3; ++b) along_v[j + 3 * c] += of_v[j][b] * along_u[b + 3 * c];
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t c = 0; c < 3; ++c) out[i + 3 * j + 9 * k] += of_w[k][c] * along_v[j + 3 * c];
  }
  return out;
}

/// Coefficients of 1, z, z^2, z^3 of int N dz from the lower side of a span, z from -1/2 to 1/2.
std::array<std::array<double, 4>, 3> integral_powers(const SpanShape& span) {
  if (span.part != SpanShape::Part::whole) {
    const SplinePowers powers = spline_powers(span);
    std::array<std::array<double, 4>, 3> of_part;
    for (std::size_t n = 0; n < 3; ++n) {
      const auto& [constant, linear, square] = powers[n];
      of_part[n] = {constant / 2 - linear / 8 + square / 24, constant, linear / 2, square / 3};
    }
    return of_part;
  }
  const double below = span.below, above = span.above;
  return {{{7 * below / 24, below / 4, -below / 2, below / 3},
           {(12 - 7 * below - above) / 24, 1 - (below + above) / 4, (below - above) / 2, -(below + above) / 3},
           {above / 24, above / 4, above / 2, above / 3}}};
}

void integrate_splines(const FlankSums& sums, const CellSpans<3>& span, double width, Flank& flank) {
  const SplinePowers of_x = spline_powers(span[0]), of_y = spline_powers(span[1]), of_z = spline_powers(span[2]);
  flank.area = sums.area;
  flank.faces = sums.faces;
  for (std::size_t d = 0; d < 3; ++d) {
    flank.normal[d] = sums.moments[d][0];
    const auto of_component = of_nodes(sums.moments[d], of_x, of_y, of_z);
    for (std::size_t n = 0; n < 27; ++n) flank.spline[n][d] = of_component[n];
  }
  flank.beside = of_nodes(sums.moments[0], integral_powers(span[0]), of_y, of_z);
  for (double& beside : flank.beside) beside *= width;
}

/// Parts the pieces of a cell, which stand from begin to end, by the way that they face: with the largest or against
/// it. What begins the second flank.
std::uint32_t part_flanks(const std::vector<RawPiece>& pieces, std::uint32_t* begin, std::uint32_t* end) {
  const std::uint32_t largest =
      *std::max_element(begin, end, [&](std::uint32_t a, std::uint32_t b) { return pieces[a].area < pieces[b].area; });
  const std::array<double, 3> way = pieces[largest].normal;
  std::uint32_t* const second =
      std::stable_partition(begin, end, [&](std::uint32_t k) { return dot(pieces[k].normal, way) >= 0; });
  return static_cast<std::uint32_t>(second - begin);
}

/// The flanks of all cells, cell by cell, their pieces numbered as in `sorted`; fills shares and faces.
std::vector<Flank> add_up(const GridLayout<3>& layout, const std::vector<RawPiece>& pieces, Sorted& sorted,
                          ClippedSurface& cells) {
  const auto count = static_cast<std::ptrdiff_t>(sorted.begin.size()) - 1;
  std::vector<std::array<Flank, 2>> pairs(count);
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t k = 0; k < count; ++k) {
    const std::uint32_t begin = sorted.begin[k], end = sorted.begin[k + 1];
    const std::uint32_t second = begin + part_flanks(pieces, &sorted.order[begin], sorted.order.data() + end);
    const std::array<std::uint32_t, 3> ends{begin, second, end};
    for (std::size_t side = 0; side < 2; ++side) {
      Flank& flank = pairs[k][side];
      flank.cell = pieces[sorted.order[begin]].piece.cell;
      flank.first_piece = ends[side];
      flank.pieces = ends[side + 1] - ends[side];
      FlankSums sums;
      for (std::uint32_t p = ends[side]; p < ends[side + 1]; ++p) sums.add(pieces[sorted.order[p]]);
      if (flank.pieces == 0) continue;
      const BoxCell cell(cells, flank.cell);
      integrate_splines(sums, spans_in_domain(layout, flat_of(layout, cells, flank.cell)), cell.width[0], flank);
      add_to_cell(sums, cell, flank.cell, cells);
    }
  }
  std::vector<Flank> flanks;
  flanks.reserve(pairs.size());
  for (const auto& pair : pairs)
    for (const Flank& flank : pair)
      if (flank.pieces > 0) flanks.push_back(flank);
  return flanks;
}

/// The flank that each joins, perhaps itself.
std::vector<std::uint32_t> find_hosts(const std::vector<Flank>& flanks, const ClippedCells& cells) {
  std::vector<std::uint32_t> first(cells.size(), static_cast<std::uint32_t>(flanks.size()));  // of a cell
  for (std::uint32_t k = static_cast<std::uint32_t>(flanks.size()); k-- > 0;) first[flanks[k].cell] = k;
  std::vector<std::uint32_t> host(flanks.size());
  for (std::uint32_t k = 0; k < flanks.size(); ++k) {
    host[k] = k;
    if (flanks[k].faces >= least_area) continue;
    double most = 0;
    for (int n = 0; n < 27; ++n) {  // the box has a cell to spare on all sides
      const int cell = flanks[k].cell + n % 3 - 1 + cells.count[0] * (n / 3 % 3 - 1 + cells.count[1] * (n / 9 - 1));
      for (std::uint32_t other = first[cell]; other < flanks.size() && flanks[other].cell == cell; ++other)
        if (flanks[other].faces >= least_area && dot(flanks[k].normal, flanks[other].normal) > most) {
          most = dot(flanks[k].normal, flanks[other].normal);
          host[k] = other;
        }
    }
  }
  return host;
}

/// Flanks patch by patch, and their pieces flank by flank.
void make_patches(const std::vector<RawPiece>& pieces, const Sorted& sorted, const std::vector<Flank>& flanks,
                  ClippedSurface& cells) {
  const std::vector<std::uint32_t> host = find_hosts(flanks, cells);
  std::vector<std::uint32_t> order(flanks.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(host[a], host[a] != a) < std::pair(host[b], host[b] != b);
  });
  cells.flanks.clear();
  cells.patches.clear();
  cells.pieces.clear();
  for (const std::uint32_t k : order) {
    if (host[k] == k) cells.patches.push_back({static_cast<std::uint32_t>(cells.flanks.size()), 0, 0});
    Flank& flank = cells.flanks.emplace_back(flanks[k]);
    flank.first_piece = static_cast<std::uint32_t>(cells.pieces.size());
    for (std::uint32_t p = 0; p < flank.pieces; ++p)
      cells.pieces.push_back(pieces[sorted.order[flanks[k].first_piece + p]].piece);
    ++cells.patches.back().flanks;
    cells.patches.back().area += flank.area;
  }
}

/// Closes the surface beyond the upper walls at which it ends, from where all that lies below is counted: by a fan over
/// its open edges, as far across the axis as the wall and half a cell beyond it.
void add_fans(const GridLayout<3>& layout, const Membrane<3>& membrane, ClippedCells& cells) {
  const auto& [from, to, walls] = membrane.triangles.open_edge;
  std::vector<RawPiece> pieces;
  std::vector<SurfaceEnd> ends;
  for (const std::uint32_t wall : walls) ends.push_back(end_at(layout, wall));
  const auto place_of = [&](std::uint32_t node) {
    return Corner{membrane.x[0][node], membrane.x[1][node], membrane.x[2][node]};
  };
  for (std::size_t e = 0, first = 0; e < walls.size(); ++e) {
    if (walls[e] != walls[first]) first = e;
    if (!ends[e].upper) continue;
    std::array<Vec<3>, 3> corners{place_in(layout, cells, place_of(to[e])), place_in(layout, cells, place_of(from[e])),
                                  place_in(layout, cells, middle_of_fan(ends, ends[e], place_of(from[first])))};
    const double beyond = plane_on_wall(layout, ends[e], cells);
    for (Vec<3>& x : corners) x[ends[e].axis] = beyond + 0.5;
    add_triangle(0, Facet(corners), cells, pieces);
  }
  for (const RawPiece& piece : pieces) {
    FlankSums sums;
    sums.add(piece);
    add_to_cell(sums, BoxCell(cells, piece.piece.cell), piece.piece.cell, cells);
  }
}

}  // namespace

void clip_surface(const GridLayout<3>& layout, const Membrane<3>& membrane, ClippedSurface& cells) {
  place_box(layout, membrane, cells);
  const std::vector<RawPiece> pieces = cut_triangles(layout, membrane, cells);
  Sorted sorted = sort_by_cell(pieces);
  const std::vector<Flank> flanks = add_up(layout, pieces, sorted, cells);
  make_patches(pieces, sorted, flanks, cells);
  add_fans(layout, membrane, cells);
  sum_beyond_faces(cells);
}

}  // namespace geodrop
