// What acts on bodies and membranes from outside of the simulated domain.
#include "sections.hpp"

namespace geodrop {
namespace {

constexpr Range stiffness_range{"> 0; inf: it does not stretch", [](double x) { return x > 0; }, true};
constexpr Range depth_range{"> 0; inf: no spring", [](double x) { return x > 0; }, true};
constexpr Range rest_range{"> 0; inf: never", [](double x) { return x > 0; }, true};
constexpr Range beyond_range{"> 0; inf: it stands still", [](double x) { return x > 0; }, true};

}  // namespace

// clang-format off
SectionOf<StillFluidSpec> still_fluids_section() {
  constexpr RowsOf<StillFluidSpec> key;
  return {
      "[[still_fluids]]", "membrane",
      "Still water in a basin so large that a tube does not move it: its pressure, gamma times depth, acts on a "
      "closed membrane from outside, also where that lies on the ground, or in space from inside. A body of water that "
      "moves is one of `bodies`.",
      R"([[still_fluids]]
membrane = "geotextile"
fluid = "water"
surface = 6.0)", {
      key("membrane", &StillFluidSpec::membrane, required, reference, "the closed membrane that it presses on"),
      key("fluid", &StillFluidSpec::fluid, required, reference, "the newtonian material of the fluid"),
      key("side", &StillFluidSpec::side, {{"outside", StillFluidSpec::Side::outside}, {"inside", StillFluidSpec::Side::inside}}, standard("\"outside\""), "which side of the membrane it is on").in(3),
      key("surface", &StillFluidSpec::surface, "m", required, any, "level of its surface; of one that is pumped into a tube the level up to which it would rise in a standpipe"),
  }};
}

SectionOf<AnchorSpec> anchors_section() {
  constexpr RowsOf<AnchorSpec, &AnchorSpec::by> key;
  return {
      "[[anchors]]", "name",
      "Points at which membranes hang: a node that is held where it is drawn, or that hangs on an elastic line "
      "without mass. history.csv has the force of each on the membrane, `force_x_N_m`, `force_y_N_m` and its size "
       "`pull_N_m` (in space `_N`), and `length_m` of a line. Cloth that slides over its contents does not slide within "
       "1.5 cells of an anchor along its line, as if a strap of that width were sewn on.",
       R"([[membranes]]
name = "geotextile"
body = "bag"
axial_stiffness = 1.0e6
mass_per_area = 0.6
strength = 120.0e3
slack = 0.0
contents_friction = inf  # glued to its contents

[[anchors]]
name = "rope"
membrane = "geotextile"
at = [0.0, 5.0]
type = "line"
to = [0.0, 8.0]
stiffness = 1.0e5
length = 3.0)", {
      key("name", &AnchorSpec::name, required, identifier, "heads the anchor's columns in history.csv"),
      key("membrane", &AnchorSpec::membrane, required, reference, "the membrane that hangs on it"),
      key("at", &AnchorSpec::point, "m", required, any, "a point of the membrane as drawn, two cells or more from the sides of the domain; its nearest node is the one"),
      key("type", &AnchorSpec::by, {{"held", HeldSpec{}}, {"line", AnchorLineSpec{}}}, required, "held: the node stays where it is drawn; line: a line from the node to a fixed point bears tension when it is longer than at rest"),
      key("to", &AnchorLineSpec::to, "m", required, any, "the fixed end of the line; it may be outside of the domain").only("type=line"),
      key("stiffness", &AnchorLineSpec::stiffness, "N/m", required, stiffness_range, "of the line, force per extension (2D: per metre of depth, N/m2)").only("type=line"),
      key("length", &AnchorLineSpec::length, "m", required, positive, "of the line at rest").only("type=line"),
  }};
}

