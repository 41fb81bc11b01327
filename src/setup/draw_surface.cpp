#include "draw_surface.hpp"

#include <geodrop/base/input_file.hpp>
#include <geodrop/geometry/triangle_surface.hpp>
#include <geodrop/grid/graded_axis.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <utility>

#include "geometry/corner.hpp"
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

bool leaves(const GridSpec& grid, const Extent& extent) {
  for (std::size_t a = 0; a < extent.lower.size(); ++a)
    if (!(extent.lower[a] >= grid.lower[a] && extent.upper[a] <= grid.upper[a])) return true;
  return false;
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

SurfaceFault draw_surface(const GridSpec& grid, const std::string& scene_file, MembraneSpec& membrane) {
  constexpr double most_triangles = 2e6;
  const double edge = finest_spacing(grid) / membrane.segments_per_cell;
  const Extent extent = extent_of(membrane.surface);
  SurfaceFault outside{"a surface that leaves the grid", "a surface inside the grid"};
  if (leaves(grid, extent)) return outside;
  if (!(extent.area <= most_triangles * std::sqrt(3.0) / 4 * edge * edge))
    return {"a surface of more than 2 million triangles", "one with fewer, by larger cells or fewer segments_per_cell"};
  SurfaceFromFile drawn = std::visit(Drawing{edge, scene_file}, membrane.surface);
  if (!drawn.fault.empty())
    return {
        drawn.fault,
        "a sphere, an ellipsoid, a capsule with length, a pillow of at most 0.7 of its cloth, or a .stl or .obj file"};
  const std::string fault = fault_of(drawn.surface);
  if (!fault.empty()) return {fault, "a closed surface of triangles that have an area and face outwards"};
  membrane.drawn.region = std::make_shared<SurfaceRegion>(std::move(drawn.surface));
  for (std::size_t a = 0; a < 3; ++a)
    if (membrane.drawn.region->lower()[a] < grid.lower[a] || membrane.drawn.region->upper()[a] > grid.upper[a])
      return outside;
  return {};
}

}  // namespace geodrop
