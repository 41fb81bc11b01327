#include "surface_generators.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "corner.hpp"

namespace geodrop {
namespace {

constexpr double full_turn = 2 * std::numbers::pi;

Corner along(const Corner& from, double way, const Corner& direction) {
  return {from[0] + way * direction[0], from[1] + way * direction[1], from[2] + way * direction[2]};
}
double length(const Corner& v) { return std::sqrt(dot(v, v)); }
Corner unit(const Corner& v) {
  const double size = length(v);
  return {v[0] / size, v[1] / size, v[2] / size};
}
/// How many pieces of about `piece` a length has, at least `least`.
std::uint32_t pieces(double whole, double piece, std::uint32_t least) {
  return std::max(least, static_cast<std::uint32_t>(std::lround(whole / piece)));
}

/// A line of a half length bent to a circular arc of a rise in the middle.
class Arc {
 public:
  Arc(double half_length, double rise) : half_length_(half_length) {
    // (1 - cos a) / a grows until 0.7246 at a = 2.33.
    double low = 0, high = 2.33;
    for (int round = 0; round < 60; ++round) {
      const double middle = 0.5 * (low + high);
      ((1 - std::cos(middle)) / middle < rise / half_length ? low : high) = middle;
    }
    angle_ = 0.5 * (low + high);
  }
  /// Of the point at a length along the line from its middle.
  double across(double along) const { return half_length_ / angle_ * std::sin(angle_ * along / half_length_); }
  double height(double along) const {
    return half_length_ / angle_ * (std::cos(angle_ * along / half_length_) - std::cos(angle_));
  }

