// Checks of membranes: they lie on the outline of their body.
#include "check_scene.hpp"

#include <geodrop/geometry/shapes.hpp>
#include <geodrop/grid/graded_axis.hpp>
#include <geodrop/scene/velocity_fields.hpp>

#include <algorithm>
#include <cmath>

#include "scene/needs.hpp"

namespace geodrop {
namespace {

void check_count(const MembraneSpec& membrane, const std::string& key, Report& report) {
  const std::size_t count = membrane.points.size();
  const std::string found = std::to_string(count) + " points";
  if (!membrane.closed && count < 2)
    report.add(key + ".points", found, "at least 2 points of a membrane with closed = false");
  if (membrane.closed && count > 0 && count < 3)
    report.add(key + ".points", found, "none (the whole outline) or at least 3 points of a closed membrane");
  const Ends ends = membrane.closed ? Ends::closed : Ends::open;
  check_legs(membrane.points, ends, key + ".points", report);
  if (count > 2 && crosses_itself(membrane.points, ends))
    report.add(key + ".points", "a line that crosses itself", "points in the order in which the line passes them");
}

/// A sharp membrane parts its body from what is around: all of the body is inside.
void check_encloses(const Scene& scene, const MembraneSpec& membrane, const std::string& key, Report& report) {
  const BodySpec* body = find_body(scene, membrane.body);
  if (membrane.interface != Interface::sharp || !membrane.closed || membrane.points.size() < 3) return;
  if (!body || !shape_is_sound(body->shape) || std::holds_alternative<HalfPlaneShape>(body->shape)) return;
  constexpr double most = 0.1;  // of the body: what chords leave of an arc is less
  const double whole = area(body->shape), inside = area(PolygonShape{membrane.points});
  if (std::abs(inside - whole) <= most * whole) return;
  report.add(key + ".points",
             "a line around " + to_text(inside) + " m2 of \"" + body->name + "\", which has " + to_text(whole),
             "points along the whole outline, or none, with interface = \"sharp\"");
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

/// A fluid has no effective pressure that friction could follow from.
void check_contents(const Scene& scene, const MembraneSpec& membrane, const std::string& key, Report& report) {
  const BodySpec* body = find_body(scene, body_inside(scene, membrane));
  const MaterialSpec* material = body ? find_material(scene, body->material) : nullptr;
  if (!material || !std::holds_alternative<NewtonianSpec>(material->model)) return;
  if (!report.healthy(key + ".contents_friction")) return;
  if (membrane.contents_friction > 0 && std::isfinite(membrane.contents_friction))
    report.add(key + ".contents_friction",
               to_text(membrane.contents_friction) + " on the fluid \"" + membrane.body + '"',
               "0 or inf where a fluid is inside, which has no effective pressure");
}

void check_is_bed(const Scene& scene, const MembraneSpec& membrane, const std::string& key, Report& report) {
  if (membrane.bed == body_inside(scene, membrane) || membrane.bed == membrane.body)
    report.add(key + ".bed", '"' + membrane.bed + "\", which is inside", "a body outside of the membrane");
}

/// Friction needs a bed, and a bed a membrane that slips on it.
void check_bed(const Scene& scene, const MembraneSpec& membrane, const std::string& key, Report& report) {
  if (!report.healthy(key + ".interface") || !report.healthy(key + ".bed_friction")) return;
  if (membrane.bed.empty() && membrane.bed_friction > 0)
    report.add(key + ".bed_friction", to_text(membrane.bed_friction) + " without a bed", "bed_friction with bed only");
  if (membrane.bed.empty()) return;
  if (membrane.interface != Interface::sharp)
    report.add(key + ".bed", '"' + membrane.bed + "\" of a membrane that sticks to what is around",
               "bed with interface = \"sharp\" only");
  else if (check_reference(key + ".bed", membrane.bed, names_of(scene.bodies), "bodies", report))
    check_is_bed(scene, membrane, key, report);
}

/// Where eddies mix, the layer that sticks is far thinner than a cell: a cell of water would be glued to the membrane
/// (23 % of the acceleration of a container at the start, h = 0.25 m).
void check_sticking(const NewtonianSpec& fluid, const MembraneSpec& membrane, const std::string& key, Report& report) {
  if (membrane.shear != Shear::no_slip || fluid.mixing_length == 0) return;
  report.add(key + ".shear", "\"no_slip\" in a fluid with mixing_length = " + to_text(fluid.mixing_length),
             "\"rough_wall\" with a mixing_length; \"no_slip\" where viscosity makes the layer that the grid resolves");
}

/// A wall law and a drag coefficient need the density of a fluid.
void check_fluid_around(const Scene& scene, const MembraneSpec& membrane, const std::string& key, Report& report) {
  if (membrane.interface != Interface::sharp || !report.healthy("bodies") || !report.healthy("materials")) return;
  if (const NewtonianSpec* fluid = fluid_around(scene)) return check_sticking(*fluid, membrane, key, report);
  const std::string allowed = "it where a body of newtonian material is around";
  if (membrane.shear == Shear::wall_law || membrane.shear == Shear::rough_wall)
    report.add(
        key + ".shear",
        std::string(membrane.shear == Shear::wall_law ? "\"wall_law\"" : "\"rough_wall\"") + " without a fluid around",
        allowed);
  if (membrane.drag_coefficient > 0)
    report.add(key + ".drag_coefficient", to_text(membrane.drag_coefficient) + " without a fluid around", allowed);
}

/// Water flows through a membrane out of the pores of a soil, or into them.
void check_permittivity(const Scene& scene, const MembraneSpec& membrane, const std::string& key, Report& report) {
  const BodySpec* body = find_body(scene, body_inside(scene, membrane));
  if (!(membrane.permittivity > 0) || !body || !body->saturated_by.empty()) return;
  report.add(key + ".permittivity", to_text(membrane.permittivity) + " around \"" + body->name + '"',
             "permittivity where the body is a soil with drainage = \"coupled\"; else 0, tight");
}

/// The table of how the permittivity changes as the cloth stretches.
void check_permittivity_table(const MembraneSpec& membrane, const std::string& key, Report& report) {
  const std::vector<double>&strains = membrane.permittivity_strains, &factors = membrane.permittivity_factors;
  if (strains.empty() && factors.empty() && membrane.clogging == 0) return;
  if (!(membrane.permittivity > 0)) {
    const std::string of_none = strains.empty() && factors.empty() ? ".clogging" : ".permittivity_strains";
    report.add(key + of_none, "it without a permittivity", "permittivity > 0 beside it");
  } else if (!std::is_sorted(strains.begin(), strains.end(), std::less_equal<>())) {
    report.add(key + ".permittivity_strains", to_text(strains), "strains each above the one before");
  } else if (strains.size() != factors.size()) {
    report.add(key + ".permittivity_factors",
               std::to_string(factors.size()) + " values for " + std::to_string(strains.size()) + " strains",
               "one value for each strain");
  }
}

/// Whether a membrane lies on the outline of the water in the pores of a soil: a bag of soil and free water.
bool has_free_water(const Scene& scene, const MembraneSpec& membrane) {
  return scene.dimension == 2 && body_inside(scene, membrane) != membrane.body;
}

/// Beside free water the cloth alone bears its tension and the penalties of contacts, whose limits of the time step
/// count on the mass of the soil: the mass per area that dt = C h / c asks of it [kg/m2].
double least_mass(const Scene& scene, const MembraneSpec& membrane) {
  const BodySpec& soil = *find_body(scene, body_inside(scene, membrane));
  const Material skeleton = law_of(scene, soil), water = law_of(scene, *find_body(scene, soil.saturated_by));
  const double h = finest_spacing(scene.grid), dt = scene.solver.courant * h / wave_speed(water);
  constexpr double longest_step = 0.577;  // over h and the speed of waves along the cloth, as of bspline2 in the plane
  double mass = membrane.axial_stiffness * std::pow(dt / (longest_step * h), 2);
  for (const ContactSpec& contact : scene.contacts) {
    if (std::ranges::find(contact.between, membrane.name) == contact.between.end()) continue;
    const double stiffness = contact.stiffness * impedance(skeleton) * wave_speed(skeleton) / h;
    mass = std::max({mass, 2 * stiffness * dt * dt, 2 * contact.damping * impedance(skeleton) * dt});
  }
  return mass;
}

void check_free_water(const Scene& scene, const MembraneSpec& membrane, const std::string& key, Report& report) {
  const bool sound = report.healthy("materials") && report.healthy("bodies") && report.healthy("contacts") &&
                     report.healthy("solver.courant") && report.healthy(key + ".mass_per_area");
  if (!sound || !has_free_water(scene, membrane)) return;
  const double least = least_mass(scene, membrane);
  if (membrane.mass_per_area < least)
    report.add(key + ".mass_per_area", to_text(membrane.mass_per_area) + " of a bag with free water beside its soil",
               "at least " + to_text(least) +
                   " kg/m2, as the cloth alone bears tension and contacts there; a lower solver.courant, "
                   "axial_stiffness, stiffness or damping of contacts asks for less");
}

/// Both sides of a sharp interface have pressures of cells, and cells are knot spans.
void check_interface(const Scene& scene, const MembraneSpec& membrane, const std::string& key, Report& report) {
  if (membrane.interface != Interface::sharp || !report.healthy(key + ".interface") || !report.healthy("bodies"))
    return;
  const auto refuse = [&](const std::string& found, const std::string& allowed) {
    report.add(key + ".interface", "\"sharp\" " + found, allowed);
  };
  const auto sharp = [&](const std::string& body) {
    return std::count_if(scene.membranes.begin(), scene.membranes.end(), [&](const MembraneSpec& other) {
      return other.interface == Interface::sharp && body_inside(scene, other) == body;
    });
  };
  const std::string name = body_inside(scene, membrane);
  const BodySpec* body = find_body(scene, name);
  const auto outside = [&](const BodySpec& other) {
    return !in_sharp_membrane(scene, other.name) && !(body && other.name == body->saturated_by);
  };
  const bool beside_cells = std::any_of(scene.bodies.begin(), scene.bodies.end(), [&](const BodySpec& other) {
    return outside(other) && other.pressure == PressureSupport::cell;
  });
  const bool in_air = membrane.permittivity > 0 && std::none_of(scene.bodies.begin(), scene.bodies.end(), outside);
  if (scene.grid.basis != Basis::bspline2)
    refuse("on a grid whose cells are not knot spans", "sharp with basis = \"bspline2\"");
  else if (scene.solver.transfer == Transfer::musl)
    refuse("with solver.transfer = \"musl\", which maps velocities back to the grid", "sharp with tpic or blend");
  else if (!membrane.closed)
    refuse("on an open membrane", "sharp with closed = true");
  else if (name.empty())
    refuse("on an empty membrane", "sharp around a body of shape `inside`");
  else if (sharp(name) > 1)
    refuse("on a second membrane of \"" + name + '"', "one sharp membrane for each body");
  else if (body && body->pressure != PressureSupport::cell && body->saturated_by.empty())
    refuse("around a body whose pressure is not that of cells", "sharp with pressure = \"cell\" for \"" + name + '"');
  else if (!beside_cells && !in_air)
    refuse("with nothing around",
           "sharp where a body with pressure = \"cell\" and without a sharp membrane is around, or with a permittivity "
           "in air");
}

/// A cell without fluid has no other mass than the membrane's.
void check_surfaces(const Scene& scene, Report& report) {
  for (std::size_t i = 0; i < scene.membranes.size(); ++i) {
    const MembraneSpec& membrane = scene.membranes[i];
    const std::string& key = report.element("membranes", i);
    check_strength(membrane, key, report);
    for (const auto& [name, value] :
         {std::pair{".mass_per_area", membrane.mass_per_area}, std::pair{".axial_stiffness", membrane.axial_stiffness}})
      if (value == 0 && report.healthy(key + name)) report.add(key + name, "0 of a membrane in space", "a number > 0");
    const bool no_warp = std::all_of(membrane.warp.begin(), membrane.warp.end(), [](double c) { return c == 0; });
    if (membrane.fabric == Fabric::yarns && no_warp && report.healthy(key + ".warp"))
      report.add(key + ".warp", to_text(membrane.warp), "a vector that is not zero");
    const BodySpec* inside = find_body(scene, body_inside(scene, membrane));
    if (!membrane.ends_at.empty() && inside && inside->pressure == PressureSupport::enclosed)
      report.add(key + ".ends_at", "ends of a membrane around a body with pressure = \"enclosed\"",
                 "none there; interface = \"sharp\" or a mixture around others");
    if (scene.solver.transfer == Transfer::musl && report.healthy("solver.transfer"))
      report.add(key, "a membrane in space with solver.transfer = \"musl\"", "tpic or blend");
    else if (report.healthy("grid"))
      check_interface(scene, membrane, key, report);
    check_bed(scene, membrane, key, report);
    check_permittivity(scene, membrane, key, report);
    check_permittivity_table(membrane, key, report);
    check_fluid_around(scene, membrane, key, report);
  }
}

}  // namespace

void check_membranes(const Scene& scene, Report& report) {
  if (scene.dimension == 3) return check_surfaces(scene, report);
  for (std::size_t i = 0; i < scene.membranes.size(); ++i) {
    const MembraneSpec& membrane = scene.membranes[i];
    const std::string& key = report.element("membranes", i);
    const bool known = check_reference(key + ".body", membrane.body, names_of(scene.bodies), "bodies", report);
    if (!report.healthy(key + ".points") || !report.healthy(key + ".closed") || !report.healthy("dimension")) continue;
    check_count(membrane, key, report);
    check_strength(membrane, key, report);
    if (!known || !report.healthy("grid")) continue;
    check_on_outline(scene, membrane, key, report);
    check_encloses(scene, membrane, key, report);
    check_contents(scene, membrane, key, report);
    check_bed(scene, membrane, key, report);
    check_permittivity(scene, membrane, key, report);
    check_permittivity_table(membrane, key, report);
    check_fluid_around(scene, membrane, key, report);
    check_free_water(scene, membrane, key, report);
    if (report.healthy("solver.transfer")) check_interface(scene, membrane, key, report);
  }
}

}  // namespace geodrop
