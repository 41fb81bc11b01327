// Membranes.
#include "sections.hpp"

namespace geodrop {
namespace {

constexpr Range friction_or_glued{">= 0, or inf", [](double x) { return x >= 0; }, true};
constexpr Range dense{"from 2 (fluid leaks between nodes that are farther apart) to 64",
                      [](double x) { return x >= 2 && x <= 64; }};
constexpr Range dense_in_space{"from 1 to 64", [](double x) { return x >= 1 && x <= 64; }};
constexpr Range poisson_range{"> -1 and < 1", [](double x) { return x > -1 && x < 1; }};
constexpr Range slack_range{"> -1", [](double x) { return x > -1; }};
constexpr Range share_but_all{">= 0 and < 1", [](double x) { return x >= 0 && x < 1; }};

}  // namespace

// clang-format off
SectionOf<SurfaceSpec> surface_section() {
  constexpr RowsOf<SurfaceSpec> key;
  constexpr auto round = [](EllipsoidSurface& sphere, double radius) { sphere.semi_axes = Point(3, radius); };
  return {
      "surface of a membrane in space", "",
      "An inline table; `type` says which keys it has. Two flat pieces of cloth that are sewn together are drawn a "
      "little open, and their tension is that of the flat cloth.",
      R"([[membranes]]
name = "pillow"
surface = { type = "capsule", from = [-0.3, 0.0, 0.0], to = [0.3, 0.0, 0.0], radius = 0.25 }
axial_stiffness = 1.0e6
mass_per_area = 0.6
strength = 120.0e3
slack = 0.0
gauge_pressure = 5000.0)", {
      key("type", itself<SurfaceSpec>, {{"sphere", EllipsoidSurface{}}, {"ellipsoid", EllipsoidSurface{}}, {"capsule", CapsuleSurface{}}, {"tube", TubeSurface{}}, {"pillow", PillowSurface{}}, {"disc_pillow", DiscPillowSurface{}}, {"file", FileSurface{}}}, required, "which surface; capsule: a cylinder with hemispherical caps; tube: a cylinder with flat ends; pillow, disc_pillow: two rectangles, two discs sewn together along their rims; file: any closed surface").in(3),
      key("centre", Either(&EllipsoidSurface::centre, &PillowSurface::centre, &DiscPillowSurface::centre), "m", required, any, "centre").only("type=sphere|ellipsoid|pillow|disc_pillow").in(3),
      key("semi_axes", &EllipsoidSurface::semi_axes, "m", required, positive, "half lengths of the axes along x, y, z").only("type=ellipsoid").in(3),
      key("from", Either(&CapsuleSurface::from, &TubeSurface::from), "m", required, any, "centre of one cap or end").only("type=capsule|tube").in(3),
      key("to", Either(&CapsuleSurface::to, &TubeSurface::to), "m", required, any, "centre of the other").only("type=capsule|tube").in(3),
      key("section", &TubeSurface::section, {{"ellipse", TubeSurface::Section::ellipse}, {"stadium", TubeSurface::Section::stadium}}, required, "of the tube; stadium: a rectangle with a semicircle on both short sides").only("type=tube").in(3),
      key("half_width", &TubeSurface::half_width, "m", required, positive, "of the section, level (of an upright tube along x)").only("type=tube").in(3),
      key("half_height", &TubeSurface::half_height, "m", required, positive, "of the section, across that").only("type=tube").in(3),
      key("tilt_deg", &TubeSurface::tilt_deg, "degree", standard("0.0"), any, "rotation of the section, anticlockwise as seen from `to`").only("type=tube").in(3),
      key("radius", Either(round, &CapsuleSurface::radius, &DiscPillowSurface::radius), "m", required, positive, "of the sphere, of the cylinder and its caps, of the discs").only("type=sphere|capsule|disc_pillow").in(3),
      key("length", &PillowSurface::length, "m", required, positive, "of the cloth along x").only("type=pillow").in(3),
      key("width", &PillowSurface::width, "m", required, positive, "of the cloth along y: half the perimeter of a tube that is filled").only("type=pillow").in(3),
      key("thickness", Either(&PillowSurface::thickness, &DiscPillowSurface::thickness), "m", required, positive, "in the middle, as drawn").only("type=pillow|disc_pillow").in(3),
      key("file", &FileSurface::file, required, filled, "an STL file (.stl, text or binary) or an OBJ file (.obj) in metres, beside the scene file unless the path is absolute: closed, triangles facing outwards").only("type=file").in(3),
  }};
}

