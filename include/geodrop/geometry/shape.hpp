// Shapes that a scene draws. Vectors have as many entries as the scene has dimensions.
#pragma once

#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace geodrop {

using Point = std::vector<double>;  ///< coordinates or components [m, m/s, ...], size = dimension

struct BoxShape {
  Point lower, upper;  ///< [m]
  bool operator==(const BoxShape&) const = default;
};
/// In 3D an ellipsoid with its axes along x, y, z.
struct EllipseShape {
  Point centre;           ///< [m]
  Point semi_axes;        ///< [m]
  double tilt_deg = 0.0;  ///< anticlockwise rotation of the axes, 2D only [degree]
  bool operator==(const EllipseShape&) const = default;
};
/// A rectangle with a semicircle on both of its short sides; in the plane.
struct StadiumShape {
  Point centre;           ///< [m]
  Point semi_axes;        ///< half of its extents, of which the smaller is the radius of its ends [m]
  double tilt_deg = 0.0;  ///< anticlockwise rotation of the axes [degree]
  bool operator==(const StadiumShape&) const = default;
};
struct PolygonShape {
  std::vector<Point> points;  ///< [m], simple polygon, either orientation
  bool operator==(const PolygonShape&) const = default;
};
/// In 3D a half-space.
struct HalfPlaneShape {
  Point point;   ///< a point of the boundary [m]
  Point normal;  ///< points out of the body
  bool operator==(const HalfPlaneShape&) const = default;
};
class SurfaceRegion;
/// What a membrane in space encloses as it is drawn.
struct InsideShape {
  std::string membrane;
  std::shared_ptr<const SurfaceRegion> region{};  ///< follows from the membrane; null until that is drawn
  bool operator==(const InsideShape& other) const { return membrane == other.membrane; }
};
using Shape = std::variant<BoxShape, EllipseShape, StadiumShape, PolygonShape, HalfPlaneShape, InsideShape>;

}  // namespace geodrop
