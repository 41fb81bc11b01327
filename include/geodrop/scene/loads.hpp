// What acts on bodies and membranes from outside of the simulated domain.
#pragma once

#include <geodrop/base/error.hpp>
#include <geodrop/geometry/shape.hpp>

#include <limits>
#include <string>
#include <variant>

namespace geodrop {

/// Fluid at rest outside of a closed membrane, or inside: its pressure acts on the membrane, nothing moves it.
struct StillFluidSpec {
  enum class Side { outside, inside };
  std::string membrane;
  std::string fluid;  ///< material name of a Newtonian fluid
  Side side = Side::outside;
  double surface = 0;  ///< level of its surface, or of no pressure in a tube that is pumped up [m]
  SourceRef at;
  bool operator==(const StillFluidSpec&) const = default;
};
/// A line on a body's outline that lets waves out, see boundary/viscous_boundary.
struct ViscousBoundarySpec {
  std::string name;
  std::string body;
  Point from, to;           ///< ends of the line [m]
  double spring_depth = 0;  ///< thickness of the layer of the same ground that its spring stands for [m]
  SourceRef at;
  bool operator==(const ViscousBoundarySpec&) const = default;
};
/// A side of the domain through which pressure waves in a still fluid leave, see boundary/silent_side.
struct SilentSideSpec {
  enum class Side { left, right };
  std::string name;
  std::string body;
  Side side = Side::left;
  double width = 0;         ///< of the layer beside the wall in which waves fade [m]
  double water_beyond = 0;  ///< how much of the water beyond flows with that inside [m]; inf: none
  double rest_time = 0;     ///< what lasts longer is taken for the state at rest [s]; inf: nothing is
  SourceRef at;
  bool operator==(const SilentSideSpec&) const = default;
};
/// Holds a node where it is drawn.
struct HeldSpec {
  bool operator==(const HeldSpec&) const = default;
};
/// An elastic line without mass from a node to a fixed point, which bears tension only.
struct AnchorLineSpec {
  Point to;                                                    ///< the fixed point [m]
  double stiffness = std::numeric_limits<double>::infinity();  ///< force per extension [N/m], 2D: per metre of depth
  double length = 0;                                           ///< at rest [m]
  bool operator==(const AnchorLineSpec&) const = default;
};
/// Where a membrane hangs, see membrane/anchors.
struct AnchorSpec {
  std::string name;
  std::string membrane;
  Point point;  ///< on the membrane as drawn: its nearest node is held [m]
  std::variant<HeldSpec, AnchorLineSpec> by;
  SourceRef at;
  bool operator==(const AnchorSpec&) const = default;
};
/// Fluid that is pumped into a body while from <= t < to: its rest volume grows.
struct PumpSpec {
  std::string body;
  double rate = 0;          ///< rest volume per time [m3/s], per metre of depth in 2D [m2/s]
  double from = 0, to = 0;  ///< [s]
  SourceRef at;
  bool operator==(const PumpSpec&) const = default;
};

}  // namespace geodrop
