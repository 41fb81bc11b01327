// Checks of membranes: they lie on the outline of their body.
#include "check_scene.hpp"

#include <geodrop/graded_axis.hpp>
#include <geodrop/shapes.hpp>

namespace geodrop {
namespace {

void check_count(const MembraneSpec& membrane, const std::string& key, Report& report) {
  const std::size_t count = membrane.points.size();
  const std::string found = std::to_string(count) + " points";
  if (!membrane.closed && count < 2)
    report.add(key + ".points", found, "at least 2 points of a membrane with closed = false");
  if (membrane.closed && count > 0 && count < 3)
    report.add(key + ".points", found, "none (the whole outline) or at least 3 points of a closed membrane");
  check_legs(membrane.points, membrane.closed ? Outline::closed : Outline::open, key + ".points", report);
}

void check_on_outline(const Scene& scene, const MembraneSpec& membrane, const std::string& key, Report& report) {
  const BodySpec* body = find_body(scene, membrane.body);
  if (!body || !shape_is_sound(body->shape)) return;
  if (std::holds_alternative<HalfPlaneShape>(body->shape) && membrane.points.empty()) {
    report.add(key + ".points", "no points",
               "points on the boundary of \"" + membrane.body + "\": a half-plane has no closed outline");
  }
  const double tolerance = finest_spacing(scene.grid) / 10;
  for (const Point& point : membrane.points) {
    const double distance = distance_to_outline(body->shape, point);
    if (distance <= tolerance) continue;
    report.add(
        key + ".points", "the point " + to_text(point) + ", which is " + to_text(distance) + " m off",
        "points within a tenth of a cell, " + to_text(tolerance) + " m, of the outline of \"" + membrane.body + '"');
    return;
  }
}

void check_strength(const MembraneSpec& membrane, const std::string& key, Report& report) {
  if (membrane.strength > 0 || membrane.axial_stiffness == 0 || !report.healthy(key + ".strength")) return;
  report.add(key + ".strength", "no strength of a membrane with axial_stiffness = " + to_text(membrane.axial_stiffness),
             "a number > 0 [N/m]");
}

/// The running mean of a closed membrane is over 2 w + 1 different segments.
void check_averaging(const Scene& scene, const MembraneSpec& membrane, const std::string& key, Report& report) {
  const BodySpec* body = find_body(scene, membrane.body);
  if (!membrane.closed || !body || !report.healthy(key) || !report.healthy("bodies")) return;
  const Shape drawn = membrane.points.empty() ? body->shape : Shape{PolygonShape{membrane.points}};
  const std::size_t segments = outline(drawn, finest_spacing(scene.grid) / membrane.segments_per_cell).size();
  const std::size_t most = (segments - 1) / 2;
  if (static_cast<std::size_t>(membrane.averaging_segments) <= most) return;
  report.add(key + ".averaging_segments", std::to_string(membrane.averaging_segments),
             "at most " + std::to_string(most) + " on a closed membrane of " + std::to_string(segments) +
                 " segments: the mean is over 2 averaging_segments + 1 of them");
}

}  // namespace

void check_membranes(const Scene& scene, Report& report) {
  for (std::size_t i = 0; i < scene.membranes.size(); ++i) {
    const MembraneSpec& membrane = scene.membranes[i];
    const std::string& key = report.element("membranes", i);
    const bool known = check_reference(key + ".body", membrane.body, names_of(scene.bodies), "bodies", report);
    if (!report.healthy(key + ".points") || !report.healthy(key + ".closed") || !report.healthy("dimension")) continue;
    check_count(membrane, key, report);
    check_strength(membrane, key, report);
    if (!known || !report.healthy("grid")) continue;
    check_on_outline(scene, membrane, key, report);
    check_averaging(scene, membrane, key, report);
  }
}

}  // namespace geodrop
