// A line of straight edges as a rigid surface (2D): the outline of a polygon, or a polyline with a half thickness r.
//
//   beside an edge   g = s n_left . (x - a) - r on the side s of a point; of a polygon, stored clockwise, the left
//   at a corner      g = +-|x - corner| - r, with the sign of the side (that of n_left of both edges added up)
//
// The nearest edge or corner decides whether a point is in front of the line or has crossed it. In front of several
// faces, as in an inner corner, a point touches the two that it is deepest in. Their penalties share it: depths d_1,
// d_2 in faces with c = n_1 . n_2 > 0 push with
//
//   l_1 + c l_2 = d_1,   c l_1 + l_2 = d_2,   l >= 0
//
// so that each pushes alone where they are at right angles, and where they are nearly parallel (a curve of many edges)
// both together push as one.
#pragma once

#include <geodrop/base/types.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace geodrop {

/// Where a point is to a surface.
struct SurfaceGap {
  double size = 0;                 ///< negative inside [m]
  Vec<2> normal = Vec<2>::Zero();  ///< unit, out of the rigid body
  std::int8_t side = 0;            ///< as RigidContact::side
  std::uint32_t piece = 0;         ///< as RigidContact::piece
  double share = 1;                ///< of the point's length that this face pushes with [-]
};

/// The faces that a point touches, by their pieces: none, one or two.
struct SurfaceTouch {
  std::array<SurfaceGap, 2> gaps;
  int count = 0;
  const SurfaceGap* begin() const { return gaps.data(); }
  const SurfaceGap* end() const { return gaps.data() + count; }
};

class EdgeLine {
 public:
  /// Without half thickness the line is closed: a polygon, its corners clockwise.
  EdgeLine(std::vector<Vec<2>> corners, double half_thickness);

  /// Nearest face. Nothing if the point has passed through a polyline; `side`: that of the point so far.
  std::optional<SurfaceGap> gap(const Vec<2>& x, std::int8_t side) const;
  /// Faces closer than `reach` [m].
  SurfaceTouch touch(const Vec<2>& x, std::int8_t side, double reach) const;
  /// Distance from what is inside [m], 0 there; a bound from below if it is more than `far` [m].
  double distance(const Vec<2>& x, double far) const;
  const std::vector<Vec<2>>& corners() const { return corners_; }
  /// The surface as a closed line; corners of a polyline are pointed [m].
  std::vector<Vec<2>> outline() const;

 private:
  struct Face {
    double distance;  ///< from the line [m]
    Vec<2> left;      ///< unit: of an edge its left normal, of a corner away from it
    int sign;         ///< 1: the point is on the left, -1: on the right, 0: beyond an end
    std::uint32_t piece;
  };
  bool closed() const { return half_thickness_ == 0; }
  std::size_t edges() const { return closed() ? corners_.size() : corners_.size() - 1; }
  const Vec<2>& end_of(std::size_t edge) const { return corners_[edge + 1 == corners_.size() ? 0 : edge + 1]; }
  std::optional<Face> beside(std::size_t edge, const Vec<2>& x) const;
  Face at_corner(std::size_t corner, const Vec<2>& x) const;
  bool in_cone(std::size_t corner, const Vec<2>& x) const;
  std::optional<Face> nearest(const Vec<2>& x) const;
  SurfaceGap gap_to(const Face& face, int side) const;

  std::vector<Vec<2>> corners_;
  std::vector<Vec<2>> direction_;  ///< of edges, unit
  std::vector<double> length_;     ///< of edges [m]
  double half_thickness_;
  Vec<2> lower_, upper_;  ///< of a box around [m]
};

}  // namespace geodrop
