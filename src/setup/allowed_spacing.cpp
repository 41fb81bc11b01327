#include "allowed_spacing.hpp"

#include <geodrop/grid/graded_axis.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "grid/seams.hpp"

namespace geodrop {
namespace {

constexpr double whole_number = 1e-6;  // off by [cell]: 0.1 m does not divide 17 m exactly in binary
constexpr double largest_factor = 3;   // between a spacing and what is advised instead
constexpr int most_tries = 10000;      // of numbers of cells

/// What neither the checks of the grid nor those of its walls would complain about.
bool is_allowed(double spacing, const Scene& scene) {
  GridSpec grid = scene.grid;
  grid.spacing = spacing;
  for (std::size_t axis = 0; axis < grid.lower.size(); ++axis) {
    if (!divides(spacing, grid, axis)) return false;
    if (is_periodic(scene, axis) && std::lround(length_along(grid, axis) / spacing) < fewest_periodic_cells)
      return false;
  }
  const bool above_zones = std::all_of(grid.refine.begin(), grid.refine.end(),
                                       [&](const RefineSpec& zone) { return zone.spacing < spacing; });
  return above_zones && cell_count(grid) <= most_cells;
}

/// Any allowed spacing divides the shortest axis without a zone, which has the fewest spacings to try [m]; infinite
/// if all axes have zones.
double shortest_without_zone(const GridSpec& grid) {
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t axis = 0; axis < grid.lower.size(); ++axis)
    if (!has_zone(grid, axis)) shortest = std::min(shortest, length_along(grid, axis));
  return shortest;
}

}  // namespace

double length_along(const GridSpec& grid, std::size_t axis) { return grid.upper[axis] - grid.lower[axis]; }

bool has_zone(const GridSpec& grid, std::size_t axis) {
  return std::any_of(grid.refine.begin(), grid.refine.end(),
                     [&](const RefineSpec& zone) { return zone.axis == static_cast<int>(axis); });
}

bool is_periodic(const Scene& scene, std::size_t axis) {
  return axis < scene.walls.lower.size() && scene.walls.lower[axis] == WallKind::periodic;
}

bool divides(double spacing, const GridSpec& grid, std::size_t axis) {
  const double count = length_along(grid, axis) / spacing;
  return has_zone(grid, axis) || (count >= 1 - whole_number && std::abs(count - std::round(count)) <= whole_number);
}

double cell_count(const GridSpec& grid) {
  double cells = 1;
  for (std::size_t axis = 0; axis < grid.lower.size(); ++axis)
    cells *= AxisMap(grid, static_cast<int>(axis)).wanted_cells();
  return cells;
}

double nearest_allowed_spacing(const Scene& scene) {
  const GridSpec& grid = scene.grid;
  const double shortest = shortest_without_zone(grid), count = std::round(shortest / grid.spacing);
  double best = 0;
  const auto consider = [&](double cells) {
    const double spacing = shortest / cells, away = std::abs(spacing - grid.spacing);
    if (cells < 1 || spacing > largest_factor * grid.spacing || spacing < grid.spacing / largest_factor) return;
    if ((best == 0 || away < std::abs(best - grid.spacing)) && is_allowed(spacing, scene)) best = spacing;
  };
  // From the nearest number of cells outwards: what is found first on a side is the nearest there.
  for (int k = 0; k <= most_tries && best <= grid.spacing; ++k) consider(count - k);
  for (int k = 1; k <= most_tries && (best == 0 || best >= grid.spacing); ++k) consider(count + k);
  return best;
}

double largest_allowed_spacing(const Scene& scene, double most) {
  const double shortest = shortest_without_zone(scene.grid);
  if (std::isinf(shortest)) return is_allowed(most, scene) ? most : 0.0;
  const double fewest = std::max(1.0, std::ceil(shortest / most));
  for (double cells = fewest; cells <= fewest + most_tries && cells <= largest_factor * fewest; ++cells)
    if (is_allowed(shortest / cells, scene)) return shortest / cells;
  return 0;
}

}  // namespace geodrop
