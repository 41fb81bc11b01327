// Closed surfaces of triangles on a small grid, fair and foul.
#pragma once

#include <geodrop/grid/grid.hpp>
#include <geodrop/scene/scene.hpp>
#include <geodrop/state/state.hpp>

#include <cmath>
#include <random>
#include <vector>

#include "geometry/surface_ends.hpp"
#include "geometry/surface_generators.hpp"

namespace geodrop::test {

/// ends: where walls stand instead of at -2 and 2 m.
inline GridLayout<3> small_grid(double h, const std::vector<RefineSpec>& zones = {},
                                const std::vector<SurfaceEnd>& ends = {}) {
  GridSpec spec;
  spec.refine = zones;
  spec.lower = {-2, -2, -2};
  spec.upper = {2, 2, 2};
  for (const SurfaceEnd& end : ends)
    (end.upper ? spec.upper : spec.lower)[static_cast<std::size_t>(end.axis)] = end.place;
  spec.spacing = h;
  spec.basis = Basis::bspline2;
  WallsSpec walls;
  for (auto* side : {&walls.lower, &walls.upper}) side->assign(3, WallKind::slip);
  return {spec, walls};
}

/// Even cells, and cells of another width along each axis, finer in the middle, which grow by half from one to the
/// next.
inline std::vector<GridLayout<3>> even_and_graded() {
  return {small_grid(0.25),
          small_grid(0.4, {{0, -0.3, 0.2, 0.1, 1.5, {}}, {1, -0.5, 0.1, 0.15, 1.3, {}}, {2, 0.1, 0.4, 0.2, 1.2, {}}})};
}

inline Membrane<3> membrane_of(const TriangleSurface& surface) {
  Membrane<3> membrane;
  for (const Corner& x : surface.points)
    for (std::size_t a = 0; a < 3; ++a) membrane.x[a].push_back(x[a]);
  membrane.mass.assign(surface.points.size(), 1.0);
  for (const auto& t : surface.triangles) {
    for (std::size_t k = 0; k < 3; ++k) membrane.triangles.corner[k].push_back(t[k]);
    membrane.triangles.rest_area.push_back(1);
  }
  return membrane;
}

/// The same of a surface that ends at walls.
inline Membrane<3> membrane_of(const TriangleSurface& surface, const std::vector<SurfaceEnd>& ends) {
  Membrane<3> membrane = membrane_of(surface);
  for (const SurfaceEnd& end : ends)
    for (const auto& [from, to] : open_edges(surface, end)) {
      membrane.triangles.open_edge[0].push_back(from);
      membrane.triangles.open_edge[1].push_back(to);
      membrane.triangles.open_edge[2].push_back(wall_number(end.axis, end.upper));
    }
  return membrane;
}

/// A ball; with corners on planes of the grid; folded and cut by itself.
inline std::vector<TriangleSurface> surfaces() {
  TriangleSurface ball = ellipsoid_surface({0.03, 0.05, 0.07}, {1, 0.8, 1.2}, 0.15), on_planes = ball, torn = ball;
  for (Corner& x : on_planes.points)
    for (double& c : x) c = std::round(8 * c) / 8 + 0.125;
  std::mt19937_64 generator(5);
  for (Corner& x : torn.points)
    for (double& c : x) c += 0.2 * (static_cast<double>(generator() >> 11) / (1ULL << 53) - 0.5);
  return {ball, on_planes, torn};
}

/// Two discs a third of a cell apart, within one layer of cells, that meet at a rim.
inline TriangleSurface flat_bag() { return disc_pillow_surface({0.02, 0.03, 0.01}, 1.1, 0.08, 0.12); }

}  // namespace geodrop::test
