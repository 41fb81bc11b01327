// Checks of viscous boundaries: a straight edge of a solid body, with empty grid beyond it.
#include "check_scene.hpp"

#include <geodrop/geometry/shapes.hpp>
#include <geodrop/grid/graded_axis.hpp>

namespace geodrop {
namespace {

/// Its nodes would be those of a wall, or share cells with one: a base on the domain's edge blew up at impact.
constexpr int cells_beyond = 4;

Point between(const Point& from, const Point& to, double share) {
  return {from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])};
}

/// Whether the line is part of the outline; says so if it is not.
bool check_edge(const BodySpec& body, const ViscousBoundarySpec& boundary, double cell, const std::string& key,
                Report& report) {
  constexpr double allowed_share = 0.1;  // of a cell
  constexpr int places = 16;
  for (int k = 0; k <= places; ++k) {
    const Point x = between(boundary.from, boundary.to, static_cast<double>(k) / places);
    const double distance = distance_to_outline(body.shape, x);
    if (distance <= allowed_share * cell) continue;
    report.add(key + (k == 0 ? ".from" : ".to"),
               "a line that is " + to_text(distance) + " m off the outline at " + to_text(x),
               "a straight part of the outline of \"" + body.name + '"');
    return false;
  }
  if (outward_normal(body.shape, boundary.from, boundary.to, cell / 4)) return true;
  report.add(key + ".to", "a line with \"" + body.name + "\" on both sides or on none", "an edge of the body");
  return false;
}

void check_beyond(const Scene& scene, const Point& normal, const ViscousBoundarySpec& boundary, const std::string& key,
                  Report& report) {
  const double wanted = cells_beyond * scene.grid.spacing;
  for (const Point* end : {&boundary.from, &boundary.to})
    for (std::size_t a = 0; a < 2; ++a) {
      const double x = (*end)[a] + wanted * normal[a], round_off = 1e-9 * scene.grid.spacing;
      if (x >= scene.grid.lower[a] - round_off && x <= scene.grid.upper[a] + round_off) continue;
      report.add(key + (end == &boundary.from ? ".from" : ".to"),
                 "the edge " + to_text(*end) + " less than " + to_text(wanted) + " m from the domain's edge",
                 "at least 4 cells of empty grid beyond it");
      return;
    }
}

void check_body(const BodySpec& body, const MaterialSpec& material, const std::string& key, Report& report) {
  if (std::holds_alternative<NewtonianSpec>(material.model))
    report.add(key + ".body", '"' + body.name + "\", which is a fluid", "a body of a solid");
  if (std::holds_alternative<FromExactSpec>(body.initial_stress))
    report.add(key + ".body", '"' + body.name + "\", which follows an exact solution",
               "a body whose initial stress is \"zero\", \"k0\" or \"fluid_pressure\"");
}

/// Whether a part of the second line, longer than a hundredth, lies on the first.
bool overlap(const ViscousBoundarySpec& first, const ViscousBoundarySpec& second, double cell) {
  constexpr int places = 100;
  const double along = distance(first.from, first.to);
  for (int k = 0; k < places; ++k) {
    const Point x = between(second.from, second.to, (k + 0.5) / places);
    if (distance(first.from, x) + distance(x, first.to) < along + 1e-6 * cell) return true;
  }
  return false;
}

/// Where two act the ground would be held by both.
void check_apart(const Scene& scene, std::size_t i, const std::string& key, double cell, Report& report) {
  const ViscousBoundarySpec& boundary = scene.viscous_boundaries[i];
  for (std::size_t k = 0; k < i; ++k)
    if (scene.viscous_boundaries[k].body == boundary.body && overlap(scene.viscous_boundaries[k], boundary, cell))
      report.add(key + ".from", "a line that lies on \"" + scene.viscous_boundaries[k].name + "\" in part",
                 "one viscous boundary for each part of an edge");
}

}  // namespace

void check_viscous_boundaries(const Scene& scene, Report& report) {
  for (std::size_t i = 0; i < scene.viscous_boundaries.size(); ++i) {
    const ViscousBoundarySpec& boundary = scene.viscous_boundaries[i];
    const std::string& key = report.element("viscous_boundaries", i);
    if (!check_reference(key + ".body", boundary.body, names_of(scene.bodies), "bodies", report)) continue;
    const BodySpec& body = *find_body(scene, boundary.body);
    const MaterialSpec* material = find_material(scene, body.material);
    if (material) check_body(body, *material, key, report);
    const bool ready = report.healthy(key + ".from") && report.healthy(key + ".to") && report.healthy("grid") &&
                       report.healthy("bodies." + body.name) && report.healthy("dimension") &&
                       shape_is_sound(body.shape);
    if (!ready) continue;
    if (boundary.from == boundary.to) {
      report.add(key + ".to", to_text(boundary.to), "another point than from");
      continue;
    }
    const double cell = finest_spacing(scene.grid);
    check_apart(scene, i, key, cell, report);
    if (check_edge(body, boundary, cell, key, report))
      check_beyond(scene, *outward_normal(body.shape, boundary.from, boundary.to, cell / 4), boundary, key, report);
  }
}

}  // namespace geodrop
