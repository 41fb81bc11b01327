// Checks of what acts on membranes and fluids from outside: rigid bodies, contacts, still fluids, pumps; and of
// relaxation.
#include "check_scene.hpp"

#include <geodrop/find_named.hpp>
#include <geodrop/graded_axis.hpp>
#include <geodrop/shapes.hpp>

#include <algorithm>
#include <cmath>

namespace geodrop {
namespace {

/// The membrane as drawn; empty if that cannot be told.
std::vector<Point> drawn(const Scene& scene, const MembraneSpec& membrane) {
  if (!membrane.points.empty()) return membrane.points;
  const BodySpec* body = find_body(scene, membrane.body);
  if (!body || !shape_is_sound(body->shape) || std::holds_alternative<HalfPlaneShape>(body->shape)) return {};
  return outline(body->shape, finest_spacing(scene.grid) / membrane.segments_per_cell);
}

void check_start(const Scene& scene, const MembraneSpec& membrane, const RigidSpec& rigid, const std::string& key,
                 Report& report) {
  constexpr double allowed_share = 0.1;  // of a cell
  const double allowed = allowed_share * finest_spacing(scene.grid);
  const HalfPlaneShape& half = rigid.shape;
  const double length = std::hypot(half.normal[0], half.normal[1]);
  double deepest = 0;
  for (const Point& x : drawn(scene, membrane)) {
    const double gap = (half.normal[0] * (x[0] - half.point[0]) + half.normal[1] * (x[1] - half.point[1])) / length;
    deepest = std::max(deepest, -gap);
  }
  if (deepest > allowed)
    report.add(key + ".between",
               '"' + membrane.name + "\" up to " + to_text(deepest) + " m inside \"" + rigid.name + '"',
               "a membrane that starts outside, or at most a tenth of a cell, " + to_text(allowed) + " m, inside");
}

}  // namespace

void check_contacts(const Scene& scene, Report& report) {
  for (std::size_t i = 0; i < scene.rigid.size(); ++i) {
    const std::string key = report.element("rigid", i) + ".shape";
    if (report.healthy(key) && !shape_is_sound(scene.rigid[i].shape))
      report.add(key + ".normal", to_text(scene.rigid[i].shape.normal), "a vector that is not zero");
  }
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    const ContactSpec& contact = scene.contacts[i];
    const std::string& key = report.element("contacts", i);
    if (!report.healthy(key + ".between")) continue;
    const auto& [first, second] = contact.between;
    if (second.empty()) {
      report.add(key + ".between", "another number of names than two",
                 "a membrane and a rigid body, two membranes, or one membrane twice for its own folds");
      continue;
    }
    if (!check_reference(key + ".between", first, names_of(scene.membranes), "membranes", report)) continue;
    if (is_named(scene.membranes, second)) continue;
    const bool known = check_reference(key + ".between", second, names_of(scene.rigid), "rigid", report);
    if (!known || !report.healthy("rigid") || !report.healthy("membranes") || !report.healthy("grid") ||
        !report.healthy("dimension") || !report.healthy("bodies"))
      continue;
    check_start(scene, find_named(scene.membranes, first), find_named(scene.rigid, second), key, report);
  }
}

void check_still_fluids(const Scene& scene, Report& report) {
  for (std::size_t i = 0; i < scene.still_fluids.size(); ++i) {
    const StillFluidSpec& still = scene.still_fluids[i];
    const std::string& key = report.element("still_fluids", i);
    check_fluid(scene, key + ".fluid", still.fluid, report);
    if (check_reference(key + ".membrane", still.membrane, names_of(scene.membranes), "membranes", report) &&
        !find_named(scene.membranes, still.membrane).closed)
      report.add(key + ".membrane", '"' + still.membrane + "\", which is open", "a closed membrane");
    if (report.healthy("gravity") && report.healthy("dimension") && scene.gravity[0] != 0)
      report.add(key + ".surface", "a level, with gravity " + to_text(scene.gravity),
                 "still fluids with gravity along the vertical axis");
  }
}

void check_relaxation(const Scene& scene, Report& report) {
  const bool falls = std::any_of(scene.gravity.begin(), scene.gravity.end(), [](double g) { return g != 0; });
  if (scene.relaxation.damping == RelaxationSpec::Damping::none || falls || !report.healthy("gravity")) return;
  report.add("relaxation.damping", "\"kinetic\" without gravity",
             "\"none\", or gravity: both ratios are relative to it");
}

void check_pumps(const Scene& scene, Report& report) {
  for (std::size_t i = 0; i < scene.pumps.size(); ++i) {
    const PumpSpec& pump = scene.pumps[i];
    const std::string& key = report.element("pumps", i);
    const bool known = check_reference(key + ".body", pump.body, names_of(scene.bodies), "bodies", report);
    if (report.healthy(key + ".from") && report.healthy(key + ".to") && pump.to <= pump.from)
      report.add(key + ".to", to_text(pump.to), "after from = " + to_text(pump.from) + " [s]");
    if (known) check_fluid(scene, key + ".body", find_body(scene, pump.body)->material, report);
  }
}

}  // namespace geodrop
