// Membranes.
#include "sections.hpp"

namespace geodrop {
namespace {

constexpr Range friction_or_glued{">= 0, or inf", [](double x) { return x >= 0; }, true};
constexpr Range dense{"from 2 (fluid leaks between nodes that are farther apart) to 64",
                      [](double x) { return x >= 2 && x <= 64; }};
constexpr Range slack_range{"> -1", [](double x) { return x > -1; }};

}  // namespace

// clang-format off
SectionOf<MembraneSpec> membranes_section() {
  constexpr RowsOf<MembraneSpec> key;
  return {
      "[[membranes]]", "name",
      "Tension-only geotextiles on the outline of a body; in two dimensions only. Without stiffness and mass a "
      "membrane is a skin, which marks the outline that contacts act on.", {
      key("name", &MembraneSpec::name, required, identifier, "heads the membrane's columns in history.csv"),
      key("body", &MembraneSpec::body, required, reference, "the body on whose outline it lies"),
      key("points", &MembraneSpec::points, "m", standard("[]"), any, "the polyline, each point on the body's outline; empty: the whole outline"),
      key("closed", &MembraneSpec::closed, standard("true"), "the last point joins the first"),
      key("axial_stiffness", &MembraneSpec::axial_stiffness, "N/m", required, not_negative, "J, tension per strain; 0 with mass_per_area = 0: a skin that only carries contact"),
      key("mass_per_area", &MembraneSpec::mass_per_area, "kg/m2", required, not_negative, "mass per area"),
      key("strength", &MembraneSpec::strength, "N/m", standard("0.0"), not_negative, "tension at which it would tear, > 0; may be left out if axial_stiffness is 0"),
      key("slack", &MembraneSpec::slack, "", required, slack_range, "rest length / drawn length - 1; below 0 it is under tension from the start"),
      key("segments_per_cell", &MembraneSpec::segments_per_cell, "", standard("4.0"), dense, "nodes are h / segments_per_cell apart"),
      key("interface", &MembraneSpec::interface, {{"mixture", Interface::mixture}, {"sharp", Interface::sharp}}, standard("\"mixture\""), "mixture: its body and what is around it move with one velocity field and stick to each other; sharp: each has its own, they slip along the membrane as far as `shear` lets them and share the cells that it cuts exactly").in(2),
      key("shear", &MembraneSpec::shear, {{"none", Shear::none}, {"wall_law", Shear::wall_law}, {"rough_wall", Shear::rough_wall}, {"no_slip", Shear::no_slip}}, required, "what hinders the fluid around that slips along it: nothing; tau = 1/2 rho C_f u^2 at a velocity of slipping u, C_f given; C_f from the logarithmic law of a wall of the given roughness; it sticks").only("interface=sharp"),
      key("wall_friction", &MembraneSpec::wall_friction, "", required, not_negative, "C_f of the wall law").only("shear=wall_law"),
      key("roughness", &MembraneSpec::roughness, "m", required, positive, "k_s, diameter of the sand grains that would be as rough: some 1 to 3 mm of a geotextile with seams").only("shear=rough_wall"),
      key("drag_coefficient", &MembraneSpec::drag_coefficient, "", standard("0.0"), not_negative, "C_d of a model drag 1/2 rho C_d W v^2 on the width W across the body's motion, in place of the wake that a flow without friction lacks; the fluid does not feel it").only("interface=sharp"),
      key("bed", &MembraneSpec::bed, standard("\"\""), free_text, "with interface = sharp: a body of soil around it on which it rubs and from which it parts rather than pull; it does not part from anything else"),
      key("bed_friction", &MembraneSpec::bed_friction, "", standard("0.0"), not_negative, "coefficient of friction on the bed; given with bed only"),
      key("permittivity", &MembraneSpec::permittivity, "1/s", standard("0.0"), not_negative, "psi of the data sheet (EN ISO 11058, ASTM D4491), less what clogs: water flows through it by psi times the difference of head; 0: tight. Given with interface = sharp around a coupled soil only").only("interface=sharp"),
      key("contents_friction", &MembraneSpec::contents_friction, "", derived("tan(2/3 phi) of a mohr_coulomb body, `0.0` of a newtonian one, else `inf`"), friction_or_glued, "mu between the geotextile and what is inside: it slides along its line where its tension changes by more than mu p' per length, p' the effective pressure of the body on it; inf: glued to the body"),
      key("gauge_length", &MembraneSpec::gauge_length, "m", standard("0.2"), positive, "length along the membrane that the reported tension is a mean over; 0.2 m is the width of a wide-width strip test"),
  }};
}
// clang-format on

}  // namespace geodrop
