#include "keep_sides.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <type_traits>
#include <vector>

#include "cells_around.hpp"
#include "cut_cells.hpp"
#include "geometry/polygon.hpp"
#include "grid/neighbourhood.hpp"
#include "grid/point_support.hpp"
#include "grid/within_walls.hpp"
#include "near_triangles.hpp"
#include "right_side.hpp"
#include "wet_cells.hpp"

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
    constexpr double safely = 1 + 1e-9;  // against round-off
    for (std::size_t k = 0; k < membrane.nodes(); ++k) {
      const Vec<2> half = 0.5 * (node(end_of_edge(k, membrane.nodes())) - node(k));
      discs_.push_back({node(k) + half, safely * half.norm()});
    }
  }

  /// Where a point is to go that should be inside, or else outside; nothing if it is there.
  std::optional<RightSide<2>> on_side(const Vec<2>& x, bool inside) const {
    constexpr double distance = 1e-3;     // from the membrane [h]
    constexpr double least_share = 1e-6;  // of it
    const int cell = local_cell(layout_, cells_, x[0], x[1]);
    if (cell < 0) return {};
    const Nearest nearest = nearest_to(x, cell);
    if (nearest.edge < 0 || is_inside(x, nearest) == inside) return {};
    const Vec<2> way = (inside ? -1 : 1) * distance * layout_.finest * normal_at(nearest);
    Vec<2> to = nearest.point + way;
    // Near the edge of a fold narrower than a right angle the whole way leads through the other flank.
    for (double share = 0.5; share > least_share && is_inside(to, nearest_to(to, cell)) != inside; share /= 2)
      to = nearest.point + share * way;
    const auto from = static_cast<std::uint32_t>(nearest.edge);
    const auto end = static_cast<std::uint32_t>(end_of_edge(from, membrane_.nodes()));
    return RightSide<2>{to, {from, end}, {1 - nearest.share, nearest.share}};
  }

 private:
  struct Nearest {
    int edge = -1;
    double share = 0;  ///< of the edge
    double square = std::numeric_limits<double>::infinity(), distance = square;
    Vec<2> point;
  };
  /// Around an edge: what is farther from it than the nearest edge so far need not be looked at.
  struct Disc {
    Vec<2> middle;
    double radius;
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
    const Disc& disc = discs_[edge];
    const double farthest = nearest.distance + disc.radius;
    if ((x - disc.middle).squaredNorm() > farthest * farthest) return;
    const Vec<2> from = node(edge), along = node(end_of_edge(edge, membrane_.nodes())) - from;
    const double square = along.squaredNorm();
    const double share = square > 0 ? std::clamp((x - from).dot(along) / square, 0.0, 1.0) : 0.0;
    const Vec<2> point = from + share * along;
    const double distance = (x - point).squaredNorm();
    if (distance < nearest.square) nearest = {edge, share, distance, std::sqrt(distance), point};
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
  std::vector<Disc> discs_;         ///< of each edge
  std::vector<int> begin_, edges_;  ///< of each cell: edges_[begin_[cell]] to edges_[begin_[cell + 1] - 1]
};

/// Momentum that a membrane takes from a particle.
template <int Dim>
struct Catch {
  RightSide<Dim> at;
  Vec<Dim> momentum;
};

/// What resists an impulse at a point of a membrane: 1 / sum N_i^2 / m_i of the nodes of a field [kg].
template <int Dim>
double inertia(const Grid<Dim>& grid, const Membrane<Dim>& membrane, const Vec<Dim>& x) {
  std::array<double, Dim> place;
  for (int a = 0; a < Dim; ++a) place[a] = x[a];
  double sum = 0;
  PointSupport<Dim>(grid.layout, place, membrane.half_size).for_each_node(grid.layout, [&](int node, double weight) {
    if (const double mass = grid.sum[node][3]; mass > 0) sum += weight * weight / mass;
  });
  return sum > 0 ? 1 / sum : 0.0;
}

