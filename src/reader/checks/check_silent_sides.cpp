// Checks of absorbing layers: still water that reaches a wall, and a layer that has room there.
#include "check_scene.hpp"

#include <geodrop/geometry/shapes.hpp>

#include <algorithm>

namespace geodrop {
namespace {

constexpr int fewest_cells = 4;  // fewer send a sharp wave back

using Side = SilentSideSpec::Side;

const char* name_of(Side side) { return side == Side::left ? "left" : "right"; }

void check_body(const Scene& scene, const BodySpec& body, const std::string& key, Report& report) {
  const MaterialSpec* material = find_material(scene, body.material);
  if (material && !std::holds_alternative<NewtonianSpec>(material->model))
    report.add(key + ".body", '"' + body.name + "\", which is no fluid", "a body of a newtonian material");
  else if (report.healthy("bodies." + body.name) && !std::holds_alternative<HydrostaticSpec>(body.initial_stress))
    report.add(key + ".body", '"' + body.name + "\", which does not start as a still fluid",
               "a body with initial_stress of type \"hydrostatic\"");
}

void check_wall(const Scene& scene, const BodySpec& body, const SilentSideSpec& side, const std::string& key,
                Report& report) {
  const bool left = side.side == Side::left;
  if (!report.healthy("walls") || !report.healthy("grid") || !report.healthy("bodies." + body.name)) return;
  const WallKind wall = left ? scene.walls.lower[0] : scene.walls.upper[0];
  if (wall == WallKind::periodic)
    report.add(key + ".side", std::string("\"") + name_of(side.side) + "\", where the wall is periodic",
               "a wall that holds what touches it");
  if (!shape_is_sound(body.shape)) return;
  const Bounds box = bounds(body.shape);
  const double gap = left ? box.lower[0] - scene.grid.lower[0] : scene.grid.upper[0] - box.upper[0];
  if (gap > 1e-9 * scene.grid.spacing)
    report.add(key + ".side", '"' + body.name + "\" " + to_text(gap) + " m off the " + name_of(side.side) + " wall",
               "a body that reaches it");
}

void check_width(const Scene& scene, const SilentSideSpec& side, const std::string& key, Report& report) {
  if (!report.healthy(key + ".width") || !report.healthy("grid")) return;
  const double least = fewest_cells * scene.grid.spacing, most = (scene.grid.upper[0] - scene.grid.lower[0]) / 2;
  if (side.width >= least && side.width <= most) return;
  report.add(key + ".width", to_text(side.width),
             "from 4 cells, " + to_text(least) + " m, to half of the domain, " + to_text(most) + " m");
}

}  // namespace

void check_silent_sides(const Scene& scene, Report& report) {
  for (std::size_t i = 0; i < scene.silent_sides.size(); ++i) {
    const SilentSideSpec& side = scene.silent_sides[i];
    const std::string& key = report.element("absorbing_layers", i);
    if (!check_reference(key + ".body", side.body, names_of(scene.bodies), "bodies", report)) continue;
    const BodySpec& body = *find_body(scene, side.body);
    check_body(scene, body, key, report);
    if (!report.healthy(key + ".side") || !report.healthy("dimension")) continue;
    check_wall(scene, body, side, key, report);
    check_width(scene, side, key, report);
    const auto same = [&](const SilentSideSpec& other) { return other.body == side.body && other.side == side.side; };
    if (std::any_of(scene.silent_sides.begin(), scene.silent_sides.begin() + static_cast<std::ptrdiff_t>(i), same))
      report.add(key + ".side", std::string("a second absorbing layer of \"") + side.body + "\" at the same wall",
                 "one for each body and wall");
  }
}

}  // namespace geodrop
