#include <geodrop/geometry/triangle_surface.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "clip_triangle.hpp"
#include "corner.hpp"

namespace geodrop {
namespace {

/// Twice the area, outwards.
Corner normal_of(const TriangleSurface& surface, const std::array<std::uint32_t, 3>& triangle) {
  const Corner& a = surface.points[triangle[0]];
  return cross(difference(surface.points[triangle[1]], a), difference(surface.points[triangle[2]], a));
}

std::string number(std::size_t triangle) { return "triangle " + std::to_string(triangle + 1); }

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// Each edge runs once in either direction; which triangle has it.
std::string fault_of_edges(const TriangleSurface& surface) {
  std::map<Edge, std::size_t> triangle_of;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Edge edge{surface.triangles[t][k], surface.triangles[t][(k + 1) % 3]};
      const auto [place, is_new] = triangle_of.emplace(edge, t);
      if (!is_new)
        return number(t) + ", which runs along an edge the same way as " + number(place->second) +
               " does: one of them faces inwards, or three share the edge";
    }
  for (const auto& [edge, t] : triangle_of)
    if (!triangle_of.contains({edge.second, edge.first})) return number(t) + ", which has an edge without a neighbour";
  return "";
}

/// Moments of a plane polygon: of its projection along x, with (X - x_low) cut to the box, times 1, x, y, z.
void add_piece(const ConvexPiece& piece, double low, double high, SurfaceRegion::Moments& sum) {
  for (std::size_t k = 1; k + 1 < piece.count; ++k) {
    const SpacePoint &a = piece.at[0], &b = piece.at[k], &c = piece.at[k + 1];
    const double projected = 0.5 * ((b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1]));
    if (projected == 0) continue;
    // Mid-edge points: exact for quadratic polynomials.
    for (const auto& [u, v] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
      const double x = std::clamp(0.5 * (u[0] + v[0]), low, high), share = projected / 3;
      sum.volume += share * (x - low);
      sum.first[0] += share * 0.5 * (x - low) * (x + low);
      sum.first[1] += share * (x - low) * 0.5 * (u[1] + v[1]);
      sum.first[2] += share * (x - low) * 0.5 * (u[2] + v[2]);
    }
  }
}

/// What of a piece lies between two planes.
ConvexPiece between(const ConvexPiece& piece, std::size_t axis, double low, double high) {
  ConvexPiece below, rest, inside, above;
  split(piece, axis, low, below, rest);
  if (rest.count == 0) return rest;
  split(rest, axis, high, inside, above);
  return inside;
}

}  // namespace

double volume(const TriangleSurface& surface) {
  double sum = 0;
  for (const auto& triangle : surface.triangles)
    sum += dot(surface.points[triangle[0]], normal_of(surface, triangle)) / 6;
  return sum;
}

double area(const TriangleSurface& surface) {
  double sum = 0;
  for (const auto& triangle : surface.triangles) {
    const Corner normal = normal_of(surface, triangle);
    sum += 0.5 * std::sqrt(dot(normal, normal));
  }
  return sum;
}

std::string fault_of(const TriangleSurface& surface) {
  constexpr double least_share = 1e-9;  // of the square on its longest edge
  if (surface.triangles.size() < 4) return std::to_string(surface.triangles.size()) + " triangles, which close nothing";
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& corners = surface.triangles[t];
    double longest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      if (corners[k] >= surface.points.size()) return number(t) + ", which has a corner that is not there";
      const Corner edge = difference(surface.points[corners[(k + 1) % 3]], surface.points[corners[k]]);
      longest = std::max(longest, dot(edge, edge));
    }
    const Corner normal = normal_of(surface, corners);
    if (!(std::sqrt(dot(normal, normal)) > least_share * longest)) return number(t) + ", which has no area";
  }
  std::string edges = fault_of_edges(surface);
  if (!edges.empty()) return edges;
  return volume(surface) > 0 ? "" : "a surface whose triangles face inwards";
}

SurfaceRegion::SurfaceRegion(TriangleSurface surface) : surface_(std::move(surface)) {
  lower_ = upper_ = surface_.points.front();
  for (const Corner& x : surface_.points)
    for (std::size_t a = 0; a < 3; ++a) {
      lower_[a] = std::min(lower_[a], x[a]);
      upper_[a] = std::max(upper_[a], x[a]);
    }
  // About one triangle of either side in a column.
  const double across = std::sqrt(static_cast<double>(surface_.triangles.size()) / 2);
  for (std::size_t a = 0; a < 2; ++a) {
    count_[a] = std::max(1, static_cast<int>(across));
    width_[a] = (upper_[a + 1] - lower_[a + 1]) / count_[a];
  }
  columns_.resize(static_cast<std::size_t>(count_[0]) * static_cast<std::size_t>(count_[1]));
  for (std::uint32_t t = 0; t < surface_.triangles.size(); ++t) {
    const auto [y_low, y_high] = std::minmax({corner(t, 0)[1], corner(t, 1)[1], corner(t, 2)[1]});
    const auto [z_low, z_high] = std::minmax({corner(t, 0)[2], corner(t, 1)[2], corner(t, 2)[2]});
    const Columns columns = columns_of(y_low, y_high, z_low, z_high);
    for (int z = columns.first[1]; z <= columns.last[1]; ++z)
      for (int y = columns.first[0]; y <= columns.last[0]; ++y) columns_[column_at(y, z)].push_back(t);
  }
}