SectionOf<MembraneSpec> membranes_section() {
  constexpr RowsOf<MembraneSpec> key;
  return {
      "[[membranes]]", "name",
      "Tension-only geotextiles. In the plane they lie on the outline of a body, and without stiffness and mass a "
      "membrane is a skin, which marks the outline that contacts act on. In space they are surfaces of "
      "triangles, closed or up to planes of symmetry, glued to what is inside, empty or around a body of shape `inside`.",
      R"([[membranes]]
name = "geotextile"
body = "bag"
axial_stiffness = 1.0e6  # 120 kN/m at a strain of 12 %
mass_per_area = 0.6
strength = 120.0e3
slack = 0.02  # 2 % longer than drawn
interface = "sharp"
shear = "rough_wall"
roughness = 0.003)", {
      key("name", &MembraneSpec::name, required, identifier, "heads the membrane's columns in history.csv"),
      key("body", &MembraneSpec::body, required, reference, "the body on whose outline it lies; with interface = sharp that may be the water in the pores of a soil, for a bag of soil and free water").in(2),
      key("points", &MembraneSpec::points, "m", standard("[]"), any, "the polyline, each point on the body's outline; empty: the whole outline").in(2),
      key("closed", &MembraneSpec::closed, standard("true"), "the last point joins the first").in(2),
      key("axial_stiffness", &MembraneSpec::axial_stiffness, "N/m", required, not_negative, "J, tension per strain; 0 with mass_per_area = 0: a skin that only carries contact"),
      key("mass_per_area", &MembraneSpec::mass_per_area, "kg/m2", required, not_negative, "mass per area"),
      key("strength", &MembraneSpec::strength, "N/m", standard("0.0"), not_negative, "tension at which it would tear, > 0; may be left out if axial_stiffness is 0"),
      key("slack", &MembraneSpec::slack, "", required, slack_range, "rest length / drawn length - 1; below 0 it is under tension from the start"),
      key("segments_per_cell", &MembraneSpec::segments_per_cell, "", standard("4.0"), dense, "nodes are h / segments_per_cell apart").in(2),
      key("segments_per_cell", &MembraneSpec::segments_per_cell, "", standard("1.6"), dense_in_space, "edges of triangles are about h / segments_per_cell long").in(3),
      key.table("surface", &MembraneSpec::surface, surface_section(), required, "where it is at the start").in(3),
      key("ends_at", &MembraneSpec::ends_at, standard("[]"), free_text, "walls of the domain (\"left\", \"right\", \"front\", \"back\", \"bottom\", \"top\") that are planes of symmetry at which the surface ends: what lies beyond is cut off, and all forces are those of what is left; slip walls, of at most two axes, both of one or one of each").in(3),
      key("fabric", &MembraneSpec::fabric, {{"isotropic", Fabric::isotropic}, {"rubber", Fabric::rubber}, {"yarns", Fabric::yarns}}, standard("\"isotropic\""), "isotropic: a tension field, taut, wrinkled or slack; rubber: the same of an incompressible neo-Hookean sheet, axial_stiffness that of a strip at its first stretch; yarns: warp and weft, which bear tension along themselves only and turn freely against each other").in(3),
      key("poisson_ratio", &MembraneSpec::poisson_ratio, "", standard("0.0"), poisson_range, "nu of the taut cloth").only("fabric=isotropic").in(3),
      key("weft_stiffness", &MembraneSpec::weft_stiffness, "N/m", required, positive, "J of the weft; axial_stiffness is that of the warp").only("fabric=yarns").in(3),
      key("weft_strength", &MembraneSpec::weft_strength, "N/m", required, positive, "of the weft; strength is that of the warp").only("fabric=yarns").in(3),
      key("warp", &MembraneSpec::warp, "", standard("[1.0, 0.0, 0.0]"), any, "direction of the warp: what of it lies in the cloth as it is cut out").only("fabric=yarns").in(3),
      key("gauge_pressure", &MembraneSpec::gauge_pressure, "Pa", standard("0.0"), any, "pressure inside over that outside, the same all over; that of fluids at rest is one of still_fluids").in(3),
      key("interface", &MembraneSpec::interface, {{"mixture", Interface::mixture}, {"sharp", Interface::sharp}}, standard("\"mixture\""), "mixture: its body and what is around it move with one velocity field and stick to each other; sharp: each has its own, they slip along the membrane as far as `shear` lets them and share the cells that it cuts exactly"),
      key("shear", &MembraneSpec::shear, {{"none", Shear::none}, {"wall_law", Shear::wall_law}, {"rough_wall", Shear::rough_wall}, {"no_slip", Shear::no_slip}}, required, "what hinders the fluid around that slips along it: nothing; tau = 1/2 rho C_f u^2 at a velocity of slipping u, C_f given; C_f from the logarithmic law of a wall of the given roughness; it sticks").only("interface=sharp"),
      key("wall_friction", &MembraneSpec::wall_friction, "", required, not_negative, "C_f of the wall law").only("shear=wall_law"),
      key("roughness", &MembraneSpec::roughness, "m", required, positive, "k_s, diameter of the sand grains that would be as rough: some 1 to 3 mm of a geotextile with seams").only("shear=rough_wall"),
      key("drag_coefficient", &MembraneSpec::drag_coefficient, "", standard("0.0"), not_negative, "C_d of a model drag 1/2 rho C_d W v^2 on the width W across the body's motion, in place of the wake that a flow without friction lacks; the fluid does not feel it").only("interface=sharp").in(2),
      key("bed", &MembraneSpec::bed, standard("\"\""), free_text, "with interface = sharp: a body of soil around it on which it rubs and from which it parts rather than pull; it does not part from anything else. Of coupled soil the grains alone push and rub"),
      key("bed_friction", &MembraneSpec::bed_friction, "", standard("0.0"), not_negative, "coefficient of friction on the bed; given with bed only"),
      key("permittivity", &MembraneSpec::permittivity, "1/s", standard("0.0"), not_negative, "psi of the data sheet (EN ISO 11058, ASTM D4491): water flows through it by psi times the difference of head, and out of it into air, where it leaves the scene; 0: tight. Given with interface = sharp around a coupled soil only").only("interface=sharp"),
      key("clogging", &MembraneSpec::clogging, "", standard("0.0"), share_but_all, "part of the permittivity that grains in the pores of the geotextile take, from a test with the soil (gradient ratio, ASTM D5101)").only("interface=sharp"),
      key.reals("permittivity_strains", &MembraneSpec::permittivity_strains, "", standard("[]"), any, "strains of the geotextile, ascending, for which permittivity_factors stand: stretched cloth is more open, or less; empty: the same at any strain").only("interface=sharp"),
      key.reals("permittivity_factors", &MembraneSpec::permittivity_factors, "", standard("[]"), not_negative, "how many times the permittivity it has at each of these strains, linear between them, constant before the first and after the last").only("interface=sharp"),
      key("contents_friction", &MembraneSpec::contents_friction, "", derived("tan(2/3 phi) of a mohr_coulomb body, `0.0` of a newtonian one, else `inf`"), friction_or_glued, "mu between the geotextile and what is inside: it slides along its line where its tension changes by more than mu p' per length, p' the effective pressure of the body on it; inf: glued to the body").in(2),
      key("gauge_length", &MembraneSpec::gauge_length, "m", standard("0.2"), positive, "length along the membrane that the reported tension is a mean over; 0.2 m is the width of a wide-width strip test").in(2),
  }};
}
// clang-format on

}  // namespace geodrop
