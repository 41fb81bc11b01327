// Cross-checks: what a single key cannot tell. Each looks only at keys that are right in themselves.
#pragma once

#include "keys/references.hpp"
#include "keys/report.hpp"
#include "keys/to_text.hpp"

#include <geodrop/scene/scene.hpp>

#include <string>
#include <vector>

namespace geodrop {

/// Whether the last point of a list joins the first.
enum class Ends { open, closed };

/// All of the checks below.
void check_scene(const Scene& scene, Report& report);

void check_grid(const Scene& scene, Report& report);
void check_walls(const Scene& scene, Report& report);
void check_materials(const Scene& scene, Report& report);
void check_bodies(const Scene& scene, Report& report);
void check_initial_stress(const Scene& scene, Report& report);
void check_geometry(const Scene& scene, Report& report);
void check_exact(const Scene& scene, Report& report);
void check_membranes(const Scene& scene, Report& report);
void check_contacts(const Scene& scene, Report& report);
void check_still_fluids(const Scene& scene, Report& report);
void check_relaxation(const Scene& scene, Report& report);
void check_viscous_boundaries(const Scene& scene, Report& report);
void check_silent_sides(const Scene& scene, Report& report);
void check_anchors(const Scene& scene, Report& report);
void check_pumps(const Scene& scene, Report& report);
void check_stages(const Scene& scene, Report& report);
void check_measurements(const Scene& scene, Report& report);
void check_output(const Scene& scene, Report& report);

/// Owners of columns about the whole scene; no body, membrane or probe has such a name.
inline constexpr const char* kWholeOwners[] = {"energy", "total", "relaxation"};

/// Reports each point that stands on the one before it (of a closed outline also the last on the first): the leg
/// between them has no direction.
void check_legs(const std::vector<Point>& points, Ends outline, const std::string& key, Report& report);

double distance(const Point& a, const Point& b);

bool crosses_itself(const std::vector<Point>& points, Ends ends);

/// Report a box or a polygon without area, one that crosses itself, points that stand twice.
void check_box(const BoxShape& box, const std::string& key, Report& report);
void check_polygon(const PolygonShape& polygon, const std::string& key, Report& report);

/// The shape has what its geometry needs (it may still be off the grid, or empty).
bool shape_is_sound(const Shape& shape);

}  // namespace geodrop
