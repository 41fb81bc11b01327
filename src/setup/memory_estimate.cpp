#include "memory_estimate.hpp"

#include <geodrop/base/error.hpp>
#include <geodrop/geometry/shapes.hpp>
#include <geodrop/grid/graded_axis.hpp>
#include <geodrop/materials/materials.hpp>
#include <geodrop/scene/velocity_fields.hpp>
#include <geodrop/state/fields.hpp>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <numbers>

#include "base/text.hpp"
#include "lattice.hpp"
#include "scene/needs.hpp"

namespace geodrop {
namespace {

/// Share of the box around a shape that it fills; of half-planes, which the domain cuts, all.
double filled_share(const Shape& shape) {
  if (const auto* ellipse = std::get_if<EllipseShape>(&shape))
    return ellipse->semi_axes.size() == 2 ? std::numbers::pi / 4 : std::numbers::pi / 6;
  if (!std::holds_alternative<PolygonShape>(shape) && !std::holds_alternative<StadiumShape>(shape)) return 1;
  const Bounds box = bounds(shape);
  return area(shape) / ((box.upper[0] - box.lower[0]) * (box.upper[1] - box.lower[1]));
}

template <int Dim>
double sites(const Scene& scene, const BodySpec& body) {
  return static_cast<double>(Lattice<Dim>(scene, body).size());
}

/// Of the fields that its motion and its law need.
template <int Dim>
double numbers_per_particle(const Material& material) {
  std::size_t count = count_arrays<particle_role::every_body>(particle_fields<Dim>);
  const Particles<Dim> none;
  const auto add = [&](const auto& field) { for_each_component(field, [&](const auto&) { ++count; }); };
  std::visit([&](const auto& law) { law.state(none, add); }, material);
  return static_cast<double>(count);
}

/// Of the fields of particles and a copy of a frame [byte]; measured peaks are up to a third below.
double bytes_per_particle(const Scene& scene, const BodySpec& body) {
  constexpr double number = 8, frame = 105, numbers_and_scratch = 40;
  const Material material = law_of(scene, body);
  const double numbers = scene.dimension == 2 ? numbers_per_particle<2>(material) : numbers_per_particle<3>(material);
  return number * numbers + frame + numbers_and_scratch;
}

/// Of the machine, or less if the control group has a limit [byte].
double memory_here() {
  double memory = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  std::ifstream group("/sys/fs/cgroup/memory.max");
  if (double limit = 0; group >> limit) memory = std::min(memory, limit);
  return memory > 0 ? memory : std::numeric_limits<double>::infinity();
}

std::string in_gigabytes(double bytes) {
  constexpr double gigabyte = 1e9;
  return format_number(bytes / gigabyte, 2) + " GB";
}

}  // namespace

MemoryEstimate estimate_memory(const Scene& scene) {
  constexpr double bytes_per_cell = 185;   // of the arrays in grid.hpp, all of them in use
  constexpr double program_itself = 25e6;  // with its libraries: peaks of the smallest runs (Debian 12, two threads)
  MemoryEstimate estimate;
  estimate.bytes = program_itself;
  for (const BodySpec& body : scene.bodies) {
    const double count =
        filled_share(body.shape) * (scene.dimension == 2 ? sites<2>(scene, body) : sites<3>(scene, body));
    estimate.particles += count;
    estimate.bytes += count * bytes_per_particle(scene, body);
  }
  estimate.cells = count_velocity_fields(scene);
  for (int axis = 0; axis < scene.dimension; ++axis) estimate.cells *= AxisMap(scene.grid, axis).wanted_cells();
  estimate.bytes += estimate.cells * bytes_per_cell;
  return estimate;
}

std::string describe(const MemoryEstimate& estimate) {
  return "about " + in_gigabytes(estimate.bytes) + " for " + format_number(estimate.particles, 2) + " particles and " +
         format_number(estimate.cells, 2) + " cells";
}

void require_memory(const Scene& scene) {
  const MemoryEstimate estimate = estimate_memory(scene);
  if (const double here = memory_here(); estimate.bytes > here)
    throw SceneError(
        scene.file, {{{1, 1},
                      "grid.spacing",
                      "a scene that takes " + describe(estimate),
                      "at most " + in_gigabytes(here) + ", the memory here: a larger spacing, fewer particles per cell",
                      ProblemSource::scene}});
}

}  // namespace geodrop
