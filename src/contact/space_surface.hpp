// Where the surface of a rigid body in space is and how it moves: gaps to points, velocities.
//
//   half-space     g = n . (x - a)
//   box, prism     a section in the plane of y and z (edge_line.hpp) between two faces across x; a point inside leaves
//                  by the section's faces or by one of these two, whichever is nearer
#pragma once

#include <geodrop/scene/scene.hpp>
#include <geodrop/state/state.hpp>

#include <optional>

#include "rigid_surface.hpp"

namespace geodrop {

/// A rigid body as it stands at the start of the scene.
RigidBody<3> make_rigid_body(const RigidSpec& spec);

/// In the plane of y and z, as drawn.
PolygonShape section_of(const PrismShape& prism);

/// How far a point is inside, and the way out.
struct SpaceDepth {
  double size = 0;                 ///< > 0 [m]
  Vec<3> normal = Vec<3>::Zero();  ///< unit, out of the rigid body
};

/// The surface in its present pose.
class SpaceSurface {
 public:
  explicit SpaceSurface(const RigidBody<3>& body);

  /// Nothing for a point outside.
  std::optional<SpaceDepth> depth(const Vec<3>& x) const;
  /// Of the surface's material at x [m/s].
  Vec<3> velocity(const Vec<3>& x) const;
  /// Largest speed of its points [m/s].
  double speed() const;

 private:
  Vec<3> point_, normal_, drift_;        ///< of a half-space
  std::optional<RigidSurface> section_;  ///< of a box or prism
  double least_x_, largest_x_;           ///< likewise [m]
};

/// The corners of a box or prism, those of its least x first; none of a half-space [m].
std::vector<Vec<3>> corners(const RigidBody<3>& body);

}  // namespace geodrop