/// Of a membrane, of what is inside and, where it is wet, of what is around: that goes with it (join_interfaces).
template <int Dim>
double joint_inertia(const Grids<Dim>& grids, const Membrane<Dim>& membrane, const Vec<Dim>& x, std::uint32_t near) {
  const Grid<Dim>& around = grids.front();
  const double own = inertia(grids[membrane.field], membrane, x);
  return is_wet(around, cell_at(around.layout, membrane.x, near)) ? own + inertia(around, membrane, x) : own;
}

/// What a shift by dx adds to the velocity of a particle, C dx [m/s]; 0 in bodies that do not shift.
template <int Dim>
Vec<Dim> change_by_shift(const Body<Dim>& body, std::size_t p, const Vec<Dim>& dx) {
  Vec<Dim> change = Vec<Dim>::Zero();
  if (!body.shift) return change;
  for (int a = 0; a < Dim; ++a)
    for (int b = 0; b < Dim; ++b) change[a] += body.affine[a * Dim + b][p] * dx[b];
  return change;
}

/// Puts a particle on its side of a membrane, with the velocity of its field there if it may have shifted: what shifts
/// into the membrane step by step must not keep what each shift has added. The membrane takes what has moved it
/// through: no more than what leads back to the membrane in a step, and no more than its velocity towards the membrane;
/// then both go on as one, as after a plastic impact, so that light cloth is not shot away.
template <int Dim>
Catch<Dim> put_back(const Grids<Dim>& grids, const Membrane<Dim>& membrane, const RightSide<Dim>& side, double dt,
                    std::size_t p, Body<Dim>& body) {
  const Vec<Dim> v = vector_at(body.v, p) + change_by_shift<Dim>(body, p, side.to - vector_at(body.x, p));
  Vec<Dim> point = Vec<Dim>::Zero(), towards = v;
  for (int k = 0; k < Dim; ++k) {
    point += side.share[k] * vector_at(membrane.x, side.nodes[k]);
    towards -= side.share[k] * vector_at(membrane.v, side.nodes[k]);
  }
  const Vec<Dim> behind = vector_at(body.x, p) - point;
  const double depth = behind.norm(), approach = depth > 0 ? towards.dot(behind) / depth : 0.0;
  Vec<Dim> change = Vec<Dim>::Zero();
  if (approach > 0) {
    const double resists = joint_inertia(grids, membrane, point, side.nodes[0]);
    change = -std::min(approach / depth, 1 / dt) * resists / (resists + body.mass[p]) * behind;
  }
  for (int a = 0; a < Dim; ++a) {
    body.x[a][p] = side.to[a];
    body.v[a][p] = v[a] + change[a];
  }
  return {side, -body.mass[p] * change};
}

template <int Dim>
using Near = std::conditional_t<Dim == 2, NearEdges, NearTriangles>;

/// A sharp membrane, and where it is.
template <int Dim>
struct Keeper {
  Keeper(const Grids<Dim>& all, Membrane<Dim>& of)
      : grids(all),
        membrane(of),
        field(all[of.field]),
        surface(all.front().layout, of, field.outline),
        box(all.front().layout, field.outline) {}

  /// Of what is on one side of the membrane, whatever its side: its content, the water in its pores, what is around.
  bool keeps(const Body<Dim>& body) const { return is_beside(body, membrane, grids); }
  /// Where a particle of a body goes that is on the wrong side; none is in cells that its body has for itself.
  std::optional<RightSide<Dim>> moves(const Body<Dim>& body, std::size_t p) const {
    const bool around = is_around(grids, body.field);
    const Grid<Dim>& own = around ? grids.front() : grids[body.field];
    if (!box.may_hold(body.x, p) || own.taken[cell_at(own.layout, body.x, p)] <= 0) return {};
    std::optional<RightSide<Dim>> side = surface.on_side(vector_at(body.x, p), !around);
    // Where a surface ends at a wall its normal leans through it by a little.
    for (int a = 0; a < Dim && side; ++a) side->to[a] = within_walls(own.layout, a, side->to[a]);
    return side;
  }

