// Rigid bodies, how they move, and what touches what.
#pragma once

#include <geodrop/base/error.hpp>
#include <geodrop/geometry/shape.hpp>

#include <array>
#include <string>
#include <variant>
#include <vector>

namespace geodrop {

/// All points within `radius` of a segment; a disc if its ends are one point.
struct CapsuleShape {
  Point from, to;     ///< ends of the segment [m]
  double radius = 0;  ///< [m]
  bool operator==(const CapsuleShape&) const = default;
};
/// All points within `radius` of a line of segments.
struct PolylineShape {
  std::vector<Point> points;  ///< [m]
  double radius = 0;          ///< [m]
  bool operator==(const PolylineShape&) const = default;
};
/// In space: a polygon in a plane across x, drawn out along x.
struct PrismShape {
  std::vector<Point> points;  ///< corners of its end of least x, all with the same x [m]
  double length = 0;          ///< along x [m]
  bool operator==(const PrismShape&) const = default;
};
using RigidShape = std::variant<HalfPlaneShape, CapsuleShape, BoxShape, PolygonShape, PolylineShape, PrismShape>;

/// Rotation about a point that stands still, in space about the axis along x through it.
struct HingeMotionSpec {
  Point centre;               ///< [m]
  double rate = 0;            ///< anticlockwise, in space from y to z [rad/s]
  double stop_angle_deg = 0;  ///< where it ends, > 0 in either sense [degree]
  bool operator==(const HingeMotionSpec&) const = default;
};
struct TranslationMotionSpec {
  Point velocity;  ///< [m/s]
  bool operator==(const TranslationMotionSpec&) const = default;
};
/// Piecewise linear between the times, at rest before the first and after the last of them.
struct TableMotionSpec {
  std::vector<double> times;         ///< since the body began to move, ascending [s]
  Point centre;                      ///< of a rotation [m]
  std::vector<double> angles_deg;    ///< of a rotation, anticlockwise from the start [degree]; else empty
  std::vector<Point> displacements;  ///< of a translation, from the start [m]; else empty
  bool operator==(const TableMotionSpec&) const = default;
};
/// The first of them: it does not move.
using RigidMotion = std::variant<std::monostate, HingeMotionSpec, TranslationMotionSpec, TableMotionSpec>;

/// Rigid ground, wall or hull that only contacts notice.
struct RigidSpec {
  std::string name;
  RigidShape shape;
  RigidMotion motion;
  SourceRef at;
  bool operator==(const RigidSpec&) const = default;
};
/// Two that touch: penalty with Coulomb friction, see contact/surface_contact and membrane_contact.
struct ContactSpec {
  std::array<std::string, 2> between;  ///< see ContactPair
  double friction = 0;                 ///< mu [-]
  double stiffness = 1;                ///< of the penalty, over P / h of the body that touches, P its wave modulus [-]
  double damping = 1;                  ///< of a rigid body's penalty, over the impedance rho c of that body [-]
  SourceRef at;
  bool operator==(const ContactSpec&) const = default;
};

}  // namespace geodrop
