#include "draw_surface.hpp"

#include <geodrop/base/input_file.hpp>
#include <geodrop/geometry/shapes.hpp>
#include <geodrop/geometry/triangle_surface.hpp>
#include <geodrop/grid/graded_axis.hpp>
#include <geodrop/scene/wall_names.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <utility>

#include "geometry/corner.hpp"
#include "geometry/surface_ends.hpp"
#include "geometry/surface_file.hpp"
#include "geometry/surface_generators.hpp"

namespace geodrop {
namespace {

/// The box around a surface before it is drawn, and its area: a radius of 1e9 m would be drawn for ever.
struct Extent {
  Point lower, upper;  ///< none of a file
  double area = 0;     ///< [m2]

  void add(const Point& centre, const Point& half) {
    if (lower.empty()) lower = upper = centre;
    for (std::size_t a = 0; a < 3; ++a) {
      lower[a] = std::min(lower[a], centre[a] - half[a]);
      upper[a] = std::max(upper[a], centre[a] + half[a]);
    }
  }
};

Extent extent_of(const SurfaceSpec& spec) {
  constexpr double pi = std::numbers::pi;
  Extent extent;
  if (const auto* s = std::get_if<EllipsoidSurface>(&spec)) {
    extent.add(s->centre, s->semi_axes);
    extent.area = 4 * pi * std::pow(*std::max_element(s->semi_axes.begin(), s->semi_axes.end()), 2);
  } else if (const auto* capsule = std::get_if<CapsuleSurface>(&spec)) {
    for (const Point& end : {capsule->from, capsule->to}) extent.add(end, Point(3, capsule->radius));
    double length = 2 * capsule->radius;
    for (std::size_t a = 0; a < 3; ++a) length += std::abs(capsule->to[a] - capsule->from[a]);
    extent.area = 2 * pi * capsule->radius * length;
  } else if (const auto* tube = std::get_if<TubeSurface>(&spec)) {
    const double most = std::max(tube->half_width, tube->half_height);
    const Corner way = difference(to_corner(tube->to), to_corner(tube->from));
    const double straight = std::sqrt(dot(way, way));
    Point half(3);
    for (std::size_t a = 0; a < 3; ++a)
      half[a] = most * std::sqrt(std::max(0.0, 1 - std::pow(way[a] / std::max(straight, 1e-300), 2)));
    for (const Point& end : {tube->from, tube->to}) extent.add(end, half);
    extent.area = 2 * pi * most * (straight + most);
  } else if (const auto* pillow = std::get_if<PillowSurface>(&spec)) {
    const double t = pillow->thickness;  // a sheet that rises by half of it and comes down again is at least this long
    extent.add(pillow->centre, {std::max(0.0, pillow->length - t) / 2, std::max(0.0, pillow->width - t) / 2, t / 2});
    extent.area = 2 * pillow->length * pillow->width;
  } else if (const auto* disc = std::get_if<DiscPillowSurface>(&spec)) {
    const double least = std::max(0.0, disc->radius - disc->thickness / 2);
    extent.add(disc->centre, {least, least, disc->thickness / 2});
    extent.area = 2 * pi * disc->radius * disc->radius;
  }
  return extent;
}

/// Whether a box leaves the grid otherwise than at an end.
template <class Place>
bool leaves(const GridSpec& grid, const std::vector<SurfaceEnd>& ends, const Place& lower, const Place& upper) {
  const auto ends_there = [&](std::size_t a, bool above) {
    return std::ranges::any_of(
        ends, [&](const SurfaceEnd& end) { return end.axis == static_cast<int>(a) && end.upper == above; });
  };
  for (std::size_t a = 0; a < lower.size(); ++a)
    if ((!(lower[a] >= grid.lower[a]) && !ends_there(a, false)) ||
        (!(upper[a] <= grid.upper[a]) && !ends_there(a, true)))
      return true;
  return false;
}

/// The walls at which a membrane ends, in the order of their numbers; a mistake in them.
SurfaceFault find_ends(const GridSpec& grid, const WallsSpec& walls, const MembraneSpec& membrane,
                       std::vector<SurfaceEnd>& ends) {
  const std::string allowed = "\"left\", \"right\", \"front\", \"back\", \"bottom\" or \"top\", each once";
  std::array<bool, wall_names.size()> there{};
  for (const std::string& name : membrane.ends_at) {
    const auto wall = std::ranges::find(wall_names, name) - wall_names.begin();
    if (wall == std::ssize(wall_names)) return {"the wall \"" + name + '"', allowed, ".ends_at"};
    if (there[static_cast<std::size_t>(wall)]) return {'"' + name + "\" twice", allowed, ".ends_at"};
    there[static_cast<std::size_t>(wall)] = true;
  }
  std::size_t axes = 0;
  for (std::size_t wall = 0; wall < wall_names.size(); ++wall) {
    if (!there[wall]) continue;
    const std::size_t axis = wall / 2;
    const bool upper = wall % 2 == 1;
    if ((upper ? walls.upper : walls.lower)[axis] != WallKind::slip)
      return {std::string("the wall \"") + wall_names[wall] + "\", which is no slip wall", "walls of kind \"slip\"",
              ".ends_at"};
    if (ends.empty() || ends.back().axis != static_cast<int>(axis)) ++axes;
    ends.push_back({static_cast<int>(axis), upper, (upper ? grid.upper : grid.lower)[axis]});
  }
  if (axes > 2 || (axes == 2 && ends.size() > 2))
    return {std::to_string(ends.size()) + " walls across " + std::to_string(axes) + " axes",
            "both walls of one axis, or one of each of two", ".ends_at"};
  return {};
}

/// Even in number, every second one of a ring.
std::vector<Point> section_of(const TubeSurface& tube, double edge) {
  const Point centre{0, 0}, semi_axes{tube.half_width, tube.half_height};
  const Shape shape = tube.section == TubeSurface::Section::ellipse
                          ? Shape(EllipseShape{centre, semi_axes, tube.tilt_deg})
                          : Shape(StadiumShape{centre, semi_axes, tube.tilt_deg});
  const double around = perimeter(shape);
  return outline(shape, around / (2 * std::max(3.0, std::round(around / edge))));
}

/// Of triangles with equal sides that have the same area [m].
double mean_edge(const TriangleSurface& surface) {
  return std::sqrt(4 / std::sqrt(3.0) * area(surface) / static_cast<double>(surface.triangles.size()));
}

struct Drawing {
  double edge;  ///< [m]
  const std::string& scene_file;

