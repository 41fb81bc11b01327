#include "frame_cut.hpp"

#include <geodrop/geometry/triangle_surface.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "geometry/surface_ends.hpp"

namespace geodrop {
namespace {

template <class Value>
std::vector<Value> picked(const std::vector<Value>& values, const std::vector<std::size_t>& which, std::size_t width) {
  std::vector<Value> result;
  if (values.empty()) return result;
  result.reserve(which.size() * width);
  for (const std::size_t i : which)
    for (std::size_t c = 0; c < width; ++c) result.push_back(values[i * width + c]);
  return result;
}

std::vector<Field> picked(const std::vector<Field>& fields, const std::vector<std::size_t>& which) {
  std::vector<Field> result;
  for (const Field& field : fields)
    result.push_back({field.name, field.components, picked(field.values, which, field.width())});
  return result;
}

/// A surface that ends at walls closed there: it has its open edges where it ends along an axis.
TriangleSurface closed(TriangleSurface surface) {
  std::vector<SurfaceEnd> ends;
  for (int axis = 0; axis < 3; ++axis) {
    const auto along = [&](const Corner& x) { return x[static_cast<std::size_t>(axis)]; };
    const auto [low, high] = std::ranges::minmax(surface.points, {}, along);
    for (const SurfaceEnd& end : {SurfaceEnd{axis, false, along(low)}, SurfaceEnd{axis, true, along(high)}})
      if (!open_edges(surface, end).empty()) ends.push_back(end);
  }
  return with_fans(std::move(surface), ends);
}

/// The closed surfaces of membranes.
std::vector<SurfaceRegion> insides_of(const MembraneSnapshot& triangles) {
  std::map<std::uint32_t, TriangleSurface> surfaces;
  for (std::size_t t = 0; t < triangles.membrane.size(); ++t) {
    const std::uint32_t* corner = &triangles.connectivity[3 * t];
    surfaces[triangles.membrane[t]].triangles.push_back({corner[0], corner[1], corner[2]});
  }
  std::vector<Corner> points(triangles.points.size() / 3);
  for (std::size_t i = 0; i < points.size(); ++i) std::copy_n(&triangles.points[3 * i], 3, points[i].begin());
  std::vector<SurfaceRegion> insides;
  for (auto& [membrane, surface] : surfaces) {
    // Points of other membranes would widen the box around it.
    std::map<std::uint32_t, std::uint32_t> number;
    for (auto& triangle : surface.triangles)
      for (std::uint32_t& corner : triangle) {
        const auto [place, is_new] = number.try_emplace(corner, static_cast<std::uint32_t>(surface.points.size()));
        if (is_new) surface.points.push_back(points[corner]);
        corner = place->second;
      }
    insides.emplace_back(closed(std::move(surface)));
  }
  return insides;
}

ParticleSnapshot particles_at(const Snapshot& frame, const CutPlane& plane, double reach) {
  const std::vector<SurfaceRegion> insides = insides_of(frame.membranes);
  const ParticleSnapshot& all = frame.particles;
  std::vector<std::size_t> near;
  for (std::size_t p = 0; 3 * p < all.points.size(); ++p) {
    const Corner x{all.points[3 * p], all.points[3 * p + 1], all.points[3 * p + 2]};
    if (std::abs(x[plane.axis] - plane.place) > reach) continue;
    Corner in_plane = x;
    in_plane[plane.axis] = plane.place;
    const auto is_parted = [&](const SurfaceRegion& inside) { return inside.contains(x) != inside.contains(in_plane); };
    if (std::ranges::none_of(insides, is_parted)) near.push_back(p);
  }
  ParticleSnapshot result;
  result.points = picked(all.points, near, 3);
  result.fields = picked(all.fields, near);
  result.layer = picked(all.layer, near, 1);
  result.material = picked(all.material, near, 1);
  result.body = picked(all.body, near, 1);
  result.id = picked(all.id, near, 1);
  return result;
}

/// Where edges of triangles cross the plane: one node for both triangles of an edge, so that the lines close.
class Crossings {
 public:
  Crossings(const std::vector<double>& points, const CutPlane& plane) : points_(points), plane_(plane) {}

  bool is_beyond(std::uint32_t corner) const { return points_[3 * corner + plane_.axis] >= plane_.place; }
  std::uint32_t node(std::uint32_t from, std::uint32_t to) {
    const std::pair<std::uint32_t, std::uint32_t> edge = std::minmax(from, to);
    const auto [place, is_new] = node_of_.try_emplace(edge, static_cast<std::uint32_t>(nodes_.size() / 3));
    if (is_new) {
      const double *a = &points_[3 * edge.first], *b = &points_[3 * edge.second];
      const double share = (plane_.place - a[plane_.axis]) / (b[plane_.axis] - a[plane_.axis]);
      for (std::size_t k = 0; k < 3; ++k) nodes_.push_back(a[k] + share * (b[k] - a[k]));
    }
    return place->second;
  }
  const std::vector<double>& nodes() const { return nodes_; }

 private:
  const std::vector<double>& points_;
  CutPlane plane_;
  std::vector<double> nodes_;  ///< three numbers each [m]
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> node_of_;
};

/// A plane on which membranes end, as a plane of symmetry, cuts them a little before.
CutPlane beside_ends(const std::vector<double>& points, CutPlane plane) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = plane.axis; i < points.size(); i += 3) {
    low = std::min(low, points[i]);
    high = std::max(high, points[i]);
  }
  const double beside = 1e-6 * (high - low);
  if (std::abs(plane.place - low) < beside) plane.place = low + beside;
  if (std::abs(plane.place - high) < beside) plane.place = high - beside;
  return plane;
}

MembraneSnapshot lines_in(const MembraneSnapshot& triangles, const CutPlane& plane) {
  MembraneSnapshot lines;
  std::vector<std::size_t> cut;
  Crossings crossings(triangles.points, plane);
  for (std::size_t t = 0; t < triangles.membrane.size(); ++t) {
    const std::uint32_t* corner = &triangles.connectivity[3 * t];
    const std::size_t before = lines.connectivity.size();
    for (std::size_t k = 0; k < 3; ++k)
      if (crossings.is_beyond(corner[k]) != crossings.is_beyond(corner[(k + 1) % 3]))
        lines.connectivity.push_back(crossings.node(corner[k], corner[(k + 1) % 3]));
    if (lines.connectivity.size() > before) cut.push_back(t);
  }
  lines.points = crossings.nodes();
  lines.fields = picked(triangles.fields, cut);
  lines.membrane = picked(triangles.membrane, cut, 1);
  return lines;
}

}  // namespace

Snapshot cut_frame(const Snapshot& frame, const CutPlane& plane, double reach) {
  Snapshot cut;
  cut.t = frame.t;
  const CutPlane beside = beside_ends(frame.membranes.points, plane);
  cut.particles = particles_at(frame, beside, reach);
  cut.membranes = lines_in(frame.membranes, beside);
  cut.rigid = frame.rigid;
  return cut;
}

}  // namespace geodrop
