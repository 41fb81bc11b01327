#include "doubtful_setting.hpp"

#include <geodrop/base/find_named.hpp>
#include <geodrop/geometry/shapes.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text.hpp"
#include "open_fluid.hpp"
#include "scene/needs.hpp"
#include "setup/allowed_spacing.hpp"
#include "setup/memory_estimate.hpp"

namespace geodrop {
namespace {

constexpr int digits = 3;

std::string number(double value) { return format_number(value, digits); }

double top_of(const Scene& scene, const BodySpec& body) {
  return bounds_within(body.shape, {scene.grid.lower, scene.grid.upper}).upper.back();
}

/// Whether a body has no surface of its own: it fills a membrane, or the pores of a soil that does.
bool is_bagged(const Scene& scene, const BodySpec& body) {
  return is_enclosed(scene, body) || std::ranges::any_of(scene.bodies, [&](const BodySpec& soil) {
           return soil.saturated_by == body.name && is_enclosed(scene, soil);
         });
}

/// Height of the open fluid of a material; -infinity if there is none.
double top_of_fluid(const Scene& scene, const std::string& material) {
  double top = -std::numeric_limits<double>::infinity();
  for (const BodySpec& body : scene.bodies)
    if (body.material == material && !is_bagged(scene, body)) top = std::max(top, top_of(scene, body));
  return top;
}

std::string surface_doubt(const Scene& scene, const BodySpec& body) {
  const HydrostaticSpec* still = still_fluid_of(body.initial_stress);
  const double top = still ? top_of_fluid(scene, still->fluid) : 0;
  if (!still || !std::isfinite(top) || std::abs(still->surface - top) <= scene.grid.spacing) return {};
  return "bodies." + body.name + ".initial_stress: the surface of \"" + still->fluid + "\" at " +
         number(still->surface) + " m is not where that fluid ends, " + number(top) +
         " m: it would start with waves of " + number(std::abs(still->surface - top)) + " m of water";
}

/// Of long waves, over the speed of sound.
std::string wave_speed_doubt(const Scene& scene, const BodySpec& body) {
  const NewtonianSpec* fluid = fluid_of(scene, body);
  const double g = strength_of_gravity(scene);
  if (!fluid || g <= 0 || is_bagged(scene, body)) return {};
  const Bounds box = bounds_within(body.shape, {scene.grid.lower, scene.grid.upper});
  const double speed = std::sqrt(g * (box.upper.back() - box.lower.back()));
  const double sound = std::sqrt(fluid->bulk_modulus / fluid->density);
  constexpr double most = 0.3;
  if (speed <= most * sound) return {};
  return "materials." + body.material + ": sound travels at " + number(sound) + " m/s, long waves of \"" + body.name +
         "\" at sqrt(g H) = " + number(speed) + " m/s: a Mach number of " + number(speed / sound) +
         ", a fluid is weakly compressible up to 0.3 only; take a sound_speed of " + number(10 * speed) + " m/s";
}

std::string seed_doubt(const Scene&, const BodySpec& body) {
  if (body.jitter_seed == 0 || body.jitter > 0) return {};
  return "bodies." + body.name + ".jitter_seed = " + std::to_string(body.jitter_seed) + " changes nothing: bodies." +
         body.name + ".jitter is 0";
}

/// What makes cells along an axis no wider than `most` [m].
std::string finer_cells(const Scene& scene, std::size_t axis, double most) {
  if (has_zone(scene.grid, axis)) return "take a finer zone of grid.refine";
  const double fine = largest_allowed_spacing(scene, most);
  return fine > 0 ? fmt::format("take grid.spacing = {} [m]", fine) : "no grid.spacing fine enough divides the domain";
}

bool from_wall_to_wall(const Scene& scene, const Bounds& box, std::size_t axis) {
  return box.lower[axis] <= scene.grid.lower[axis] && box.upper[axis] >= scene.grid.upper[axis];
}

/// Of the cells along an axis, the finest.
double finest_spacing(const GridSpec& grid, std::size_t axis) {
  double finest = grid.spacing;
  for (const RefineSpec& zone : grid.refine)
    if (zone.axis == static_cast<int>(axis)) finest = std::min(finest, zone.spacing);
  return finest;
}

/// How far a body extends along an axis [m]; with its image if a membrane around it ends at one wall across the axis.
double extent_with_image(const Scene& scene, const BodySpec& body, const Bounds& box, std::size_t axis) {
  const double extent = box.upper[axis] - box.lower[axis];
  const auto* inside = std::get_if<InsideShape>(&body.shape);
  if (!inside) return extent;
  const MembraneSpec& membrane = find_named(scene.membranes, inside->membrane);
  const auto ends = std::ranges::count(membrane.drawn.ends, static_cast<int>(axis), &SurfaceEnd::axis);
  return ends == 1 ? 2 * extent : extent;
}

/// Fewer cells give the shape of the grid, not that of the membrane.
std::string coarse_content_doubt(const Scene& scene, const BodySpec& body) {
  constexpr double least_cells = 4, chords = 0.02;  // by which a surface of triangles lies within its ellipsoid
  if (!in_geotextile(scene, body)) return {};
  const Bounds box = bounds_within(body.shape, {scene.grid.lower, scene.grid.upper});
  for (std::size_t axis = box.lower.size(); axis-- > 0;) {  // the height first
    const double extent = extent_with_image(scene, body, box, axis), cells = extent / finest_spacing(scene.grid, axis);
    if (from_wall_to_wall(scene, box, axis) || cells >= least_cells * (1 - chords)) continue;
    return "bodies." + body.name + " is " + number(cells) + " cells " +
           (axis + 1 == box.lower.size() ? "high" : "wide") + ": a body within a membrane has to have at least four; " +
           finer_cells(scene, axis, extent / least_cells);
  }
  return {};
}

/// Only particles of cells all of whose neighbours are full are shifted (transfer/gather).
std::string shift_doubt(const Scene& scene, const BodySpec& body) {
  if (!body.shift)
    return body.shift_speed > 0 ? "bodies." + body.name + ".shift_speed acts on nothing: shift is false" : "";
  constexpr double least_cells = 4;
  const Bounds box = bounds_within(body.shape, {scene.grid.lower, scene.grid.upper});
  double fewest = std::numeric_limits<double>::infinity();
  std::size_t axis = 0;
  for (std::size_t i = 0; i < box.lower.size(); ++i) {
    const double cells = extent_with_image(scene, body, box, i) / finest_spacing(scene.grid, i);
    if (from_wall_to_wall(scene, box, i) || cells >= fewest) continue;
    fewest = cells;
    axis = i;
  }
  if (fewest >= least_cells) return {};
  return "bodies." + body.name + ".shift moves few particles or none: the body is " + number(fewest) +
         " cells across, and only cells with full neighbours on all sides are evened out; " +
         finer_cells(scene, axis, extent_with_image(scene, body, box, axis) / least_cells);
}

/// Nothing but a bed's grains, which have a velocity of their own, bear a membrane.
std::string bed_doubt(const Scene& scene, const MembraneSpec& membrane) {
  if (membrane.interface != Interface::sharp || lies_on_grains(scene, membrane)) return {};
  for (const BodySpec& body : scene.bodies)
    if (!body.saturated_by.empty() && !in_sharp_membrane(scene, body.name))
      return "membranes." + membrane.name + ".bed does not name \"" + body.name +
             "\", a coupled soil around: its grains would not bear the membrane, only the water between them";
  return {};
}

}  // namespace

std::vector<std::string> doubtful_water(const Scene& scene) {
  std::vector<std::string> found;
  for (const BodySpec& body : scene.bodies) {
    found.push_back(surface_doubt(scene, body));
    found.push_back(wave_speed_doubt(scene, body));
  }
  for (const MembraneSpec& membrane : scene.membranes) found.push_back(bed_doubt(scene, membrane));
  std::erase(found, "");
  return found;
}

std::vector<std::string> doubtful_numerics(const Scene& scene) {
  std::vector<std::string> found;
  constexpr double most_rate = 1e4, usual_2d = 0.5, usual_3d = 0.45;
  if (scene.solver.blend_rate > most_rate)
    found.push_back("solver.blend_rate = " + number(scene.solver.blend_rate) +
                    " 1/s is out of all scale: 0.1 to 100 damp what the grid cannot carry, more damps the motion");
  constexpr double farthest = 1e9;  // cells; places of particles are then exact to 1e-7 of a cell
  for (int a = 0; a < scene.dimension; ++a) {
    const double far = std::max(std::abs(scene.grid.lower[a]), std::abs(scene.grid.upper[a]));
    if (far > farthest * scene.grid.spacing)
      found.push_back("the domain is " + number(far) +
                      " m from the origin, over 1e9 cells: places of particles are "
                      "rounded; move it nearer");
  }
  const double usual = scene.dimension == 2 ? usual_2d : usual_3d;
  if (scene.solver.courant > usual)
    found.push_back("solver.courant = " + number(scene.solver.courant) + " is above " + number(usual) +
                    ", up to which splashing water was tried");
  for (const auto doubt_of : {shift_doubt, coarse_content_doubt, seed_doubt})
    for (const BodySpec& body : scene.bodies)
      if (std::string doubt = doubt_of(scene, body); !doubt.empty()) found.push_back(std::move(doubt));
  return found;
}

double output_bytes(const Scene& scene) {
  constexpr double bytes_per_particle = 130;  // of an uncompressed frame, base64: 4.5 MB of 34,920 particles
  constexpr double compressed = 0.7;
  const double frames = scene.time.end / scene.output.frame_interval + 1;
  return frames * estimate_memory(scene).particles * bytes_per_particle * (scene.output.compress ? compressed : 1);
}

std::vector<std::string> doubtful_output(const Scene& scene) {
  std::vector<std::string> found;
  constexpr double most_bytes = 20e9, mega = 1e6, most_rows = 1e6;
  const double bytes = output_bytes(scene);
  const double frames = scene.time.end / scene.output.frame_interval;
  if (bytes > most_bytes)
    found.push_back("output.frame_interval = " + number(scene.output.frame_interval) + " s asks for " + number(frames) +
                    " frames of about " + number(bytes / (frames + 1) / mega) +
                    " MB each; a run writes at most one in a step; take a longer interval" +
                    (scene.output.compress ? "" : ", or output.compress = true"));
  if (scene.output.frame_interval > scene.time.end)
    found.push_back("output.frame_interval is longer than the run: frames of its start and its end only");
  if (scene.time.end / scene.output.history_interval > most_rows)
    found.push_back("output.history_interval = " + number(scene.output.history_interval) + " s: up to " +
                    number(scene.time.end / scene.output.history_interval) + " rows of history.csv");
  return found;
}

}  // namespace geodrop
