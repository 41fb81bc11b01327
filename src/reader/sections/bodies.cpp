// Bodies and their shapes.
#include "sections.hpp"

namespace geodrop {
namespace {

constexpr Range half{">= 0 and <= 0.5", [](double x) { return x >= 0 && x <= 0.5; }};
constexpr Range per_axis{"1 to 8", [](double x) { return x >= 1 && x <= 8; }};
constexpr Range bands{"1 to 255", [](double x) { return x >= 1 && x <= 255; }};

}  // namespace

// clang-format off
SectionOf<Shape> shape_section() {
  constexpr RowsOf<Shape> key;
  return {
      "shape of a body", "",
      "An inline table; `type` says which keys it has.",
      R"([[bodies]]
name = "bag"
material = "sand"
shape = { type = "polygon", points = [[-1.0, 4.0], [1.0, 4.0], [0.7, 5.0], [-0.7, 5.0]] }
initial_stress = { type = "fluid_pressure", fluid = "water", surface = 6.0, effective_pressure = 2000.0 })", {
      key("type", itself<Shape>, {{"box", BoxShape{}}, {"ellipse", EllipseShape{}}, {"stadium", StadiumShape{}}, {"polygon", PolygonShape{}}, {"half_plane", HalfPlaneShape{}}}, required, "which shape; stadium: a rectangle with a semicircle on both short sides").in(2),
      key("type", itself<Shape>, {{"box", BoxShape{}}, {"ellipsoid", EllipseShape{}}, {"half_space", HalfPlaneShape{}}, {"inside", InsideShape{}}}, required, "which shape; inside: what a membrane encloses as it is drawn").in(3),
      key("lower", &BoxShape::lower, "m", required, any, "lower corner").only("type=box"),
      key("upper", &BoxShape::upper, "m", required, any, "upper corner").only("type=box"),
      key("centre", Either(&EllipseShape::centre, &StadiumShape::centre), "m", required, any, "centre").only("type=ellipse|stadium|ellipsoid"),
      key("semi_axes", Either(&EllipseShape::semi_axes, &StadiumShape::semi_axes), "m", required, positive, "half lengths of the axes; those of an ellipsoid lie along x, y, z; the smaller one is the radius of a stadium's ends").only("type=ellipse|stadium|ellipsoid"),
      key("tilt_deg", Either(&EllipseShape::tilt_deg, &StadiumShape::tilt_deg), "degree", standard("0.0"), any, "anticlockwise rotation of the axes").only("type=ellipse|stadium"),
      key("points", &PolygonShape::points, "m", required, any, "at least 3 corners of a polygon that does not cross itself, in either sense").only("type=polygon"),
      key("point", &HalfPlaneShape::point, "m", required, any, "a point of the boundary").only("type=half_plane|half_space"),
      key("normal", &HalfPlaneShape::normal, "", required, any, "points out of the body; of any length").only("type=half_plane|half_space"),
      key("membrane", &InsideShape::membrane, required, reference, "the membrane").only("type=inside").in(3),
  }};
}

SectionOf<BodySpec> bodies_section() {
  constexpr RowsOf<BodySpec> key;
  return {
      "[[bodies]]", "name",
      "One table for each body: a shape filled with particles of one material.",
      R"([[bodies]]
name = "bag"
material = "sand"
shape = { type = "ellipse", centre = [0.0, 4.5], semi_axes = [1.0, 0.5] }
layers = 8
initial_stress = { type = "fluid_pressure", fluid = "water", surface = 6.0, effective_pressure = 2000.0 })", {
      key("name", &BodySpec::name, required, identifier, "heads the body's columns in history.csv"),
      key("material", &BodySpec::material, required, reference, "a name in materials"),
      key.table("shape", &BodySpec::shape, shape_section(), required, "where the body is at the start"),
      key("minus", &BodySpec::minus, standard("[]"), reference, "bodies whose shapes are cut out of this one"),
      key("saturated_by", &BodySpec::saturated_by, standard("\"\""), free_text, "the body of a fluid that fills the pores of this one, of a coupled soil; its shape covers this body's, without minus; \"\": none"),
      key("particles_per_cell_axis", &BodySpec::particles_per_cell_axis, "", standard("2"), per_axis, "particles per cell along each axis"),
      key("jitter", &BodySpec::jitter, "", standard("0.0"), half, "random offset of the particles, as a fraction of their spacing"),
      key("jitter_seed", &BodySpec::jitter_seed, "", standard("0"), not_negative, "seed of the random offsets"),
      key.table("initial_velocity", &BodySpec::initial_velocity, initial_velocity_section(), standard("{ type = \"rest\" }"), "velocity at the start"),
      key.table("initial_stress", &BodySpec::initial_stress, initial_stress_section(), required, "stress at the start"),
      key("pressure", &BodySpec::pressure, {{"cell", PressureSupport::cell}, {"particle", PressureSupport::particle}, {"nodal", PressureSupport::nodal}, {"enclosed", PressureSupport::enclosed}}, standard("\"cell\""), "where the mean stress acts from: the average of the cell (not on tri3, tet4), each particle, (only on tri3, tet4) the average at the nodes, or, for a fluid that fills a closed membrane (bspline2; in space all bodies then), the average of cells that the membrane cuts exactly"),
      key("layers", &BodySpec::layers, "", standard("1"), bands, "horizontal bands that colour the picture"),
      key("implicit_pore_pressure", &BodySpec::implicit_pore_pressure, standard("false"), "pore pressure of undrained soil, or of the water that saturates a coupled one, at the end of the step (implicit Euler): the time step follows the skeleton alone, however stiff the water in the pores is"),
      key("shift", &BodySpec::shift, standard("false"), "move particles out of clumps and into voids, and apart where they are closer than their size (fluids only); a fluid that flows past a sharp membrane by more than its width needs it (docs/verification.md)"),
      key("shift_speed", &BodySpec::shift_speed, "m/s", standard("0.0"), not_negative, "v0, shifting of a particle at rest; with it fluids keep their volume where they splash (docs/step.md, crowding)"),
  }};
}
// clang-format on

}  // namespace geodrop
