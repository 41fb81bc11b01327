// Points of a triangle in space.
#pragma once

#include <geodrop/base/types.hpp>

#include <array>

namespace geodrop {

/// The point of a triangle nearest to x, by the region that x lies in (Ericson 2005, 5.1.5).
Vec<3> nearest_point(const std::array<Vec<3>, 3>& corner, const Vec<3>& x);

/// Shares of the corners in a point of the triangle, by the areas opposite to them.
std::array<double, 3> corner_shares(const std::array<Vec<3>, 3>& corner, const Vec<3>& point);

}  // namespace geodrop
