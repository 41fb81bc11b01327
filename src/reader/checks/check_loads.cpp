// Checks of what acts on membranes and fluids from outside: still fluids, pumps; and of relaxation.
#include "check_scene.hpp"

#include <geodrop/base/find_named.hpp>

#include <algorithm>

#include "scene/needs.hpp"

namespace geodrop {
namespace {

/// A body of fluid on that side of a sharp membrane presses on it already; "" if there is none.
std::string fluid_beside(const Scene& scene, const StillFluidSpec& still) {
  const MembraneSpec& membrane = find_named(scene.membranes, still.membrane);
  if (membrane.interface != Interface::sharp) return "";
  for (const BodySpec& body : scene.bodies) {
    const MaterialSpec* material = find_material(scene, body.material);
    if (!material || !std::holds_alternative<NewtonianSpec>(material->model)) continue;
    const bool inside = still.side == StillFluidSpec::Side::inside;
    if (inside ? body.name == membrane.body : !is_enclosed(scene, body) && !saturates(scene, body.name))
      return body.name;
  }
  return "";
}

}  // namespace

void check_still_fluids(const Scene& scene, Report& report) {
  for (std::size_t i = 0; i < scene.still_fluids.size(); ++i) {
    const StillFluidSpec& still = scene.still_fluids[i];
    const std::string& key = report.element("still_fluids", i);
    check_fluid(scene, key + ".fluid", still.fluid, report);
    if (check_reference(key + ".membrane", still.membrane, names_of(scene.membranes), "membranes", report)) {
      if (!find_named(scene.membranes, still.membrane).closed)
        report.add(key + ".membrane", '"' + still.membrane + "\", which is open", "a closed membrane");
      if (const std::string body = fluid_beside(scene, still); !body.empty())
        report.add(key + ".membrane",
                   '"' + still.membrane + "\", whose sharp interface lets \"" + body + "\" press on that side already",
                   "a still fluid or a body of fluid on each side of a membrane");
    }
    for (std::size_t k = 0; k < i; ++k)
      if (scene.still_fluids[k].membrane == still.membrane && scene.still_fluids[k].side == still.side)
        report.add(key + ".membrane", '"' + still.membrane + "\" with a second still fluid on the same side",
                   "one still fluid for each side of a membrane");
    const auto sideways = [&] {
      return std::any_of(scene.gravity.begin(), scene.gravity.end() - 1, [](double g) { return g != 0; });
    };
    if (report.healthy("gravity") && report.healthy("dimension") && sideways())
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
