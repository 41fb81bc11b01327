// The logarithmic law of a rough wall, u / u_tau = ln((y + y_0) / y_0) / kappa, y_0 = k_s / 30 (von Karman 1930;
// Nikuradse 1933).
#pragma once

#include <cmath>

namespace geodrop {

inline constexpr double von_karman = 0.4;
inline constexpr double rough_wall_share = 1.0 / 30;  ///< y_0 over k_s

/// C_f = 2 (u_tau / u)^2 for the velocity u at the distance y [m] from a wall of the roughness k_s [m].
inline double rough_wall_friction(double y, double roughness) {
  const double root = von_karman / std::log1p(y / (rough_wall_share * roughness));
  return 2 * root * root;
}

}  // namespace geodrop
