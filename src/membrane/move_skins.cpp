#include "move_skins.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/polygon.hpp"
#include "grid/momentum.hpp"
#include "grid/point_support.hpp"

#include "membrane_force.hpp"

namespace geodrop {
namespace {

/// Masses of small-mass nodes (light_mass) below which a node has little of the body: a quarter of a full node, half as
/// much again as the outer nodes of a plane surface have.
constexpr double of_little = 12.5;

/// What the nodes around a place of the skin know of the body.
struct Inside {
  double missing = 0;  ///< the part of the spline that nodes with little of the body lack [-]
  Vec4 velocity{};     ///< the mean of the nodes, those of small mass by the part of an impulse that they take [m/s]
};

Inside inside_at(const Grid<2>& own, const PointSupport<2>& support) {
  Inside inside;
  double weights = 0;
  support.for_each_node(own.layout, [&](int node, double weight) {
    const double light_masses = own.sum[node][3] / light_mass<2>(own, stored_cell(own.layout, node));
    inside.missing += weight * std::max(0.0, 1 - light_masses / of_little);
    inside.velocity += weight * std::min(1.0, light_masses) * own.velocity[node];
    weights += weight * std::min(1.0, light_masses);
  });
  if (weights > 0) inside.velocity *= 1 / weights;
  return inside;
}

/// How empty the skin is at a node: 0 up to where half of its spline lacks the body, 1 where all of it does. At a plane
/// surface of a full body 0.22 of it does at most.
double emptiness(double missing) { return std::clamp(2 * missing - 1, 0.0, 1.0); }

/// The largest displacement along an axis [m].
double move_skin(const Grids<2>& grids, double dt, Membrane<2>& skin) {
  constexpr double drawn_back_in_a_step = 0.1;
  const Grid<2>&own = grids[skin.field], &around = grids.front();
  const std::size_t n = skin.nodes();
  const std::array<Array<double>, 2> before = skin.x;
  double largest = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const PointSupport<2> support(own.layout, {before[0][k], before[1][k]}, skin.half_size);
    const Inside inside = inside_at(own, support);
    const double empty = emptiness(inside.missing);
    Vec4 v = inside.velocity;
    if (empty > 0) v = (1 - empty) * v + empty * interpolate(around.layout, support, around.velocity);
    for (int a = 0; a < 2; ++a) {
      skin.v[a][k] = v[a];
      double way = dt * v[a];
      if (empty > 0) {
        const double middle = (before[a][k == 0 ? n - 1 : k - 1] + before[a][end_of_edge(k, n)]) / 2;
        way += drawn_back_in_a_step * empty * (middle - before[a][k]);
      }
      skin.x[a][k] = back_on_grid(own.layout, a, before[a][k] + way);
      largest = std::max(largest, std::abs(way));
    }
    check_on_grid<2>(own.layout, place_at(skin.x, k), "a node of membrane", skin.name);
  }
  return largest;
}

}  // namespace

void move_skins(State<2>& state, const Grids<2>& grids, double dt) {
  double largest = 0;
  for (Membrane<2>& membrane : state.membranes)
    if (is_sharp_skin(membrane)) largest = std::max(largest, move_skin(grids, dt, membrane));
  state.drift += largest;
}

}  // namespace geodrop
