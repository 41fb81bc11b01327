// Checks of bodies: names, what they refer to, and what their material allows.
#include "check_scene.hpp"

#include <map>

namespace geodrop {
namespace {

/// Names that head columns of history.csv share one name space.
void check_owner_names(const Scene& scene, Report& report) {
  std::map<std::string, std::string> owner;
  for (const char* name : kWholeOwners) owner.emplace(name, "the columns about the whole scene");
  const auto claim = [&](const std::string& name, const std::string& key) {
    if (name.empty()) return;
    const auto [place, is_new] = owner.emplace(name, key);
    if (!is_new)
      report.add(key + ".name", '"' + name + "\", already the name of " + place->second,
                 "a name that no other body, membrane or probe has");
  };
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) claim(scene.bodies[i].name, report.element("bodies", i));
  for (std::size_t i = 0; i < scene.membranes.size(); ++i)
    claim(scene.membranes[i].name, report.element("membranes", i));
  for (std::size_t i = 0; i < scene.probes.size(); ++i) {
    claim(std::visit([](const auto& probe) { return probe.name; }, scene.probes[i].probe), report.element("probes", i));
  }
}

void check_minus(const Scene& scene, const BodySpec& body, const std::string& key, Report& report) {
  for (const std::string& cut : body.minus) {
    if (cut == body.name) {
      report.add(key + ".minus", '"' + cut + "\", the body itself", "names of other bodies");
    } else {
      check_reference(key + ".minus", cut, names_of(scene.bodies), "bodies", report);
    }
  }
}

void check_shift(const Scene& scene, const BodySpec& body, const std::string& key, Report& report) {
  const MaterialSpec* material = find_material(scene, body.material);
  if (body.shift && material && report.healthy("materials." + material->name + ".model") &&
      !std::holds_alternative<NewtonianSpec>(material->model)) {
    report.add(key + ".shift", "true for a body of \"" + body.material + '"',
               "false, unless the material is newtonian");
  }
  // The gradient of the fill ratio jumps from element to element there: the jittered column blows up within a second.
  if (body.shift && report.healthy("grid.basis") && is_simplex(scene.grid.basis))
    report.add(key + ".shift", "true on a grid of simplices", "false, unless the basis is bspline2, gimp or linear");
}

bool is_neo_hookean(const Scene& scene, const BodySpec& body, const Report& report) {
  const MaterialSpec* material = find_material(scene, body.material);
  return material && report.healthy("materials." + material->name + ".model") &&
         std::holds_alternative<NeoHookeanSpec>(material->model);
}

void check_pressure(const Scene& scene, const BodySpec& body, const std::string& key, Report& report) {
  if (!report.healthy("grid.basis") || !report.healthy(key + ".pressure")) return;
  const bool simplex = is_simplex(scene.grid.basis);
  // The volume of a neo-Hookean particle is det F, which cannot follow an averaged rate of volume.
  if (body.pressure != PressureSupport::particle && is_neo_hookean(scene, body, report))
    report.add(key + ".pressure",
               (body.pressure == PressureSupport::cell ? "\"cell\"" : "\"nodal\"") + std::string(" for a body of \"") +
                   body.material + '"',
               "\"particle\", as the material is neo_hookean");
  else if (simplex && body.pressure == PressureSupport::cell)
    report.add(key + ".pressure", "\"cell\" on a grid of simplices",
               "nodal or particle (cells take their integrals from a basis that is a product over the axes)");
  else if (!simplex && body.pressure == PressureSupport::nodal)
    report.add(key + ".pressure", "\"nodal\" with another basis than tri3 or tet4", "cell or particle");
}

}  // namespace

void check_bodies(const Scene& scene, Report& report) {
  check_owner_names(scene, report);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const std::string& key = report.element("bodies", i);
    check_reference(key + ".material", scene.bodies[i].material, names_of(scene.materials), "materials", report);
    check_minus(scene, scene.bodies[i], key, report);
    check_shift(scene, scene.bodies[i], key, report);
    check_pressure(scene, scene.bodies[i], key, report);
  }
}

}  // namespace geodrop