  const Grids<Dim>& grids;
  Membrane<Dim>& membrane;
  const Grid<Dim>& field;
  Near<Dim> surface;
  BoxOfCells<Dim> box;
};

template <int Dim>
using Keepers = std::vector<const Keeper<Dim>*>;

/// Puts a particle back that membranes have let through: caught[k] is what keeper k takes from it. Where two membranes
/// touch, which overlap by a little then, nothing is outside of both: the particle stays in the middle.
template <int Dim>
void keep_particle(const Keepers<Dim>& keepers, double dt, std::size_t p, Body<Dim>& body,
                   std::vector<std::vector<Catch<Dim>>>& caught) {
  bool moved = false;
  for (std::size_t k = 0; k < keepers.size(); ++k) {
    const auto side = keepers[k]->moves(body, p);
    if (!side) continue;
    caught[k].push_back(put_back(keepers[k]->grids, keepers[k]->membrane, *side, dt, p, body));
    moved = true;
  }
  if (!moved || keepers.size() == 1) return;
  for (const Keeper<Dim>* keeper : keepers) {
    const auto side = keeper->moves(body, p);
    if (!side) continue;
    for (int a = 0; a < Dim; ++a) body.x[a][p] = (body.x[a][p] + side->to[a]) / 2;
    return;
  }
}

/// Particles of a body, by all that keep it. What membranes take from them is added up in their order.
template <int Dim>
void keep_body(const Keepers<Dim>& keepers, double dt, Body<Dim>& body) {
  constexpr std::size_t particles_of_a_part = 4096;
  const std::size_t n = body.size();
  using Caught = std::vector<std::vector<Catch<Dim>>>;  // of each membrane
  std::vector<Caught> caught((n + particles_of_a_part - 1) / particles_of_a_part, Caught(keepers.size()));
  const auto parts = static_cast<std::ptrdiff_t>(caught.size());
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t part = 0; part < parts; ++part) {
    const std::size_t first = part * particles_of_a_part;
    for (std::size_t p = first; p < std::min(first + particles_of_a_part, n); ++p) {
      const auto may_hold = [&](const Keeper<Dim>* keeper) { return keeper->box.may_hold(body.x, p); };
      if (std::any_of(keepers.begin(), keepers.end(), may_hold)) keep_particle(keepers, dt, p, body, caught[part]);
    }
  }
  for (const Caught& part : caught)
    for (std::size_t k = 0; k < keepers.size(); ++k)
      for (const Catch<Dim>& one : part[k])
        for (int node = 0; node < Dim; ++node)
          for (int a = 0; a < Dim; ++a)
            keepers[k]->membrane.caught[a][one.at.nodes[node]] += one.at.share[node] * one.momentum[a];
}

}  // namespace

template <int Dim>
void keep_sides(State<Dim>& state, const Grids<Dim>& grids, double dt) {
  if (!std::isfinite(state.drift)) return;  // a particle is lost, perhaps off the grid: the next sort reports it
  std::vector<Keeper<Dim>> keepers;
  for (Membrane<Dim>& membrane : state.membranes) {
    for (Array<double>& component : membrane.caught) std::fill(component.begin(), component.end(), 0.0);
    if (acts_sharply(membrane)) keepers.emplace_back(grids, membrane);
  }
  for (Body<Dim>& body : state.bodies) {
    Keepers<Dim> of_body;
    for (const Keeper<Dim>& keeper : keepers)
      if (keeper.keeps(body)) of_body.push_back(&keeper);
    if (!of_body.empty()) keep_body(of_body, dt, body);
  }
}

template void keep_sides(State<2>&, const Grids<2>&, double);
template void keep_sides(State<3>&, const Grids<3>&, double);

}  // namespace geodrop
