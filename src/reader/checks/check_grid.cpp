// Checks of the grid, of the transfers that its basis allows, and of the walls.
#include "check_scene.hpp"

#include <geodrop/scene/wall_names.hpp>

#include <algorithm>
#include <cmath>

#include "grid/seams.hpp"
#include "setup/allowed_spacing.hpp"

namespace geodrop {
namespace {

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
  if (cells <= most_cells) return check_zones(scene, report);
  const auto count = [&](double n) {
    return to_text(std::round(n / 1e6)) + " million cells, about " + to_text(std::round(n * kBytesPerCell / 1e9)) +
           " GB of memory for the grid";
  };
  report.add("grid.spacing", to_text(grid.spacing) + ", which is " + count(cells), "at most " + count(most_cells));
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
}

void check_mass_matrix(const Scene& scene, Report& report) {
  if (!report.healthy("grid.basis") || !report.healthy("solver.mass_matrix")) return;
  const Basis basis = scene.grid.basis;
  if (scene.solver.mass_matrix == MassMatrix::consistent && basis != Basis::bspline2 && basis != Basis::linear)
    report.add("solver.mass_matrix", "\"consistent\" on a basis whose lumping has no constant stencil",
               "\"lumped\", or grid.basis = \"bspline2\" or \"linear\"");
  if (scene.solver.mass_matrix == MassMatrix::consistent && has_sharp_interface(scene))
    report.add("solver.mass_matrix", "\"consistent\" with a sharp membrane, whose rows are of the lumped mass",
               "\"lumped\" or \"consistent_at_membranes\"");
  if (scene.solver.mass_matrix == MassMatrix::consistent_at_membranes && !has_sharp_interface(scene))
    report.add("solver.mass_matrix", "\"consistent_at_membranes\" without a membrane with interface = \"sharp\"",
               "\"lumped\" or \"consistent\"");
}

}  // namespace

void check_grid(const Scene& scene, Report& report) {
  check_cells(scene, report);
  check_basis(scene, report);
  check_transfer(scene, report);
  check_mass_matrix(scene, report);
}

/// Periodic walls come in pairs.
void check_walls(const Scene& scene, Report& report) {
  if (!report.healthy("walls") || !report.healthy("dimension")) return;
  for (std::size_t axis = 0; axis < scene.walls.lower.size(); ++axis) {
    const bool lower = scene.walls.lower[axis] == WallKind::periodic;
    const bool upper = scene.walls.upper[axis] == WallKind::periodic;
    const auto name = [&](bool above) { return std::string(wall_name(axis, above, scene.walls.lower.size())); };
    const std::string here = name(!lower), opposite = name(lower), key = "walls." + here;
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
