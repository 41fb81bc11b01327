#include "keep_sides.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <type_traits>
#include <vector>

#include "cells_around.hpp"
#include "cut_cells.hpp"
#include "geometry/polygon.hpp"
#include "near_triangles.hpp"

namespace geodrop {
namespace {

/// The edges of a membrane, and those near each cell of the box around its outline.
class NearEdges {
 public:
  NearEdges(const GridLayout<2>& layout, const Membrane<2>& membrane, const CutCells& cells)
      : layout_(layout), membrane_(membrane), cells_(cells), begin_(cells.size() + 1, 0) {
    for_each_near([&](int cell, int) { ++begin_[cell + 1]; });
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    edges_.resize(begin_.back());
    std::vector<int> at(begin_.begin(), begin_.end() - 1);
    for_each_near([&](int cell, int edge) { edges_[at[cell]++] = edge; });
  }

  /// Where a point is to go that should be inside, or else outside; itself if it is there.
  Vec<2> on_side(const Vec<2>& x, bool inside) const {
    constexpr double distance = 1e-3;     // from the membrane [h]
    constexpr double least_share = 1e-6;  // of it
    const int cell = local_cell(layout_, cells_, x[0], x[1]);
    if (cell < 0) return x;
    const Nearest nearest = nearest_to(x, cell);
    if (nearest.edge < 0 || is_inside(x, nearest) == inside) return x;
    const Vec<2> way = (inside ? -1 : 1) * distance * layout_.finest * normal_at(nearest);
    Vec<2> to = nearest.point + way;
    // Near the edge of a fold narrower than a right angle the whole way leads through the other flank.
    for (double share = 0.5; share > least_share && is_inside(to, nearest_to(to, cell)) != inside; share /= 2)
      to = nearest.point + share * way;
    return to;
  }

 private:
  struct Nearest {
    int edge = -1;
    double share = 0;  ///< of the edge
    double square = std::numeric_limits<double>::infinity();
    Vec<2> point;
  };

  Vec<2> node(std::size_t k) const { return {membrane_.x[0][k], membrane_.x[1][k]}; }

  /// f(cell, edge) for the edges in a cell or beside it; those of a cell in the order of the outline.
  template <class F>
  void for_each_near(F&& f) const {
    std::vector<int> last(cells_.size(), -1);
    for (const CutCells::Piece& piece : cells_.pieces)
      for (int n = 0; n < 9; ++n) {
        const int cell = local_around(cells_, piece.cell, n);
        if (last[cell] == piece.edge) continue;
        last[cell] = piece.edge;
        f(cell, piece.edge);
      }
  }

  Nearest nearest_to(const Vec<2>& x, int cell) const {
    Nearest nearest;
    for (int k = begin_[cell]; k < begin_[cell + 1]; ++k) look_at(edges_[k], x, nearest);
    return nearest;
  }
  bool is_inside(const Vec<2>& x, const Nearest& nearest) const {
    return (x - nearest.point).dot(normal_at(nearest)) < 0;
  }

  void look_at(int edge, const Vec<2>& x, Nearest& nearest) const {
    const Vec<2> from = node(edge), along = node(end_of_edge(edge, membrane_.nodes())) - from;
    const double square = along.squaredNorm();
    const double share = square > 0 ? std::clamp((x - from).dot(along) / square, 0.0, 1.0) : 0.0;
    const Vec<2> point = from + share * along;
    const double distance = (x - point).squaredNorm();
    if (distance < nearest.square) nearest = {edge, share, distance, point};
  }

  /// Outward unit normal of an edge.
  Vec<2> normal_of(std::size_t edge) const {
    const Vec<2> along = node(end_of_edge(edge, membrane_.nodes())) - node(edge);
    return cells_.sense * Vec<2>(along[1], -along[0]).normalized();
  }
  /// At a node, the mean of both edges: it tells sides apart there.
  Vec<2> normal_at(const Nearest& nearest) const {
    const std::size_t edge = nearest.edge, n = membrane_.nodes();
    if (nearest.share > 0 && nearest.share < 1) return normal_of(edge);
    const std::size_t other = nearest.share >= 1 ? end_of_edge(edge, n) : (edge + n - 1) % n;
    return (normal_of(edge) + normal_of(other)).normalized();
  }

  const GridLayout<2>& layout_;
  const Membrane<2>& membrane_;
  const CutCells& cells_;
  std::vector<int> begin_, edges_;  ///< of each cell: edges_[begin_[cell]] to edges_[begin_[cell + 1] - 1]
};

/// Particles of a body in cells of the box that it shares.
template <int Dim, class Near>
void keep_body(const Grid<Dim>& grid, const BoxOfCells<Dim>& box, const Near& surface, bool inside, Body<Dim>& body) {
  const auto n = static_cast<std::ptrdiff_t>(body.size());
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t p = 0; p < n; ++p) {
    if (!box.may_hold(body.x, p) || grid.taken[cell_at(grid.layout, body.x, p)] <= 0) continue;
    const Vec<Dim> to = surface.on_side(vector_at(body.x, p), inside);
    for (int a = 0; a < Dim; ++a) body.x[a][p] = to[a];
  }
}

}  // namespace

template <int Dim>
void keep_sides(State<Dim>& state, const Grids<Dim>& grids) {
  using Near = std::conditional_t<Dim == 2, NearEdges, NearTriangles>;
  if (!std::isfinite(state.drift)) return;  // a particle is lost, perhaps off the grid: the next sort reports it
  for (const Membrane<Dim>& membrane : state.membranes) {
    if (!acts_sharply(membrane)) continue;
    const Outline<Dim>& outline = grids[membrane.field].outline;
    const Near surface(grids.front().layout, membrane, outline);
    const BoxOfCells<Dim> box(grids.front().layout, outline);
    const int water = grids[membrane.field].pore_water;
    for (Body<Dim>& body : state.bodies)
      if (body.field != waiting && (body.field == membrane.field || body.field == 0 || body.field == water))
        keep_body(grids[body.field], box, surface, body.field != 0, body);
  }
}

template void keep_sides(State<2>&, const Grids<2>&);
template void keep_sides(State<3>&, const Grids<3>&);

}  // namespace geodrop
