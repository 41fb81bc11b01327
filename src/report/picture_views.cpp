#include "picture_views.hpp"

#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "frame_cut.hpp"

namespace geodrop {
namespace {

constexpr Facing of_the_plane{{0, 1, 2}, 1, ""};
constexpr Facing side{{0, 2, 1}, -1, "side view"}, front{{1, 2, 0}, 1, "front view"};

/// Into the coordinates of a picture.
void turn(std::vector<double>& points, const Facing& facing) {
  for (std::size_t i = 0; i < points.size(); i += 3) {
    const std::array<double, 3> x{points[i], points[i + 1], points[i + 2]};
    for (std::size_t a = 0; a < 3; ++a) points[i + a] = x[facing.axis[a]];
    points[i + 2] *= facing.toward;
  }
}

bool is_removed(const Scene& scene, const std::string& rigid, double t) {
  return std::ranges::any_of(scene.stages, [&](const StageSpec& stage) {
    return stage.from <= t && std::ranges::find(stage.removes, rigid) != stage.removes.end();
  });
}

/// Frames have no half-spaces: the lines of those that rest and are seen edge on, right across the domain.
void add_half_spaces(const Scene& scene, const Facing& facing, double t, RigidSnapshot& rigid) {
  constexpr double edge_on = 1e-9;
  double far = 0;
  for (std::size_t a = 0; a < 3; ++a) far += scene.grid.upper[a] - scene.grid.lower[a];
  for (std::size_t r = 0; r < scene.rigid.size(); ++r) {
    const RigidSpec& body = scene.rigid[r];
    const auto* shape = std::get_if<HalfPlaneShape>(&body.shape);
    if (!shape || !std::holds_alternative<std::monostate>(body.motion) || is_removed(scene, body.name, t)) continue;
    if (std::abs(shape->normal[facing.axis[2]]) > edge_on) continue;
    const double across = shape->normal[facing.axis[0]], up = shape->normal[facing.axis[1]];
    const double length = std::hypot(across, up);
    for (const double way : {-far / length, far / length}) {
      rigid.connectivity.push_back(static_cast<std::uint32_t>(rigid.points.size() / 3));
      rigid.points.insert(rigid.points.end(),
                          {shape->point[facing.axis[0]] - way * up, shape->point[facing.axis[1]] + way * across, 0});
    }
    rigid.rigid.push_back(static_cast<std::uint32_t>(r));
  }
}

/// What is seen without any cut.
Snapshot outside_of(const Snapshot& snapshot) {
  Snapshot frame;
  frame.t = snapshot.t;
  frame.membranes = snapshot.membranes;
  frame.rigid = snapshot.rigid;
  return frame;
}

View view_of(const Scene& scene, const Snapshot& snapshot, const Facing& facing, Sight sight, double place) {
  constexpr double reach = 0.5;  // cells: two layers of particles, of two along each axis
  const std::string depth(1, "xyz"[facing.axis[2]]);
  View view{facing, facing.name, {}};
  if (sight == Sight::cut) {
    view.title += ", cut at " + depth + " = " + format_number(place) + " m";
    view.frame = cut_frame(snapshot, {facing.axis[2], place}, reach * scene.grid.spacing);
  } else {
    view.title += std::string(", seen from ") + (facing.toward > 0 ? "+" : "-") + depth;
    view.frame = outside_of(snapshot);
  }
  turn(view.frame.particles.points, facing);
  turn(view.frame.membranes.points, facing);
  turn(view.frame.rigid.points, facing);
  add_half_spaces(scene, facing, snapshot.t, view.frame.rigid);
  return view;
}

/// The plane of symmetry across an axis at which a membrane ends.
std::optional<double> plane_of_symmetry(const Scene& scene, int axis) {
  for (const MembraneSpec& membrane : scene.membranes)
    if (std::ranges::count(membrane.drawn.ends, axis, &SurfaceEnd::axis) == 1)
      return std::ranges::find(membrane.drawn.ends, axis, &SurfaceEnd::axis)->place;
  return {};
}

/// Of the membranes, without any of the domain, along x and y; to a tenth of a cell, which titles tell. A plane of
/// symmetry is in the middle of both halves.
std::array<double, 2> middle_of(const Scene& scene, const Snapshot& snapshot) {
  Extent extent = extent_of(snapshot.membranes.points);
  if (snapshot.membranes.points.empty()) {
    extent.add(scene.grid.lower.data());
    extent.add(scene.grid.upper.data());
  }
  const double step = 0.1 * scene.grid.spacing;
  std::array<double, 2> middle{};
  for (std::size_t a = 0; a < 2; ++a) {
    const double between = step * std::round(0.5 * (extent.lower[a] + extent.upper[a]) / step) + 0.0;  // no -0
    middle[a] = plane_of_symmetry(scene, static_cast<int>(a)).value_or(between);
  }
  return middle;
}

}  // namespace

bool is_plane_without_end(const Scene& scene, std::uint32_t rigid) {
  return rigid < scene.rigid.size() && std::holds_alternative<HalfPlaneShape>(scene.rigid[rigid].shape);
}

std::vector<BodyLines> lines_by_body(const RigidSnapshot& rigid) {
  std::vector<BodyLines> bodies;
  for (std::size_t line = 0; line < rigid.rigid.size(); ++line) {
    if (line == 0 || rigid.rigid[line] != rigid.rigid[line - 1]) bodies.push_back({line, line});
    bodies.back().end = line + 1;
  }
  return bodies;
}

void Extent::add(const double* point) {
  for (std::size_t a = 0; a < 3; ++a) {
    lower[a] = std::min(lower[a], point[a]);
    upper[a] = std::max(upper[a], point[a]);
  }
}

void Extent::widen(double margin) {
  for (std::size_t a = 0; a < 3; ++a) {
    lower[a] -= margin;
    upper[a] += margin;
  }
}

Extent extent_of(const std::vector<double>& points) {
  Extent extent;
  for (std::size_t i = 0; i < points.size(); i += 3) extent.add(&points[i]);
  return extent;
}

Extent whole_extent(const Scene& scene, const Snapshot& snapshot) {
  Extent extent = extent_of(snapshot.particles.points);
  for (std::size_t i = 0; i < snapshot.membranes.points.size(); i += 3) extent.add(&snapshot.membranes.points[i]);
  for (std::size_t line = 0; line < snapshot.rigid.rigid.size(); ++line)
    if (!is_plane_without_end(scene, snapshot.rigid.rigid[line]))
      extent.add(&snapshot.rigid.points[3 * snapshot.rigid.connectivity[2 * line]]);
  if (scene.dimension == 3) {
    extent.add(scene.grid.lower.data());
    extent.add(scene.grid.upper.data());
  }
  double largest = 0;
  for (int a = 0; a < scene.dimension; ++a) largest = std::max(largest, extent.size(static_cast<std::size_t>(a)));
  extent.widen(std::max(scene.grid.spacing, 0.02 * largest));
  return extent;
}

std::vector<View> views_of(const Scene& scene, const Snapshot& snapshot, Sight sight,
                           const std::optional<std::array<double, 2>>& cut) {
  if (scene.dimension == 2) return {View{of_the_plane, "", snapshot}};
  const std::array<double, 2> places = cut ? *cut : middle_of(scene, snapshot);
  return {view_of(scene, snapshot, side, sight, places[1]), view_of(scene, snapshot, front, sight, places[0])};
}

Window window_of(const Extent& extent, const Facing& facing) {
  const std::size_t right = facing.axis[0], up = facing.axis[1];
  return {{extent.lower[right], extent.lower[up]}, {extent.upper[right], extent.upper[up]}};
}

}  // namespace geodrop
