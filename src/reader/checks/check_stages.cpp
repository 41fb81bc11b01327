// Checks of the stages of a scene in time.
#include "check_scene.hpp"

#include <algorithm>
#include <optional>
#include <set>

namespace geodrop {
namespace {

void check_order(const Scene& scene, Report& report) {
  for (std::size_t i = 0; i < scene.stages.size(); ++i) {
    const std::string key = report.element("stages", i) + ".from";
    if (!report.healthy(key)) continue;
    const double from = scene.stages[i].from;
    if (i == 0 && from != 0) report.add(key, to_text(from), "0: the first stage begins with the run");
    if (i > 0 && from <= scene.stages[i - 1].from)
      report.add(key, to_text(from), "after the stage before, that is after " + to_text(scene.stages[i - 1].from));
    if (report.healthy("time") && from >= scene.time.end)
      report.add(key, to_text(from), "before time.end = " + to_text(scene.time.end));
  }
}

/// Which stage places a body; none: it is there from the start.
std::optional<std::size_t> stage_of(const Scene& scene, const std::string& body) {
  for (std::size_t i = 0; i < scene.stages.size(); ++i)
    if (std::ranges::find(scene.stages[i].places, body) != scene.stages[i].places.end()) return i;
  return std::nullopt;
}

/// A soil comes with the water in its pores.
void check_pores(const Scene& scene, Report& report) {
  for (const BodySpec& soil : scene.bodies) {
    const std::string& water = soil.saturated_by;
    const auto its = stage_of(scene, soil.name), of_water = stage_of(scene, water);
    if (water.empty() || its == of_water) continue;
    report.add(report.element("stages", its ? *its : *of_water) + ".places",
               its ? '"' + soil.name + "\" without \"" + water + "\", the water in its pores"
                   : '"' + water + "\", the water in the pores of \"" + soil.name + "\", without that",
               "both in one stage");
  }
}

}  // namespace

void check_stages(const Scene& scene, Report& report) {
  if (scene.stages.empty()) return;
  check_order(scene, report);
  if (report.healthy("solver") && scene.solver.damping_rate != 0)
    report.add("solver.damping_rate", to_text(scene.solver.damping_rate),
               "0 in a scene with stages: each of them has a damping_rate of its own");
  std::set<std::string> placed, names;
  for (std::size_t i = 0; i < scene.stages.size(); ++i) {
    const std::string& key = report.element("stages", i);
    const StageSpec& stage = scene.stages[i];
    if (!stage.name.empty() && !names.insert(stage.name).second)
      report.add(key + ".name", '"' + stage.name + "\", the name of another stage", "a name that no other stage has");
    for (const std::string& name : stage.places) {
      check_reference(key + ".places", name, names_of(scene.bodies), "bodies", report);
      if (!placed.insert(name).second)
        report.add(key + ".places", '"' + name + "\" again", "each body at most once in all stages");
    }
    for (const std::string& name : stage.moves)
      check_reference(key + ".moves", name, names_of(scene.rigid), "rigid", report);
    for (const std::string& name : stage.removes)
      check_reference(key + ".removes", name, names_of(scene.rigid), "rigid", report);
  }
  check_pores(scene, report);
}

}  // namespace geodrop
