#include "surface_ends.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "corner.hpp"

namespace geodrop {
namespace {

/// Cuts the triangles of a surface at a plane.
class Cutter {
 public:
  Cutter(TriangleSurface surface, const SurfaceEnd& end, double snap) : surface_(std::move(surface)), end_(end) {
    const auto axis = static_cast<std::size_t>(end.axis);
    for (std::size_t k = 0; k < surface_.points.size(); ++k) {
      double& x = surface_.points[k][axis];
      const double way = end.place - x;
      if (std::abs(way) < snap) {
        x = end.place;
        if (!surface_.unstretched.empty()) surface_.unstretched[k][axis] += way;
      }
      height_.push_back(end.upper ? end.place - x : x - end.place);
    }
  }

  TriangleSurface cut() {
    std::vector<std::array<std::uint32_t, 3>> kept;
    for (const auto& triangle : std::exchange(surface_.triangles, {})) {
      const auto any = [&](auto&& holds) { return std::ranges::any_of(triangle, holds); };
      if (!any([&](std::uint32_t k) { return height_[k] > 0; })) continue;
      if (!any([&](std::uint32_t k) { return height_[k] < 0; }))
        surface_.triangles.push_back(triangle);
      else
        part(triangle);
    }
    return without_lost_points();
  }

 private:
  /// What of a triangle lies on this side of the plane: three or four corners.
  void part(const std::array<std::uint32_t, 3>& triangle) {
    std::vector<std::uint32_t> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = triangle[k], to = triangle[(k + 1) % 3];
      if (height_[from] >= 0) corners.push_back(from);
      if (height_[from] * height_[to] < 0) corners.push_back(crossing(std::minmax(from, to)));
    }
    const bool other_diagonal = corners.size() == 4 && way(corners[1], corners[3]) < way(corners[0], corners[2]);
    if (other_diagonal) std::rotate(corners.begin(), corners.begin() + 1, corners.end());
    for (std::size_t k = 1; k + 1 < corners.size(); ++k)
      surface_.triangles.push_back({corners[0], corners[k], corners[k + 1]});
  }

  double way(std::uint32_t from, std::uint32_t to) const {
    const Corner d = difference(surface_.points[to], surface_.points[from]);
    return dot(d, d);
  }

  /// The point of an edge in the plane, the same for both of its triangles.
  std::uint32_t crossing(const std::pair<std::uint32_t, std::uint32_t>& edge) {
    const auto [place, is_new] = crossing_.emplace(edge, static_cast<std::uint32_t>(surface_.points.size()));
    if (!is_new) return place->second;
    const std::uint32_t from = edge.first, to = edge.second;
    const double share = height_[from] / (height_[from] - height_[to]);
    const auto between = [&](std::vector<Corner>& points) {
      Corner x = points[from];
      for (std::size_t a = 0; a < 3; ++a) x[a] += share * (points[to][a] - points[from][a]);
      points.push_back(x);
    };
    between(surface_.points);
    surface_.points.back()[static_cast<std::size_t>(end_.axis)] = end_.place;
    if (!surface_.unstretched.empty()) between(surface_.unstretched);
    height_.push_back(0);
    return place->second;
  }

  TriangleSurface without_lost_points() {
    constexpr auto lost = static_cast<std::uint32_t>(-1);
    std::vector<std::uint32_t> number(surface_.points.size(), lost);
    for (const auto& triangle : surface_.triangles)
      for (const std::uint32_t k : triangle) number[k] = 0;
    TriangleSurface out;
    for (std::size_t k = 0; k < number.size(); ++k) {
      if (number[k] == lost) continue;
      number[k] = static_cast<std::uint32_t>(out.points.size());
      out.points.push_back(surface_.points[k]);
      if (!surface_.unstretched.empty()) out.unstretched.push_back(surface_.unstretched[k]);
    }
    for (const auto& [a, b, c] : surface_.triangles) out.triangles.push_back({number[a], number[b], number[c]});
    return out;
  }

  TriangleSurface surface_;
  SurfaceEnd end_;
  std::vector<double> height_;  ///< of each point over the plane, on the side that stays [m]
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> crossing_;
};

}  // namespace

TriangleSurface cut_off(TriangleSurface surface, const SurfaceEnd& end, double snap) {
  return Cutter(std::move(surface), end, snap).cut();
}

std::vector<SurfaceEdge> open_edges(const TriangleSurface& surface, const SurfaceEnd& end) {
  const auto lies = [&](std::uint32_t k) { return surface.points[k][static_cast<std::size_t>(end.axis)] == end.place; };
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;  // in the plane
  for (const auto& triangle : surface.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = triangle[k], to = triangle[(k + 1) % 3];
      if (lies(from) && lies(to)) edges.emplace(from, to);
    }
  std::vector<SurfaceEdge> open;
  for (const auto& [from, to] : edges)
    if (!edges.contains({to, from})) open.push_back({from, to});
  return open;
}

Corner middle_of_fan(const std::vector<SurfaceEnd>& ends, const SurfaceEnd& end, const Corner& near) {
  Corner middle = near;
  for (const SurfaceEnd& other : ends)
    if (other.axis != end.axis) middle[static_cast<std::size_t>(other.axis)] = other.place;
  middle[static_cast<std::size_t>(end.axis)] = end.place;
  return middle;
}

TriangleSurface with_fans(TriangleSurface surface, const std::vector<SurfaceEnd>& ends) {
  std::vector<std::array<std::uint32_t, 3>> fans;
  for (const SurfaceEnd& end : ends) {
    const std::vector<SurfaceEdge> edges = open_edges(surface, end);
    if (edges.empty()) continue;
    const Corner middle = middle_of_fan(ends, end, surface.points[edges.front()[0]]);
    for (const auto& [from, to] : edges) fans.push_back({to, from, static_cast<std::uint32_t>(surface.points.size())});
    surface.points.push_back(middle);
  }
  surface.triangles.insert(surface.triangles.end(), fans.begin(), fans.end());
  return surface;
}

}  // namespace geodrop
