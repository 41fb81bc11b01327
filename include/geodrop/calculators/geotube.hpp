// The exact shape of a geotube at rest: a weightless, limp membrane tube in plane strain on smooth rigid ground, filled
// with a fluid under pressure, dry or in water that stands outside. docs/geotube.md has the equations and their
// sources.
#pragma once

#include <limits>
#include <optional>
#include <vector>

namespace geodrop {

/// Water at rest around the tube, over the ground on which the tube lies.
struct OutsideWater {
  double level = 0;        ///< above the ground [m]; 0: none; at least the tube's height: the tube is submerged
  double unit_weight = 0;  ///< [N/m3]
};

enum class GeotubeQuantity { area, height, top_pressure, tension };

/// A tube, and the one quantity that tells how full it is.
struct GeotubeInput {
  double perimeter;    ///< of the unstretched membrane [m]
  double unit_weight;  ///< of the fill [N/m3]
  double stiffness =
      std::numeric_limits<double>::infinity();  ///< J [N/m] of tension = J (length - perimeter)/perimeter
  OutsideWater water = {};
  GeotubeQuantity given = GeotubeQuantity::area;
  double value;  ///< area [m2], height [m], top pressure [Pa] or tension [N/m], see Geotube
};

/// A tube at rest. Pressures are differences across the membrane, inside minus outside.
struct Geotube {
  double perimeter;    ///< of the unstretched membrane [m]
  double unit_weight;  ///< of the fill [N/m3]
  OutsideWater water;
  double area;                  ///< [m2]
  double height;                ///< [m]
  double width;                 ///< greatest [m]
  double width_level;           ///< of the greatest width, above the ground [m]
  double base_width;            ///< of the contact with the ground [m]
  double length;                ///< of the stretched membrane [m]
  double strain;                ///< length / perimeter - 1 [-]
  double top_pressure;          ///< at the crown [Pa]
  double bottom_pressure;       ///< at the ground [Pa]
  double tension;               ///< the same everywhere [N/m]
  double fill_pressure_top;     ///< pressure inside over the atmosphere's, at the crown [Pa]
  double fill_pressure_bottom;  ///< the same at the ground [Pa]
};

/// Every result to 1e-8 of itself (most to 1e-12). Throws SceneError, its key one of perimeter, unit-weight, stiffness,
/// area, height, pressure, tension, water-level, water-unit-weight, if there is no such tube; says within which limits
/// there is. Strains over 1 are refused: T = J strain means nothing there, and one pressure would belong to two tubes.
Geotube solve_geotube(const GeotubeInput& input);

/// The same, but empty if the tube floats, without the search for the highest water that it rests in.
std::optional<Geotube> find_geotube(const GeotubeInput& input);

/// A point of the membrane.
struct OutlinePoint {
  double s;         ///< along the stretched membrane, clockwise from the crown [m]
  double x;         ///< from the plane of symmetry [m]
  double z;         ///< above the ground [m]
  double theta;     ///< by which the membrane has turned clockwise since the crown [rad]; pi on the ground
  double pressure;  ///< difference across the membrane, inside minus outside [Pa]
};

/// The closed membrane as `segments` pieces of equal length: segments + 1 points, the crown first and last.
std::vector<OutlinePoint> geotube_outline(const Geotube& tube, int segments);

}  // namespace geodrop
