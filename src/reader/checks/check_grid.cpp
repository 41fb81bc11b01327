// Checks of the grid, of the transfers that its basis allows, and of the walls.
#include "check_scene.hpp"

#include "grid/seams.hpp"

#include <geodrop/grid/graded_axis.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace geodrop {
namespace {

constexpr double kMostCells = 2e8;
constexpr double kRounding = 1e-6;  // of a cell: 0.1 m does not divide 17 m exactly in binary

double length_along(const GridSpec& grid, std::size_t axis) { return grid.upper[axis] - grid.lower[axis]; }

bool has_zone(const GridSpec& grid, std::size_t axis) {
  return std::any_of(grid.refine.begin(), grid.refine.end(),
                     [&](const RefineSpec& zone) { return zone.axis == static_cast<int>(axis); });
}

bool is_periodic(const Scene& scene, std::size_t axis) {
  return axis < scene.walls.lower.size() && scene.walls.lower[axis] == WallKind::periodic;
}

/// The spacing divides the axis, or zones of finer cells have their own way to do so.
bool divides(double spacing, const GridSpec& grid, std::size_t axis) {
  const double count = length_along(grid, axis) / spacing;
  return has_zone(grid, axis) || (count >= 1 - kRounding && std::abs(count - std::round(count)) <= kRounding);
}

/// Of a graded axis the cells that the closed form gives, also where they are too many to be built.
double cell_count(const GridSpec& grid) {
  double cells = 1;
  for (std::size_t axis = 0; axis < grid.lower.size(); ++axis)
    cells *= AxisMap(grid, static_cast<int>(axis)).wanted_cells();
  return cells;
}

/// What nothing in check_grid and check_walls would complain about.
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
  return above_zones && cell_count(grid) <= kMostCells;
}

/// The allowed spacing nearest to that of the scene, from a third of it to three times it; 0: none was found.
double nearest_allowed_spacing(const Scene& scene) {
  constexpr double kFactor = 3;
  constexpr int kMostTries = 10000;  // to either side
  const GridSpec& grid = scene.grid;
  // Any allowed spacing divides the shortest axis without a zone, which has the fewest spacings to try.
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t axis = 0; axis < grid.lower.size(); ++axis)
    if (!has_zone(grid, axis)) shortest = std::min(shortest, length_along(grid, axis));
  const double count = std::round(shortest / grid.spacing);
  double best = 0;
  const auto consider = [&](double cells) {
    const double spacing = shortest / cells, away = std::abs(spacing - grid.spacing);
    if (cells < 1 || spacing > kFactor * grid.spacing || spacing < grid.spacing / kFactor) return;
    if ((best == 0 || away < std::abs(best - grid.spacing)) && is_allowed(spacing, scene)) best = spacing;
  };
  // From the nearest number of cells outwards: what is found first on a side is the nearest there.
  for (int k = 0; k <= kMostTries && best <= grid.spacing; ++k) consider(count - k);
  for (int k = 1; k <= kMostTries && (best == 0 || best >= grid.spacing); ++k) consider(count + k);
  return best;
}

/// The upper corner of a domain that has whole cells, no smaller than it is.
Point whole_upper(const GridSpec& grid) {
  Point upper = grid.upper;
  for (std::size_t axis = 0; axis < upper.size(); ++axis)
    if (!divides(grid.spacing, grid, axis))
      upper[axis] = grid.lower[axis] + std::ceil(length_along(grid, axis) / grid.spacing) * grid.spacing;
  return upper;
}

/// Whole cells along all axes; says whether there is nothing to complain about.
bool check_spacing(const Scene& scene, Report& report) {
  const GridSpec& grid = scene.grid;
  std::string lengths;
  bool fits = true;
  for (std::size_t axis = 0; axis < grid.lower.size(); ++axis) {
    if (length_along(grid, axis) <= 0) {
      report.add("grid.upper", to_text(grid.upper),
                 "larger than grid.lower " + to_text(grid.lower) + " along each axis");
      return false;
    }
    fits = fits && divides(grid.spacing, grid, axis);
    if (has_zone(grid, axis)) continue;
    lengths += (lengths.empty() ? "" : " and ") + to_text(length_along(grid, axis)) + " m along " + "xyz"[axis];
  }
  if (fits) return true;
  const double nearest = nearest_allowed_spacing(scene);
  const std::string advice =
      nearest > 0 ? "; the nearest is " + to_text(nearest) + " [m]"
                  : "; none is near, but with grid.upper = " + to_text(whole_upper(grid)) + " this one does";
  report.add("grid.spacing", to_text(grid.spacing), "a spacing that divides the domain, " + lengths + advice);
  return false;
}