SurfaceRegion::Columns SurfaceRegion::columns_of(double y_low, double y_high, double z_low, double z_high) const {
  Columns columns;
  const double low[] = {y_low, z_low}, high[] = {y_high, z_high};
  for (std::size_t a = 0; a < 2; ++a) {
    const auto column = [&](double x) {
      const double place = std::floor((x - lower_[a + 1]) / width_[a]);
      return static_cast<int>(std::clamp(place, 0.0, static_cast<double>(count_[a] - 1)));
    };
    columns.first[a] = column(low[a]);
    columns.last[a] = column(high[a]);
  }
  return columns;
}

/// Each triangle once: in the first of the columns that it shares with the box.
template <class Visit>
void SurfaceRegion::for_each_near(const Columns& columns, Visit&& visit) const {
  for (int z = columns.first[1]; z <= columns.last[1]; ++z)
    for (int y = columns.first[0]; y <= columns.last[0]; ++y)
      for (const std::uint32_t t : columns_[column_at(y, z)]) {
        const auto [y_low, y_high] = std::minmax({corner(t, 0)[1], corner(t, 1)[1], corner(t, 2)[1]});
        const auto [z_low, z_high] = std::minmax({corner(t, 0)[2], corner(t, 1)[2], corner(t, 2)[2]});
        const Columns own = columns_of(y_low, y_high, z_low, z_high);
        if (y == std::max(own.first[0], columns.first[0]) && z == std::max(own.first[1], columns.first[1])) visit(t);
      }
}

bool SurfaceRegion::contains(const Corner& x) const {
  for (std::size_t a = 0; a < 3; ++a)
    if (x[a] < lower_[a] || x[a] > upper_[a]) return false;
  // How often a ray along x leaves: crossings of the projected triangles, by edges that are half open in z.
  int crossings = 0;
  for_each_near(columns_of(x[1], x[1], x[2], x[2]), [&](std::uint32_t t) {
    double cut[2];
    int cuts = 0;
    double at[2];
    for (int k = 0; k < 3; ++k) {
      const Corner u = corner(t, k), v = corner(t, (k + 1) % 3);
      if ((u[2] > x[2]) == (v[2] > x[2])) continue;
      const Corner &low = u[2] < v[2] ? u : v, &high = u[2] < v[2] ? v : u;
      const double share = (x[2] - low[2]) / (high[2] - low[2]);
      at[cuts] = low[1] + share * (high[1] - low[1]);
      cut[cuts++] = low[0] + share * (high[0] - low[0]);
    }
    if (cuts != 2 || (at[0] > x[1]) == (at[1] > x[1])) return;
    const double share = (x[1] - at[0]) / (at[1] - at[0]);
    if (cut[0] + share * (cut[1] - cut[0]) > x[0]) ++crossings;
  });
  return crossings % 2 != 0;
}

bool SurfaceRegion::may_cut(const Corner& lower, const Corner& upper) const {
  for (std::size_t a = 0; a < 3; ++a)
    if (upper[a] < lower_[a] || lower[a] > upper_[a]) return false;
  bool cuts = false;
  for_each_near(columns_of(lower[1], upper[1], lower[2], upper[2]), [&](std::uint32_t t) {
    bool apart = false;
    for (std::size_t a = 0; a < 3; ++a) {
      const auto [low, high] = std::minmax({corner(t, 0)[a], corner(t, 1)[a], corner(t, 2)[a]});
      apart = apart || high < lower[a] || low > upper[a];
    }
    cuts = cuts || !apart;
  });
  return cuts;
}

SurfaceRegion::Moments SurfaceRegion::moments_in(const Corner& lower, const Corner& upper) const {
  Moments sum;
  for_each_near(columns_of(lower[1], upper[1], lower[2], upper[2]), [&](std::uint32_t t) {
    ConvexPiece piece;
    for (int k = 0; k < 3; ++k) piece.add(corner(t, k));
    piece = between(piece, 1, lower[1], upper[1]);
    if (piece.count > 0) piece = between(piece, 2, lower[2], upper[2]);
    if (piece.count == 0) return;
    ConvexPiece below, rest, inside, above;
    split(piece, 0, lower[0], below, rest);
    if (rest.count == 0) return;
    split(rest, 0, upper[0], inside, above);
    add_piece(inside, lower[0], upper[0], sum);
    add_piece(above, lower[0], upper[0], sum);
  });
  return sum;
}

}  // namespace geodrop
