// Rigid bodies, how they move, and what touches what.
#include "sections.hpp"

namespace geodrop {
namespace {

constexpr Range penalty_range{"> 0 and <= 4 (stiffer contacts gain energy)", [](double x) { return x > 0 && x <= 4; }};

}  // namespace

// clang-format off
SectionOf<RigidShape> rigid_shape_section() {
  constexpr RowsOf<RigidShape> key;
  return {
      "shape of a rigid body", "",
      "An inline table; `type` says which keys it has. What comes beside the segment of a capsule or a polyline stays "
      "on the side on which it came, down to twice the radius deep. What is inside a box or polygon leaves it the "
      "nearest way, and so in space a box or prism: parts thinner than a cell do not hold. In an inner corner both faces push, at an outer one the corner "
      "does.",
      R"([[rigid]]
name = "slope"
shape = { type = "polyline", points = [[-4.0, 1.5], [-2.0, 0.5], [0.0, 0.2]], radius = 0.15 })", {
      key("type", itself<RigidShape>, {{"half_plane", HalfPlaneShape{}}, {"capsule", CapsuleShape{}}, {"box", BoxShape{}}, {"polygon", PolygonShape{}}, {"polyline", PolylineShape{}}}, required, "which shape; capsule: a segment with rounded ends; polyline: a line of such segments").in(2),
      key("type", itself<RigidShape>, {{"half_space", HalfPlaneShape{}}, {"box", BoxShape{}}, {"prism", PrismShape{}}}, required, "which shape; prism: a polygon in a plane across x, drawn out along x").in(3),
      key("point", &HalfPlaneShape::point, "m", required, any, "a point of the boundary").only("type=half_plane|half_space"),
      key("normal", &HalfPlaneShape::normal, "", required, any, "points out of the rigid body; of any length").only("type=half_plane|half_space"),
      key("from", &CapsuleShape::from, "m", required, any, "one end of the segment").only("type=capsule"),
      key("to", &CapsuleShape::to, "m", required, any, "its other end; the same point: a disc").only("type=capsule"),
      key("lower", &BoxShape::lower, "m", required, any, "lower corner").only("type=box"),
      key("upper", &BoxShape::upper, "m", required, any, "upper corner").only("type=box"),
      key("points", Either(&PolygonShape::points, &PolylineShape::points), "m", required, any, "at least 3 corners of a polygon, in either sense, or 2 of a polyline, in order; neither crosses itself").only("type=polygon|polyline"),
      key("points", &PrismShape::points, "m", required, any, "at least 3 corners of the end of least x, all with that x, in either sense; the section does not cross itself").only("type=prism").in(3),
      key("length", &PrismShape::length, "m", required, positive, "along x").only("type=prism").in(3),
      key("radius", Either(&CapsuleShape::radius, &PolylineShape::radius), "m", required, positive, "of the ends, half the thickness").only("type=capsule|polyline"),
  }};
}

SectionOf<RigidMotion> rigid_motion_section() {
  constexpr RowsOf<RigidMotion> key;
  return {
      "motion of a rigid body", "",
      "An inline table; `type` says which keys it has.",
      R"([[rigid]]
name = "port"
shape = { type = "capsule", from = [-0.15, 5.0], to = [-2.5, 6.5], radius = 0.15 }
motion = { type = "hinge", centre = [0.0, 6.5], rate = -0.1, stop_angle_deg = 30.0 })", {
      key("type", itself<RigidMotion>, {{"none", std::monostate{}}, {"hinge", HingeMotionSpec{}}, {"translation", TranslationMotionSpec{}}, {"table", TableMotionSpec{}}}, required, "hinge: rotation at a constant rate; translation: at a constant velocity; table: either, piecewise linear in time"),
      key("rate", &HingeMotionSpec::rate, "rad/s", required, not_zero, "anticlockwise; in space from y to z").only("type=hinge"),
      key("stop_angle_deg", &HingeMotionSpec::stop_angle_deg, "degree", required, positive, "how far it turns, in either sense").only("type=hinge"),
      key("velocity", &TranslationMotionSpec::velocity, "m/s", required, any, "of all its points").only("type=translation"),
      key.decides("of", {"angle", "displacement"}, required, "what the table lists").only("type=table"),
      key.reals("times", &TableMotionSpec::times, "s", required, not_negative, "ascending; it is at rest before the first and after the last").only("type=table"),
      key.reals("angles_deg", &TableMotionSpec::angles_deg, "degree", required, any, "one for each time, anticlockwise from the start; in space from y to z").only("of=angle"),
      key("displacements", &TableMotionSpec::displacements, "m", required, any, "one for each time, from the start").only("of=displacement"),
      key("centre", &HingeMotionSpec::centre, "m", required, any, "of the rotation; in space about the axis along x through it").only("type=hinge"),
      key("centre", &TableMotionSpec::centre, "m", required, any, "of the rotation; in space about the axis along x through it").only("of=angle"),
  }};
}

SectionOf<RigidSpec> rigid_section() {
  constexpr RowsOf<RigidSpec> key;
  return {
      "[[rigid]]", "name",
      "Rigid ground, walls and hulls; only what `contacts` names notices them.",
      R"([[rigid]]
name = "quay"
shape = { type = "box", lower = [3.0, 0.0], upper = [4.0, 6.5] })", {
      key("name", &RigidSpec::name, required, identifier, "what contacts refer to"),
      key.table("shape", &RigidSpec::shape, rigid_shape_section(), required, "where it is"),
      key.table("motion", &RigidSpec::motion, rigid_motion_section(), standard("{ type = \"none\" }"), "how it moves; a half-space does not turn"),
  }};
}

SectionOf<ContactSpec> contacts_section() {
  constexpr RowsOf<ContactSpec> key;
  constexpr auto between = [](ContactSpec& contact, const std::vector<std::string>& names) {
    if (names.size() == 2) contact.between = {names[0], names[1]};  // check_contacts refuses other numbers
  };
  return {
      "[[contacts]]", "",
      "Surface contact of a membrane's nodes, or of the particles of a body without membrane, with a rigid body, "
      "and of membranes with each other or their own folds: penalty normal to the surface, Coulomb friction along "
      "it.",
      R"([[rigid]]
name = "quay"
shape = { type = "box", lower = [3.0, 0.0], upper = [4.0, 6.5] }

[[contacts]]
between = ["geotextile", "quay"]
friction = 0.3

[[contacts]]
between = ["geotextile", "geotextile"]  # of its folds
friction = 0.3)", {
      key("between", between, required, reference, "in any order a membrane, or a body without one, and a rigid body; two membranes; or in the plane one membrane twice for its own folds"),
      key("friction", &ContactSpec::friction, "", required, not_negative, "coefficient of Coulomb friction; in the plane, of a geotextile with a permittivity, on the effective pressure of the soil inside: water does not rub"),
      key("stiffness", &ContactSpec::stiffness, "", standard("1.0"), penalty_range, "of the penalty: pressure per penetration over P / h, with P the modulus of compression waves of the body that touches, h the cell. The step is at most h / (c sqrt(2 stiffness))"),
      key("damping", &ContactSpec::damping, "", standard("1.0"), share, "of the penalty: pressure per normal velocity over the impedance rho c of the body that touches (of two membranes: of both bodies in series); 1 absorbs what its own waves bring"),
  }};
}
// clang-format on

}  // namespace geodrop
