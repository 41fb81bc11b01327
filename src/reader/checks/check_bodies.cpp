// Checks of bodies: names, what they refer to, and what their material allows.
#include "check_scene.hpp"

#include <geodrop/geometry/shapes.hpp>

#include <algorithm>
#include <cmath>
#include <map>

#include "measure/probes/probes.hpp"
#include "reader/key_table.hpp"
#include "scene/needs.hpp"

namespace geodrop {
namespace {

/// Only a membrane in space may be alone.
void check_any(const Scene& scene, Report& report) {
  if (!report.healthy("dimension") || (scene.dimension == 3 && !scene.membranes.empty())) return;
  constexpr const char *nothing = "nothing: the key is missing or empty", *one = "at least one table";
  if (scene.bodies.empty() && report.healthy("bodies")) report.add("bodies", nothing, one);
  if (scene.materials.empty() && report.healthy("materials")) report.add("materials", nothing, one);
}

/// Names that head columns of history.csv share one name space.
void check_owner_names(const Scene& scene, Report& report) {
  std::map<std::string, std::string> owner;
  for (const char* name : kWholeOwners) owner.emplace(name, "the columns about the whole scene");
  const auto claim = [&](const std::string& name, const std::string& key) {
    if (name.empty()) return;
    const auto [place, is_new] = owner.emplace(name, key);
    if (!is_new)
      report.add(key + ".name", '"' + name + "\", already the name of " + place->second,
                 "a name that no other body, membrane, rigid body, anchor or probe has");
  };
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) claim(scene.bodies[i].name, report.element("bodies", i));
  for (std::size_t i = 0; i < scene.membranes.size(); ++i)
    claim(scene.membranes[i].name, report.element("membranes", i));
  for (std::size_t i = 0; i < scene.rigid.size(); ++i) claim(scene.rigid[i].name, report.element("rigid", i));
  for (std::size_t i = 0; i < scene.anchors.size(); ++i) claim(scene.anchors[i].name, report.element("anchors", i));
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

/// What the density of a fluid has to differ by at the start, for the pressure that a still level leaves to it.
void check_start_at_level(const Scene& scene, const BodySpec& body, const NewtonianSpec& fluid, Report& report) {
  constexpr double most = 0.1;  // of its density
  const std::string bodies_key = "bodies." + body.name;
  if (!report.healthy(bodies_key) || !report.healthy("materials." + body.material) || !report.healthy("grid") ||
      !shape_is_sound(body.shape))
    return;
  const auto* still = std::get_if<HydrostaticSpec>(&body.initial_stress);
  if (!still && !std::holds_alternative<ZeroStressSpec>(body.initial_stress)) return;
  const double level = *fluid.still_level, head = fluid.bulk_modulus / (fluid.density * -scene.gravity.back());
  const Bounds box = bounds_within(body.shape, {scene.grid.lower, scene.grid.upper});
  const double off = still ? std::abs(still->surface - level)
                           : std::max(std::abs(level - box.lower.back()), std::abs(level - box.upper.back()));
  if (off <= most * head) return;
  report.add("materials." + body.material + ".still_level",
             to_text(level) + (still ? ", with the surface of \"" + body.name + "\" at " + to_text(still->surface)
                                     : ", with initial_stress \"zero\" of \"" + body.name + '"'),
             (still ? "a level within " : "\"hydrostatic\", or no point of it further from the level than ") +
                 to_text(most * head) + " m" + (still ? " of it" : "") +
                 ", where the density at the start is 10 % off");
}

/// Where the pressure of a fluid may have a part that its density does not follow.
void check_still_level(const Scene& scene, const BodySpec& body, Report& report) {
  const MaterialSpec* material = find_material(scene, body.material);
  const auto* fluid = material ? std::get_if<NewtonianSpec>(&material->model) : nullptr;
  const std::string key = "materials." + body.material + ".still_level";
  if (!fluid || !fluid->still_level || !report.healthy(key) || !report.healthy("gravity")) return;
  const auto refuse = [&](const std::string& why, const std::string& allowed) {
    report.add(key, to_text(*fluid->still_level) + why, allowed);
  };
  const bool sideways = std::any_of(scene.gravity.begin(), scene.gravity.end() - 1, [](double g) { return g != 0; });
  const auto is_this = [&](const auto& other) { return other.body == body.name; };
  if (sideways || scene.gravity.back() >= 0) return refuse(" with another gravity", "gravity straight down");
  if (saturates(scene, body.name))
    refuse(" for \"" + body.name + "\", the water in pores", "a material of its own, without a still_level, for it");
  if (body.pressure == PressureSupport::enclosed || body.pressure == PressureSupport::nodal)
    refuse(" for \"" + body.name + "\", whose pressure is that of its membrane or of nodes", "cell or particle");
  if (std::any_of(scene.pumps.begin(), scene.pumps.end(), is_this))
    refuse(" for \"" + body.name + "\", which a pump fills", "no still_level there");
  if (std::any_of(scene.exact.begin(), scene.exact.end(), is_this))
    refuse(" for \"" + body.name + "\", which follows an exact solution", "no still_level there");
  check_start_at_level(scene, body, *fluid, report);
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

/// In a sharp membrane the water in the pores is a body of its own, apart from that around.
void check_bagged(const Scene& scene, const BodySpec& soil, const BodySpec& water, const std::string& key,
                  Report& report) {
  if (!in_sharp_membrane(scene, soil.name)) return;
  if (has_inertial_drag(scene, soil))
    report.add("materials." + soil.material + ".forchheimer_coefficient",
               "Forchheimer's drag for \"" + soil.name + "\" in a sharp membrane", "0 there: Darcy's law");
  const std::string& water_key = report.element("bodies", static_cast<std::size_t>(&water - scene.bodies.data()));
  if (!report.healthy(key + ".shape") || !report.healthy(water_key + ".shape")) return;
  const bool outlined = std::ranges::any_of(scene.membranes, [&](const MembraneSpec& membrane) {
    return scene.dimension == 2 && membrane.interface == Interface::sharp && membrane.body == water.name;
  });
  const bool covers = outlined || (water.shape == soil.shape && water.minus == soil.minus);
  const auto soils = std::count_if(scene.bodies.begin(), scene.bodies.end(),
                                   [&](const BodySpec& other) { return other.saturated_by == water.name; });
  if (!covers || soils > 1)
    report.add(key + ".saturated_by",
               '"' + water.name + (covers ? "\", which fills the pores of another soil, too" : "\" of another shape"),
               "a body of water of its own for a soil in a sharp membrane, of the same shape and minus");
}

/// Suction holds soil that dilates together, until water cavitates: the scene has to say where it does.
void check_suction(const Scene& scene, const BodySpec& soil, const BodySpec& water, Report& report) {
  const auto& skeleton = std::get<MohrCoulombSpec>(find_material(scene, soil.material)->model);
  const std::string key = "materials." + water.material + ".tension_cutoff";
  if (!skeleton.critical_state || report.is_given(key)) return;
  report.add(key, "nothing, for the water in the pores of \"" + soil.name + "\", which dilates",
             "the largest suction: 1e5 Pa under the atmosphere (absolute zero), or inf: the water never cavitates");
}

/// Gas in pores has one atmosphere, and water beside it that is stiffer; absorbing layers know of none.
void check_gas(const Scene& scene, const BodySpec& soil, const BodySpec& water, const std::string& key,
               Report& report) {
  const auto atmosphere_of = [&](const BodySpec& body) {  // nothing without gas
    const CoupledSpec* const pores = report.healthy("materials." + body.material) ? pores_of(scene, body) : nullptr;
    return pores && pores->gas_ratio() > 0 ? pores->gas.atmospheric_pressure : 0;
  };
  const MaterialSpec* material = find_material(scene, water.material);
  const auto* fluid = material ? std::get_if<NewtonianSpec>(&material->model) : nullptr;
  const double atmosphere = atmosphere_of(soil);
  if (!fluid || atmosphere == 0) return;
  if (fluid->bulk_modulus <= atmosphere)
    report.add("materials." + soil.material + ".atmospheric_pressure",
               to_text(atmosphere) + ", over the bulk modulus " + to_text(fluid->bulk_modulus) + " of \"" +
                   water.material + '"',
               "less than the bulk modulus of the water in the pores [Pa]");
  const auto differs = [&](const BodySpec& other) {
    return other.saturated_by == soil.saturated_by && atmosphere_of(other) > 0 && atmosphere_of(other) != atmosphere;
  };
  if (std::any_of(scene.bodies.begin(), scene.bodies.end(), differs))
    report.add(key + ".saturated_by", '"' + water.name + "\", with two atmospheric pressures of its soils",
               "one for all soils of a body of water");
  const auto absorbed = [&](const SilentSideSpec& side) { return side.body == water.name; };
  if (std::any_of(scene.silent_sides.begin(), scene.silent_sides.end(), absorbed))
    report.add(key + ".saturated_by", '"' + water.name + "\", which has gas and an absorbing layer",
               "water without gas where a layer absorbs its waves");
}

/// Weight by cells is for pressure by cells; the weight of coupled soil stays with its particles.
void check_weight(const Scene& scene, const BodySpec& body, const std::string& key, Report& report) {
  if (scene.solver.weight != Weight::cell || body.pressure == PressureSupport::cell || !body.saturated_by.empty())
    return;
  report.add(key + ".pressure", "another pressure than that of cells, with weight = \"cell\" in [solver]",
             "\"cell\", or weight = \"particle\"");
}

/// A coupled soil has a body of water in its pores, and nothing else has.
void check_pores(const Scene& scene, const BodySpec& body, const std::string& key, Report& report) {
  const MaterialSpec* material = find_material(scene, body.material);
  if (!material || !report.healthy("materials." + material->name)) return;
  const auto* soil = std::get_if<MohrCoulombSpec>(&material->model);
  const bool coupled = soil && soil->coupled();
  if (coupled == !body.saturated_by.empty()) {
    if (!coupled) return;
    if (!check_reference(key + ".saturated_by", body.saturated_by, names_of(scene.bodies), "bodies", report)) return;
    const BodySpec& water = *find_body(scene, body.saturated_by);
    if (check_fluid(scene, key + ".saturated_by", water.material, report) && water.pressure != PressureSupport::cell)
      report.add(key + ".saturated_by", '"' + water.name + "\", whose pressure is not that of cells",
                 "a body with pressure = \"cell\"");
    if (is_simplex(scene.grid.basis))
      report.add(key + ".saturated_by", "on a grid of simplices", "a coupled soil with another basis");
    check_suction(scene, body, water, report);
    check_gas(scene, body, water, key, report);
    return check_bagged(scene, body, water, key, report);
  }
  report.add(
      key + ".saturated_by",
      coupled ? "nothing, for the coupled soil \"" + body.material + '"'
              : '"' + body.saturated_by + "\" for a body of \"" + body.material + '"',
      coupled ? "the body of the water in its pores" : "nothing, unless the material has drainage = \"coupled\"");
}

bool is_neo_hookean(const Scene& scene, const BodySpec& body, const Report& report) {
  const MaterialSpec* material = find_material(scene, body.material);
  return material && report.healthy("materials." + material->name + ".model") &&
         std::holds_alternative<NeoHookeanSpec>(material->model);
}

/// An enclosed fluid fills its shape, and one closed membrane runs along the whole outline of that.
void check_enclosed(const Scene& scene, const BodySpec& body, const std::string& key, Report& report) {
  if (body.pressure != PressureSupport::enclosed) return;
  const auto refuse = [&](const std::string& found, const std::string& allowed) {
    report.add(key + ".pressure", "\"enclosed\" " + found, allowed);
  };
  const MaterialSpec* material = find_material(scene, body.material);
  const bool fluid = !material || !report.healthy("materials." + material->name + ".model") ||
                     std::holds_alternative<NewtonianSpec>(material->model);
  const auto around = std::count_if(scene.membranes.begin(), scene.membranes.end(), [&](const MembraneSpec& membrane) {
    const auto* inside = std::get_if<InsideShape>(&body.shape);
    return inside ? inside->membrane == membrane.name
                  : membrane.body == body.name && membrane.closed && membrane.points.empty();
  });
  const auto is_enclosed = [](const BodySpec& other) { return other.pressure == PressureSupport::enclosed; };
  if (scene.dimension == 3 && !std::all_of(scene.bodies.begin(), scene.bodies.end(), is_enclosed))
    refuse("in space beside a body that is not", "enclosed in space where all bodies are");
  else if (scene.grid.basis != Basis::bspline2 || !scene.grid.refine.empty())
    refuse("on a grid whose cells are not knot spans of one size", "enclosed with basis = \"bspline2\" and no zones");
  else if (!fluid)
    refuse("for a body of \"" + body.material + '"', "enclosed with a newtonian material");
  else if (around != 1 || !body.minus.empty())
    refuse("with " + std::to_string(around) + " closed membranes on the whole outline" +
               (body.minus.empty() ? "" : ", and with bodies cut out"),
           "enclosed with one closed membrane without points, and without minus");
  else if (std::any_of(scene.gravity.begin(), scene.gravity.end() - 1, [](double g) { return g != 0; }))
    refuse("with gravity " + to_text(scene.gravity), "enclosed with gravity along the vertical axis");
}

/// Enclosed fluids, silent sides and sharp interfaces move J towards that of a pressure, which cavities have none of;
/// water in pores, which leaves them to air, is let be there (even_out_volumes).
void check_cavities(const Scene& scene, const BodySpec& body, const std::string& key, Report& report) {
  const MaterialSpec* material = find_material(scene, body.material);
  const auto* fluid = material ? std::get_if<NewtonianSpec>(&material->model) : nullptr;
  if (!fluid || !(fluid->tension_cutoff < fluid->bulk_modulus)) return;
  const bool silent = std::any_of(scene.silent_sides.begin(), scene.silent_sides.end(),
                                  [&](const SilentSideSpec& side) { return side.body == body.name; });
  const bool beside_interface = has_sharp_interface(scene) && !saturates(scene, body.name);
  if (silent || beside_interface || body.pressure == PressureSupport::enclosed)
    report.add(
        key + ".material", '"' + body.material + "\", which has a tension_cutoff",
        "a fluid without one, with an enclosed pressure, an absorbing layer or, outside of pores, a sharp interface");
}

void check_pressure(const Scene& scene, const BodySpec& body, const std::string& key, Report& report) {
  if (!report.healthy("grid.basis") || !report.healthy(key + ".pressure")) return;
  const bool simplex = is_simplex(scene.grid.basis);
  // The volume of a neo-Hookean particle is det F, which cannot follow an averaged rate of volume.
  if (body.pressure != PressureSupport::particle && is_neo_hookean(scene, body, report))
    report.add(key + ".pressure",
               '"' + word_of("bodies", "pressure", body.pressure) + "\" for a body of \"" + body.material + '"',
               "\"particle\", as the material is neo_hookean");
  else if (simplex && body.pressure == PressureSupport::cell)
    report.add(key + ".pressure", "\"cell\" on a grid of simplices",
               "nodal or particle (cells take their integrals from a basis that is a product over the axes)");
  else if (!simplex && body.pressure == PressureSupport::nodal)
    report.add(key + ".pressure", "\"nodal\" with another basis than tri3 or tet4", "cell or particle");
}

/// Of undrained soil whose cells carry its pressure, or of pore water.
void check_implicit_pressure(const Scene& scene, const BodySpec& body, const std::string& key, Report& report) {
  if (!body.implicit_pore_pressure) return;
  const auto refuse = [&](const std::string& found, const std::string& allowed) {
    report.add(key + ".implicit_pore_pressure", "true " + found, allowed);
  };
  const MaterialSpec* material = find_material(scene, body.material);
  const auto* soil = material ? std::get_if<MohrCoulombSpec>(&material->model) : nullptr;
  const UndrainedSpec* pores = soil ? soil->undrained() : nullptr;
  const bool known = material && report.healthy("materials." + material->name + ".model") &&
                     report.healthy("materials." + material->name + ".drainage");
  const bool pore_water =
      known && saturates(scene, body.name) && std::holds_alternative<NewtonianSpec>(material->model);
  if (known && !pore_water && (!pores || pores->gas))
    refuse("for a body of \"" + body.material + '"',
           "true for a soil with drainage = \"undrained\" and a fluid_bulk_modulus, or for the water in pores");
  else if (body.pressure != PressureSupport::cell)
    refuse("where each particle carries its pressure", "true with pressure = \"cell\"");
  else if (std::find(scene.walls.lower.begin(), scene.walls.lower.end(), WallKind::periodic) != scene.walls.lower.end())
    refuse("between periodic walls", "true between walls of other kinds");
  else if (scene.solver.mass_matrix == MassMatrix::consistent)
    refuse("with a consistent mass matrix", "true with mass_matrix = \"lumped\"");
}

}  // namespace

void check_velocity(const Scene& scene, const BodySpec& body, const std::string& key, Report& report) {
  const auto* linear = std::get_if<LinearVelocitySpec>(&body.initial_velocity);
  const std::size_t rows = scene.gravity.size();
  if (linear && report.healthy("gravity") && report.healthy(key) && linear->gradient.size() != rows)
    report.add(key + ".gradient", std::to_string(linear->gradient.size()) + " rows",
               std::to_string(rows) + ", as many as the dimension");
}

void check_bodies(const Scene& scene, Report& report) {
  check_any(scene, report);
  check_owner_names(scene, report);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const std::string& key = report.element("bodies", i);
    check_reference(key + ".material", scene.bodies[i].material, names_of(scene.materials), "materials", report);
    check_minus(scene, scene.bodies[i], key, report);
    check_shift(scene, scene.bodies[i], key, report);
    check_still_level(scene, scene.bodies[i], report);
    check_pores(scene, scene.bodies[i], key, report);
    check_weight(scene, scene.bodies[i], key, report);
    check_pressure(scene, scene.bodies[i], key, report);
    check_velocity(scene, scene.bodies[i], key + ".initial_velocity", report);
    if (report.healthy(key) && report.healthy("materials") && report.healthy("membranes"))
      check_cavities(scene, scene.bodies[i], key, report);
    check_implicit_pressure(scene, scene.bodies[i], key, report);
    if (report.healthy("grid") && report.healthy("dimension") && report.healthy("gravity") &&
        report.healthy("membranes") && report.healthy(key))
      check_enclosed(scene, scene.bodies[i], key, report);
  }
}

}  // namespace geodrop