SectionOf<ViscousBoundarySpec> viscous_boundaries_section() {
  constexpr RowsOf<ViscousBoundarySpec> key;
  return {
      "[[viscous_boundaries]]", "name",
      "Edges of the ground that let waves out (Lysmer & Kuhlemeyer 1969): dashpots of rho c_p along the normal, rho "
      "c_s across it, and along the normal a spring that keeps the edge in place. They take up the stress of the "
      "start, so that ground at rest stays at rest. The edge is free otherwise: there are at least 4 cells of empty "
      "grid beyond it. Waves that meet it at right angles leave, oblique ones in part.",
      R"([[bodies]]
name = "bed"
material = "sand"
shape = { type = "box", lower = [-3.0, -1.0], upper = [2.0, 0.0] }  # and empty grid beyond its edge
initial_stress = { type = "k0", surface = 0.0, k0 = 0.5, under = "air" }

[[viscous_boundaries]]
name = "edge"
body = "bed"
from = [2.0, -1.0]
to = [2.0, 0.0]
spring_depth = 10.0)", {
      key("name", &ViscousBoundarySpec::name, required, identifier, "what messages call it"),
      key("body", &ViscousBoundarySpec::body, required, reference, "the solid body whose edge it is"),
      key("from", &ViscousBoundarySpec::from, "m", required, any, "one end of the edge, on the body's outline"),
      key("to", &ViscousBoundarySpec::to, "m", required, any, "its other end; the outline runs straight between them"),
      key("spring_depth", &ViscousBoundarySpec::spring_depth, "m", required, depth_range, "thickness of the layer of the same ground, on rock, that the spring stands for: its stiffness is rho c_p^2 / spring_depth"),
  }};
}

SectionOf<SilentSideSpec> absorbing_layers_section() {
  constexpr RowsOf<SilentSideSpec> key;
  return {
      "[[absorbing_layers]]", "name",
      "Sides of the domain through which waves in water at rest leave: in a layer beside the wall pressure fades to "
      "that of the still fluid, and the velocity across to that of the water beyond, both at the same rate, so that "
      "waves meet no change of impedance. Water that comes or goes is mass of the particles there. Levels and slow "
      "flows: `water_beyond`.",
      R"([[absorbing_layers]]
name = "open_sea"
body = "water"
side = "left"
width = 1.0
water_beyond = 20.0
rest_time = 10.0)", {
      key("name", &SilentSideSpec::name, required, identifier, "what messages call it"),
      key("body", &SilentSideSpec::body, required, reference, "the newtonian body, at rest at the start with initial_stress \"hydrostatic\", which is the pressure that stays"),
      key("side", &SilentSideSpec::side, {{"left", SilentSideSpec::Side::left}, {"right", SilentSideSpec::Side::right}}, required, "which wall of the domain the layer lies at"),
      key("width", &SilentSideSpec::width, "m", required, positive, "of the layer; at least 4 cells"),
      key("water_beyond", &SilentSideSpec::water_beyond, "m", required, beyond_range, "L: the water beyond flows by dv/dt = (p - p_still)/(rho L), as a column of that length would; about the distance from what moves to the wall, or 2/pi of the depth where that is less. Waves longer than 4 pi L come back. inf: none flows, for waves alone"),
      key("rest_time", &SilentSideSpec::rest_time, "s", required, rest_range, "T: what the pressure of a row keeps over p_still for longer than that is no wave and stays, and the water beyond comes to rest with this time constant; longer than what shall pass, as a fall. inf: p_still for ever; the error of a grid at rest then drives a slow circulation"),
  }};
}

SectionOf<PumpSpec> pumps_section() {
  constexpr RowsOf<PumpSpec> key;
  return {
      "[[pumps]]", "body",
      "Pumps: each particle of a body of newtonian material gains mass at the same relative rate.",
      R"([[bodies]]
name = "bag"
material = "water"
shape = { type = "ellipse", centre = [0.0, 4.5], semi_axes = [1.0, 0.5] }
initial_stress = { type = "hydrostatic", fluid = "water", surface = 6.0 }

[[pumps]]
body = "bag"
rate = 0.2
from = 0.0
to = 2.0)", {
      key("body", &PumpSpec::body, required, reference, "which body grows"),
      key("rate", &PumpSpec::rate, "m3/s", required, positive, "volume at zero pressure per time (2D: per metre of depth, m2/s)"),
      key("from", &PumpSpec::from, "s", required, not_negative, "when it starts"),
      key("to", &PumpSpec::to, "s", required, positive, "when it ends; a relaxation does not end before"),
  }};
}
// clang-format on

}  // namespace geodrop
