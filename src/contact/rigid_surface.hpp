// Where the surface of a rigid body is and how it moves (2D): gaps to points, velocities.
//
//   capsule        beside its segment: g = s n_left . (x - a) - r on the side s on which the point came, down to -2 r;
//                  beyond its ends:    g = |x - end| - r
//   half-plane     g = n . (x - a)
//   box, polygon, polyline: edge_line.hpp
#pragma once

#include <geodrop/scene/scene.hpp>
#include <geodrop/state/state.hpp>

#include <optional>

#include "edge_line.hpp"

namespace geodrop {

/// A rigid body as it stands at the start of the scene; of a half-plane's boundary the part in the domain is kept.
RigidBody<2> make_rigid_body(const RigidSpec& spec, const GridSpec& domain);

/// Of a box or polygon of the plane [m].
std::vector<Point> clockwise_corners(const RigidShape& shape);

/// The surface in its present pose.
class RigidSurface {
 public:
  explicit RigidSurface(const RigidBody<2>& body);

  using Gap = SurfaceGap;
  /// `side`: that of the point so far. Nothing if the point has passed through.
  std::optional<Gap> gap(const Vec<2>& x, std::int8_t side) const;
  /// The faces closer than `reach` [m]: one, or two of a polygon or polyline.
  SurfaceTouch touch(const Vec<2>& x, std::int8_t side, double reach) const;
  /// Whether it is a polygon or polyline, whose faces have numbers.
  bool has_pieces() const { return line_.has_value(); }
  /// Of a polygon or polyline, else none [m].
  std::vector<Vec<2>> corners() const { return line_ ? line_->corners() : std::vector<Vec<2>>{}; }
  /// Of the surface's material at x [m/s].
  Vec<2> velocity(const Vec<2>& x) const;
  /// Largest speed of its points, of a half-plane's boundary within the domain at the start [m/s].
  double speed() const;
  /// False only if no point of a box is closer than `reach` [m].
  bool may_touch(const Vec<2>& lower, const Vec<2>& upper, double reach) const;

 private:
  bool half_plane_;
  double radius_;
  Vec<2> from_, to_, normal_;  ///< of a capsule: unit, left of its segment
  double length_;
  std::optional<EdgeLine> line_;  ///< of a box, polygon or polyline
  Vec<2> centre_, drift_;
  double spin_;
};

/// The outline, of a capsule with chords as its ends; of a half-plane the ends of its boundary [m].
std::vector<Vec<2>> outline(const RigidBody<2>& body);

}  // namespace geodrop
