// A frame in space cut by a plane: what pictures show of particles.
#pragma once

#include <cstddef>

#include "files/snapshot.hpp"

namespace geodrop {

/// All points with this coordinate along an axis of the scene.
struct CutPlane {
  std::size_t axis = 0;
  double place = 0;  ///< [m]
};

/// Particles whose centre is at most `reach` [m] from the plane and on the side of each membrane on which the plane is
/// there; segments in which it cuts the triangles of membranes, with the values of these; rigid bodies as they are.
Snapshot cut_frame(const Snapshot& frame, const CutPlane& plane, double reach);

}  // namespace geodrop
