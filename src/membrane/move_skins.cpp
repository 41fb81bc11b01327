#include "move_skins.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/polygon.hpp"
#include "grid/momentum.hpp"
#include "grid/point_support.hpp"

#include "membrane_force.hpp"

namespace geodrop {
namespace {

/// The part of a node's spline that nodes of small mass have, weighted as they are [-].
double share_of_light_nodes(const Grid<2>& own, const PointSupport<2>& support) {
  double share = 0;
  support.for_each_node(own.layout, [&](int node, double weight) {
    const double light = light_mass<2>(own, stored_cell(own.layout, node));
    share += weight * std::max(0.0, 1 - own.sum[node][3] / light);
  });
  return share;
}

/// How empty the skin is at a node: 0 up to where half of its spline has nodes of small mass, 1 where all of it has. At
/// a plane surface of a full body it is at most 0.14.
double emptiness(double share_of_light) { return std::clamp(2 * share_of_light - 1, 0.0, 1.0); }

void move_skin(const Grids<2>& grids, double dt, Membrane<2>& skin, double& largest) {
  constexpr double drawn_back_in_a_step = 0.1;
  const Grid<2>&own = grids[skin.field], &around = grids.front();
  const std::size_t n = skin.nodes();
  const std::array<Array<double>, 2> before = {skin.x[0], skin.x[1]};
  for (std::size_t k = 0; k < n; ++k) {
    const PointSupport<2> support(own.layout, {before[0][k], before[1][k]}, skin.half_size);
    const double empty = emptiness(share_of_light_nodes(own, support));
    Vec4 v = interpolate(own.layout, support, own.velocity);
    if (empty > 0) v = (1 - empty) * v + empty * interpolate(around.layout, support, around.velocity);
    const bool end = !skin.closed && (k == 0 || k + 1 == n);
    for (int a = 0; a < 2; ++a) {
      skin.v[a][k] = v[a];
      double way = dt * v[a];
      if (empty > 0 && !end) {
        const double middle = (before[a][k == 0 ? n - 1 : k - 1] + before[a][end_of_edge(k, n)]) / 2;
        way += drawn_back_in_a_step * empty * (middle - before[a][k]);
      }
      skin.x[a][k] = back_on_grid(own.layout, a, before[a][k] + way);
      largest = std::max(largest, std::abs(way));
    }
    check_on_grid<2>(own.layout, place_at(skin.x, k), "a node of membrane", skin.name);
  }
}

}  // namespace

void move_skins(State<2>& state, const Grids<2>& grids, double dt) {
  double largest = 0;
  for (Membrane<2>& membrane : state.membranes)
    if (is_sharp_skin(membrane)) move_skin(grids, dt, membrane, largest);
  state.drift += largest;
}

}  // namespace geodrop