 private:
  double half_length_, angle_;
};

/// A ring of points, anticlockwise about the axis; the first is at a share `begin` of the way round.
struct Ring {
  std::vector<std::uint32_t> points;
  double begin = 0;
  std::uint32_t at(std::size_t k) const { return points[k % points.size()]; }
  double place(std::size_t k) const { return (static_cast<double>(k) + begin) / static_cast<double>(points.size()); }
};

/// Triangles between a ring and the next one along the axis: always on along the ring that is behind.
void stitch(const Ring& lower, const Ring& upper, TriangleSurface& surface) {
  std::size_t low = 0, high = 0;
  const std::size_t low_steps = lower.points.size() > 1 ? lower.points.size() : 0;
  const std::size_t high_steps = upper.points.size() > 1 ? upper.points.size() : 0;
  while (low < low_steps || high < high_steps) {
    const bool on_lower = high == high_steps || (low < low_steps && lower.place(low + 1) <= upper.place(high + 1));
    if (on_lower) {
      surface.triangles.push_back({lower.at(low), lower.at(low + 1), upper.at(high)});
      ++low;
    } else {
      surface.triangles.push_back({lower.at(low), upper.at(high + 1), upper.at(high)});
      ++high;
    }
  }
}

void stitch_all(const std::vector<Ring>& rings, TriangleSurface& surface) {
  for (std::size_t r = 1; r < rings.size(); ++r) stitch(rings[r - 1], rings[r], surface);
}

const std::array<Corner, 12>& icosahedron_corners() {
  constexpr double g = std::numbers::phi;
  static const std::array<Corner, 12> corners{{{-1, g, 0},
                                               {1, g, 0},
                                               {-1, -g, 0},
                                               {1, -g, 0},
                                               {0, -1, g},
                                               {0, 1, g},
                                               {0, -1, -g},
                                               {0, 1, -g},
                                               {g, 0, -1},
                                               {g, 0, 1},
                                               {-g, 0, -1},
                                               {-g, 0, 1}}};
  return corners;
}
constexpr std::array<std::array<int, 3>, 20> icosahedron_faces{
    {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
     {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
     {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};

/// Points of the divided icosahedron on the unit sphere, each once: shared ones are known by corners and shares.
class Geodesic {
 public:
  explicit Geodesic(int pieces) : pieces_(pieces) {}
  TriangleSurface surface;

  std::uint32_t point(const std::array<int, 3>& face, const std::array<int, 3>& shares) {
    std::array<std::pair<int, int>, 3> key{};
    std::size_t count = 0;
    Corner x{};
    for (std::size_t k = 0; k < 3; ++k) {
      if (shares[k] == 0) continue;
      key[count++] = {face[k] + 1, shares[k]};
      x = along(x, static_cast<double>(shares[k]) / pieces_, icosahedron_corners()[static_cast<std::size_t>(face[k])]);
    }
    std::sort(key.begin(), key.begin() + static_cast<std::ptrdiff_t>(count));
    const auto [place, is_new] = index_.emplace(key, static_cast<std::uint32_t>(surface.points.size()));
    if (is_new) surface.points.push_back(unit(x));
    return place->second;
  }

 private:
  int pieces_;
  std::map<std::array<std::pair<int, int>, 3>, std::uint32_t> index_;
};

TriangleSurface unit_sphere(int n) {
  Geodesic sphere(n);
  auto& triangles = sphere.surface.triangles;
  for (const auto& face : icosahedron_faces)
    for (int i = 0; i < n; ++i)
      for (int j = 0; i + j < n; ++j) {
        const auto at = [&](int a, int b) { return sphere.point(face, {n - a - b, a, b}); };
        triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
        if (i + j + 2 <= n) triangles.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
      }
  return std::move(sphere.surface);
}

/// Three unit vectors, the last along a direction.
struct Frame {
  Corner first, second, axis;
};
Frame frame_along(const Corner& direction) {
  Frame frame;
  frame.axis = unit(direction);
  const bool upright = std::abs(frame.axis[2]) > 0.9;
  frame.first = unit(cross(upright ? Corner{0, 1, 0} : Corner{0, 0, 1}, frame.axis));
  frame.second = cross(frame.axis, frame.first);
  return frame;
}

/// Adds a ring of points about `centre` across the axis; one point if it has no radius.
Ring add_ring(const Frame& frame, const Corner& centre, double radius, std::uint32_t count, double begin,
              TriangleSurface& surface) {
  Ring ring;
  ring.begin = begin;
  for (std::uint32_t k = 0; k < count; ++k) {
    const double angle = full_turn * (k + begin) / count;
    ring.points.push_back(static_cast<std::uint32_t>(surface.points.size()));
    const Corner beside = along(centre, radius * std::cos(angle), frame.first);
    surface.points.push_back(along(beside, radius * std::sin(angle), frame.second));
  }
  return ring;
}

}  // namespace

TriangleSurface ellipsoid_surface(const Corner& centre, const Corner& semi_axes, double edge) {
  constexpr double mean_edge = 1.13;  // of the icosahedron's faces on the unit sphere
  const double longest = *std::max_element(semi_axes.begin(), semi_axes.end());
  TriangleSurface surface = unit_sphere(static_cast<int>(pieces(mean_edge * longest, edge, 2)));
  for (Corner& x : surface.points)
    for (std::size_t a = 0; a < 3; ++a) x[a] = centre[a] + semi_axes[a] * x[a];
  return surface;
}

TriangleSurface capsule_surface(const Corner& from, const Corner& to, double radius, double edge) {
  const double row = edge * std::numbers::sqrt3 / 2;
  const Corner way = along(to, -1, from);
  const double straight = length(way);
  const Frame frame = frame_along(way);
  const std::uint32_t around = pieces(full_turn * radius, edge, 6), cap = pieces(full_turn / 4 * radius, row, 2);
  const std::uint32_t rows = pieces(straight, row, 1);
  TriangleSurface surface;
  std::vector<Ring> rings;
  const auto add_cap_ring = [&](const Corner& end, double height, std::uint32_t k) {
    const double angle = full_turn / 4 * k / cap, r = k == 0 ? 0 : radius * std::sin(angle);
    const std::uint32_t count = k == 0 ? 1 : pieces(full_turn * r, edge, 5);
    rings.push_back(add_ring(frame, along(end, height * std::cos(angle), frame.axis), r, count,
                             rings.size() % 2 == 0 ? 0 : 0.5, surface));
  };
  for (std::uint32_t k = 0; k < cap; ++k) add_cap_ring(from, -radius, k);
  for (std::uint32_t k = 0; k <= rows; ++k)
    rings.push_back(add_ring(frame, along(from, straight * k / rows, frame.axis), radius, around,
                             rings.size() % 2 == 0 ? 0 : 0.5, surface));
  for (std::uint32_t k = cap; k-- > 0;) add_cap_ring(to, radius, k);
  stitch_all(rings, surface);
  return surface;
}

TriangleSurface tube_surface(const Corner& from, const Corner& to, const std::vector<Point>& section, double edge) {
  const Corner way = along(to, -1, from);
  const double straight = length(way);
  const Frame frame = frame_along(way);
  const std::uint32_t rows = pieces(straight, edge * std::numbers::sqrt3 / 2, 1);
  TriangleSurface surface;
  std::vector<Ring> rings;
  const auto add_point = [&](double height, double first, double second) {
    const Corner middle = along(from, height, frame.axis);
    surface.points.push_back(along(along(middle, first, frame.first), second, frame.second));
    return static_cast<std::uint32_t>(surface.points.size() - 1);
  };
  rings.push_back({{add_point(0, 0, 0)}});
  for (std::uint32_t k = 0; k <= rows; ++k) {
    Ring ring{{}, k % 2 == 0 ? 0 : 0.5};
    for (std::size_t n = k % 2; n < section.size(); n += 2)
      ring.points.push_back(add_point(straight * k / rows, section[n][0], section[n][1]));
    rings.push_back(std::move(ring));
  }
  rings.push_back({{add_point(straight, 0, 0)}});
  stitch_all(rings, surface);
  return surface;
}

TriangleSurface disc_pillow_surface(const Corner& centre, double radius, double thickness, double edge) {
  const std::uint32_t rings_of_a_side = pieces(radius, edge, 2);
  const Frame frame{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  TriangleSurface surface;
  std::vector<Ring> rings;
  const Arc arc(radius, 0.5 * thickness);
  const auto add = [&](std::uint32_t k, double side) {
    const double r = radius * k / rings_of_a_side;
    const Corner middle = along(centre, side * arc.height(r), frame.axis);
    rings.push_back(add_ring(frame, middle, arc.across(r), k == 0 ? 1 : 6 * k, 0, surface));
    for (std::uint32_t point = 0; point < rings.back().points.size(); ++point) {
      const double angle = full_turn * point / static_cast<double>(rings.back().points.size());
      surface.unstretched.push_back({centre[0] + r * std::cos(angle), centre[1] + r * std::sin(angle), centre[2]});
    }
  };
  for (std::uint32_t k = 0; k < rings_of_a_side; ++k) add(k, -1);
  for (std::uint32_t k = rings_of_a_side + 1; k-- > 0;) add(k, 1);
  stitch_all(rings, surface);
  return surface;
}

TriangleSurface pillow_surface(const Corner& centre, double length_x, double length_y, double thickness, double edge) {
  const std::uint32_t nx = pieces(length_x, edge, 2), ny = pieces(length_y, edge, 2);
  TriangleSurface surface;
  const Arc along_x(0.5 * length_x, 0.5 * thickness);
  const auto add_point = [&](std::uint32_t i, std::uint32_t j, double side) {
    const double u = length_x * (static_cast<double>(i) / nx - 0.5), v = length_y * (static_cast<double>(j) / ny - 0.5);
    const Arc across(0.5 * length_y, i == 0 || i == nx ? 0.0 : along_x.height(u));
    surface.unstretched.push_back({centre[0] + u, centre[1] + v, centre[2]});
    surface.points.push_back(
        {centre[0] + along_x.across(u), centre[1] + across.across(v), centre[2] + side * across.height(v)});
  };
  std::vector<std::uint32_t> sheet[2];
  for (int side = 0; side < 2; ++side)
    for (std::uint32_t j = 0; j <= ny; ++j)
      for (std::uint32_t i = 0; i <= nx; ++i) {
        const bool rim = i == 0 || j == 0 || i == nx || j == ny;
        if (side == 1 && rim) {
          sheet[1].push_back(sheet[0][i + j * (nx + 1)]);
          continue;
        }
        sheet[side].push_back(static_cast<std::uint32_t>(surface.points.size()));
        add_point(i, j, side == 0 ? 1 : -1);
      }
  for (int side = 0; side < 2; ++side)
    for (std::uint32_t j = 0; j < ny; ++j)
      for (std::uint32_t i = 0; i < nx; ++i) {
        const auto at = [&](std::uint32_t a, std::uint32_t b) { return sheet[side][i + a + (j + b) * (nx + 1)]; };
        const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
          if (side == 0) surface.triangles.push_back({a, b, c});
          if (side == 1) surface.triangles.push_back({a, c, b});
        };
        // Diagonals lead to the corners, where a triangle of rim points only would be one of both sheets.
        if ((2 * i + 1 < nx) == (2 * j + 1 < ny)) {
          add(at(0, 0), at(1, 0), at(1, 1));
          add(at(0, 0), at(1, 1), at(0, 1));
        } else {
          add(at(0, 0), at(1, 0), at(0, 1));
          add(at(1, 0), at(1, 1), at(0, 1));
        }
      }
  return surface;
}

}  // namespace geodrop