  SurfaceFromFile operator()(std::monostate) const { return {{}, "no surface"}; }
  SurfaceFromFile operator()(const EllipsoidSurface& s) const {
    return {ellipsoid_surface(to_corner(s.centre), to_corner(s.semi_axes), edge), ""};
  }
  SurfaceFromFile operator()(const CapsuleSurface& s) const {
    if (s.from == s.to) return {{}, "a capsule without length"};
    return {capsule_surface(to_corner(s.from), to_corner(s.to), s.radius, edge), ""};
  }
  SurfaceFromFile operator()(const TubeSurface& s) const {
    if (s.from == s.to) return {{}, "a tube without length"};
    return {tube_surface(to_corner(s.from), to_corner(s.to), section_of(s, edge), edge), ""};
  }
  SurfaceFromFile operator()(const PillowSurface& s) const {
    if (s.thickness > most_open * std::min(s.length, s.width)) return {{}, "a pillow that is too thick for its cloth"};
    return {pillow_surface(to_corner(s.centre), s.length, s.width, s.thickness, edge), ""};
  }
  SurfaceFromFile operator()(const DiscPillowSurface& s) const {
    if (s.thickness > most_open * 2 * s.radius) return {{}, "a pillow that is too thick for its cloth"};
    return {disc_pillow_surface(to_corner(s.centre), s.radius, s.thickness, edge), ""};
  }
  SurfaceFromFile operator()(const FileSurface& s) const {
    const std::string path = surface_path(scene_file, s.file), ending = std::filesystem::path(s.file).extension();
    if (ending != ".stl" && ending != ".obj") return {{}, "a file that ends in \"" + ending + '"'};
    const InputFile input = open_input(path);
    if (!input.file) return {{}, path + ": " + input.fault};
    const std::string content = read_input(path, "surface.file", "a surface");
    return ending == ".stl" ? parse_stl(content) : parse_obj(content);
  }
};

}  // namespace

std::string surface_path(const std::string& scene_file, const std::string& file) {
  return std::filesystem::absolute(std::filesystem::path(scene_file).parent_path() / file).lexically_normal();
}

SurfaceFault draw_surface(const GridSpec& grid, const WallsSpec& walls, const std::string& scene_file,
                          MembraneSpec& membrane) {
  constexpr double most_triangles = 2e6, most_moved = 0.3;  // of an edge
  const double edge = finest_spacing(grid) / membrane.segments_per_cell;
  std::vector<SurfaceEnd> ends;
  if (SurfaceFault fault = find_ends(grid, walls, membrane, ends); !fault.found.empty()) return fault;
  const Extent extent = extent_of(membrane.surface);
  SurfaceFault outside{"a surface that leaves the grid",
                       "a surface inside the grid, or ends_at the walls beyond which it is"};
  if (leaves(grid, ends, extent.lower, extent.upper)) return outside;
  if (!(extent.area <= most_triangles * std::sqrt(3.0) / 4 * edge * edge))
    return {"a surface of more than 2 million triangles", "one with fewer, by larger cells or fewer segments_per_cell"};
  SurfaceFromFile drawn = std::visit(Drawing{edge, scene_file}, membrane.surface);
  if (!drawn.fault.empty())
    return {drawn.fault,
            "a sphere, an ellipsoid, a capsule or tube with length, a pillow of at most 0.7 of its cloth, or a .stl or "
            ".obj file"};
  const std::string fault = fault_of(drawn.surface);
  if (!fault.empty()) return {fault, "a closed surface of triangles that have an area and face outwards"};
  for (const SurfaceEnd& end : ends) {
    drawn.surface = cut_off(std::move(drawn.surface), end, most_moved * mean_edge(drawn.surface));
    if (open_edges(drawn.surface, end).empty())
      return {"a surface that does not reach a wall of ends_at",
              "one that reaches beyond it, or up to it with a flat end", ".ends_at"};
  }
  membrane.drawn.cloth = std::make_shared<TriangleSurface>(drawn.surface);
  membrane.drawn.region = std::make_shared<SurfaceRegion>(with_fans(std::move(drawn.surface), ends));
  membrane.drawn.ends = std::move(ends);
  if (leaves(grid, {}, membrane.drawn.region->lower(), membrane.drawn.region->upper())) return outside;
  return {};
}

}  // namespace geodrop
