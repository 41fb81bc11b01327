// Triangles split by planes across the axes into convex pieces (Sutherland & Hodgman 1974). The two parts of an edge
// meet in the same point, computed from its lower end: what leaves one cell enters the next to the last bit.
#pragma once

#include <array>
#include <cstddef>

namespace geodrop {

using SpacePoint = std::array<double, 3>;

/// A convex polygon. A triangle that six planes clip has at most nine corners.
struct ConvexPiece {
  std::size_t count = 0;
  std::array<SpacePoint, 12> at;
  void add(const SpacePoint& x) { at[count++] = x; }
};

/// The parts below and above the plane x_axis = level; a part without area has no corners. A polygon that lies in the
/// plane is above it.
inline void split(const ConvexPiece& whole, std::size_t axis, double level, ConvexPiece& below, ConvexPiece& above) {
  below.count = above.count = 0;
  bool any_below = false;
  for (std::size_t k = 0; k < whole.count; ++k) {
    const SpacePoint &u = whole.at[k], &v = whole.at[k + 1 == whole.count ? 0 : k + 1];
    any_below = any_below || u[axis] < level;
    if (u[axis] <= level) below.add(u);
    if (u[axis] >= level) above.add(u);
    if ((u[axis] < level) == (v[axis] < level) || u[axis] == level || v[axis] == level) continue;
    const SpacePoint &low = u[axis] < v[axis] ? u : v, &high = u[axis] < v[axis] ? v : u;
    const double share = (level - low[axis]) / (high[axis] - low[axis]);
    SpacePoint crossing;
    for (std::size_t a = 0; a < 3; ++a) crossing[a] = low[a] + share * (high[a] - low[a]);
    crossing[axis] = level;
    below.add(crossing);
    above.add(crossing);
  }
  if (below.count < 3 || !any_below) below.count = 0;
  if (above.count < 3) above.count = 0;
}

}  // namespace geodrop
