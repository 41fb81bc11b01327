// The cross-section of a tube of given membrane length and tension.
#pragma once

#include <geodrop/calculators/geotube.hpp>

#include "membrane_path.hpp"

#include <optional>

namespace geodrop {

/// What surrounds the membrane.
struct TubeFluids {
  double unit_weight;  ///< of the fill [N/m3]
  OutsideWater water;
};

/// What is left to find when height and pressures are known.
struct TubeSection {
  double half_arc;   ///< from the crown to the ground [m]
  double half_base;  ///< [m]
  double area;       ///< whole [m2]
};

struct TubeShape {
  MembraneLoad load;
  TubeSection section;
};

/// Heights and pressures that belong to a pressure at the crown [Pa] and a tension [N/m]. For a fill that is not
/// heavier than the water and a tube that is all below it, there are none: the height then is the water's, the change
/// there.
MembraneLoad find_load(const TubeFluids& fluids, double top_pressure, double tension);

/// Of a membrane `length` long [m]; empty if the tube floats.
std::optional<TubeShape> find_shape(const TubeFluids& fluids, double length, double tension);

}  // namespace geodrop