/// A zone of finer cells: along an axis that can have one, inside the domain, and finer.
void check_zone(const Scene& scene, const RefineSpec& zone, const std::string& key, Report& report) {
  const GridSpec& grid = scene.grid;
  const std::size_t axis = zone.axis;
  const double lower = grid.lower[axis], upper = grid.upper[axis];
  if (zone.to <= zone.from)
    report.add(key + ".to", to_text(zone.to), "above from = " + to_text(zone.from) + " [m]");
  else if (zone.from < lower || zone.to > upper)
    report.add(key + (zone.from < lower ? ".from" : ".to"), to_text(zone.from < lower ? zone.from : zone.to),
               "a zone inside the grid, from " + to_text(lower) + " to " + to_text(upper) + " [m]");
  if (zone.spacing >= grid.spacing)
    report.add(key + ".spacing", to_text(zone.spacing),
               "below the spacing of the grid, " + to_text(grid.spacing) + " [m]");
  if (report.healthy("walls") && report.healthy("dimension") && is_periodic(scene, axis))
    report.add(key + ".axis", "an axis between periodic walls", "an axis between walls that are not periodic");
}

void check_zones(const Scene& scene, Report& report) {
  std::vector<int> seen;
  for (std::size_t i = 0; i < scene.grid.refine.size(); ++i) {
    const RefineSpec& zone = scene.grid.refine[i];
    const std::string& key = report.element("grid.refine", i);
    if (scene.grid.basis != Basis::bspline2) {
      report.add(key, "a zone of finer cells on a basis with cells of one size", "basis = \"bspline2\", or no zone");
      return;
    }
    if (std::find(seen.begin(), seen.end(), zone.axis) != seen.end())
      report.add(key + ".axis", "a second zone along the same axis", "at most one zone along each axis");
    seen.push_back(zone.axis);
    check_zone(scene, zone, key, report);
  }
}

/// Whole cells, not too many, and zones of finer ones.
void check_cells(const Scene& scene, Report& report) {
  if (!report.healthy("grid")) return;
  constexpr double kBytesPerCell = 185;  // of the arrays in grid.hpp, all of them in use
  if (!check_spacing(scene, report)) return;
  const GridSpec& grid = scene.grid;
  const double cells = cell_count(grid);
  if (cells <= kMostCells) return check_zones(scene, report);
  const auto count = [&](double n) {
    return to_text(std::round(n / 1e6)) + " million cells, about " + to_text(std::round(n * kBytesPerCell / 1e9)) +
           " GB of memory for the grid";
  };
  report.add("grid.spacing", to_text(grid.spacing) + ", which is " + count(cells), "at most " + count(kMostCells));
}

/// Triangles are for the plane, tetrahedra for space.
void check_basis(const Scene& scene, Report& report) {
  const bool plane = scene.dimension == 2;
  if (!report.healthy("grid.basis") || !report.healthy("dimension")) return;
  if (scene.grid.basis != (plane ? Basis::tet4 : Basis::tri3)) return;
  report.add("grid.basis", plane ? "\"tet4\" with dimension = 2" : "\"tri3\" with dimension = 3",
             plane ? "\"tri3\", or a basis that is no simplex" : "\"tet4\", or a basis that is no simplex");
}

/// Simplices have no affine transfer (grid/bases.hpp).
void check_transfer(const Scene& scene, Report& report) {
  if (!report.healthy("grid.basis") || !report.healthy("solver.transfer")) return;
  const Basis basis = scene.grid.basis;
  if (is_simplex(basis) && scene.solver.transfer != Transfer::musl)
    report.add("solver.transfer", "an affine transfer on simplices, where it is unstable", "\"musl\"");
  if (scene.solver.mass_matrix == MassMatrix::consistent && basis != Basis::bspline2 && basis != Basis::linear)
    report.add("solver.mass_matrix", "\"consistent\" on a basis whose lumping has no constant stencil",
               "\"lumped\", or grid.basis = \"bspline2\" or \"linear\"");
}

}  // namespace

void check_grid(const Scene& scene, Report& report) {
  check_cells(scene, report);
  check_basis(scene, report);
  check_transfer(scene, report);
}

/// Periodic walls come in pairs.
void check_walls(const Scene& scene, Report& report) {
  constexpr const char* kWalls[][2] = {{"left", "right"}, {"front", "back"}, {"bottom", "top"}};
  if (!report.healthy("walls") || !report.healthy("dimension")) return;
  for (std::size_t axis = 0; axis < scene.walls.lower.size(); ++axis) {
    const bool lower = scene.walls.lower[axis] == WallKind::periodic;
    const bool upper = scene.walls.upper[axis] == WallKind::periodic;
    const auto& pair = kWalls[axis + 1 == scene.walls.lower.size() ? 2 : axis];  // the last axis is the vertical one
    const std::string here = pair[lower ? 0 : 1], opposite = pair[lower ? 1 : 0], key = "walls." + here;
    if (!lower && !upper) continue;
    if (lower != upper)
      report.add(key, "\"periodic\", while " + opposite + " is not",
                 "\"periodic\" for both of opposite walls or for neither");
    if (!scene.membranes.empty()) report.add(key, "\"periodic\" in a scene with membranes", "\"slip\" or \"no_slip\"");
    if (!report.healthy("grid")) continue;
    const double cells = (scene.grid.upper[axis] - scene.grid.lower[axis]) / scene.grid.spacing;
    if (std::lround(cells) < fewest_periodic_cells)
      report.add(key, "\"periodic\" over " + std::to_string(std::lround(cells)) + " cells",
                 "at least " + std::to_string(fewest_periodic_cells) + " cells between periodic walls");
  }
}

}  // namespace geodrop
