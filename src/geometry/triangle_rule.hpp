// Integrals over triangles.
#pragma once

#include <array>

namespace geodrop {

/// A point of a rule, by the shares of the corners; weights add up to one.
struct TrianglePoint {
  std::array<double, 3> share;
  double weight;
};

/// Exact for polynomials of degree 4 (Dunavant 1985).
inline constexpr std::array<TrianglePoint, 6> triangle_degree_4 = [] {
  constexpr double near_a = 0.445948490915965, near_w = 0.223381589678011, far_a = 0.091576213509771,
                   far_w = 0.109951743655322;
  return std::array<TrianglePoint, 6>{{{{near_a, near_a, 1 - 2 * near_a}, near_w},
                                       {{near_a, 1 - 2 * near_a, near_a}, near_w},
                                       {{1 - 2 * near_a, near_a, near_a}, near_w},
                                       {{far_a, far_a, 1 - 2 * far_a}, far_w},
                                       {{far_a, 1 - 2 * far_a, far_a}, far_w},
                                       {{1 - 2 * far_a, far_a, far_a}, far_w}}};
}();

}  // namespace geodrop
