// The right half of a tube's membrane, from the crown to where it meets the ground, as a function of arc length.
//
//   T dtheta/ds = p,  dx/ds = cos theta,  dy/ds = sin theta,  dp/ds = g sin theta        (y downwards from the crown)
//
// with g the unit weight of the fill, and below the water level outside that of the fill less that of the water.
#pragma once

#include <array>
#include <limits>
#include <vector>

namespace geodrop {

/// What the shape of a tube follows from. `gradient` is dp/dy of the pressure difference across the membrane.
struct MembraneLoad {
  double top_pressure;     ///< at the crown [Pa]
  double bottom_pressure;  ///< at the ground [Pa]
  double tension;          ///< [N/m]
  double height;           ///< of the crown above the ground [m]
  double upper_gradient;   ///< down to `change_level` [N/m3]
  double lower_gradient;   ///< below it [N/m3]
  double change_level;     ///< above the ground [m]; 0 where the gradient is the same all the way
};

struct PathPoint {
  double s, x, y, theta, pressure;  ///< y is the depth below the crown
  double area;                      ///< between both halves of the membrane above this point [m2]
};

/// Taylor series in s, piece by piece. In s the curve is smooth everywhere, from a circle to a tube that is flat but
/// for its edges, where formulas in theta cancel digits. Also without the elliptic integrals' restriction to g > 0.
class MembranePath {
 public:
  /// All pressures must be positive, so that the membrane keeps turning one way. Ends beyond an arc length of
  /// `longest`, before the ground if that is farther.
  explicit MembranePath(const MembraneLoad& load, double longest = std::numeric_limits<double>::infinity());

  const PathPoint& end() const { return end_; }  ///< where the membrane meets the ground: theta = pi
  PathPoint at(double s) const;                  ///< 0 <= s <= end().s
  PathPoint where_upright() const;               ///< theta = pi/2: the greatest width

 private:
  static constexpr int order = 20;
  using Series = std::array<double, order + 1>;
  struct Piece {
    double s, length;
    Series x, y, theta, pressure, area;  ///< coefficients of powers of the arc length from s
    PathPoint point(double part) const;  ///< at `part` of the length
    double part_where_theta(double theta) const;
  };
  static Piece start_piece(const PathPoint& at, double gradient, double tension);
  /// Adds pieces from the end until the membrane has turned to theta, or is too long.
  void follow(double gradient, double tension, double theta);

  double longest_;
  std::vector<Piece> pieces_;
  PathPoint end_{};
};

}  // namespace geodrop
