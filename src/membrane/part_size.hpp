// Size of a part of a membrane, in the plane and in space.
#pragma once

#include <geodrop/state/state.hpp>

#include "outline.hpp"
#include "triangles.hpp"

namespace geodrop {

/// Length of a segment, area of a triangle now [m, m2].
inline double size_of(const Membrane<2>& membrane, std::size_t segment) { return segment_length(membrane, segment); }
inline double size_of(const Membrane<3>& membrane, std::size_t triangle) {
  return 0.5 * normal_of(membrane, triangle).norm();
}

}  // namespace geodrop
