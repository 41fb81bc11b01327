// Closed triangulated surfaces of simple shapes, with edges of about a given length.
#pragma once

#include <geodrop/geometry/triangle_surface.hpp>

namespace geodrop {

/// An icosahedron whose faces are divided evenly and moved out to the ellipsoid; edges are on its longest axis.
TriangleSurface ellipsoid_surface(const Corner& centre, const Corner& semi_axes, double edge);

/// A cylinder with hemispherical caps about the ends of a segment: rings of triangles that are about equilateral.
TriangleSurface capsule_surface(const Corner& from, const Corner& to, double radius, double edge);

/// A cylinder with flat ends about a segment. Its section, anticlockwise as seen from `to`, is one polygon for all
/// rings: an even number of points, of which every second one is in a ring and the others in the next one. The first
/// coordinate is level, that along x of an upright tube.
TriangleSurface tube_surface(const Corner& from, const Corner& to, const std::vector<Point>& section, double edge);

/// The largest thickness of a pillow over its length and width, or of a disc over its diameter.
inline constexpr double most_open = 0.7;

/// Two flat rectangles of cloth, sewn together along their rims, at z = centre. Drawn open, `thickness` in the middle:
/// bent to circular arcs across, and along over the middle line, so that no arc is longer than the flat cloth.
TriangleSurface pillow_surface(const Corner& centre, double length_x, double length_y, double thickness, double edge);

/// Likewise two discs: spherical caps.
TriangleSurface disc_pillow_surface(const Corner& centre, double radius, double thickness, double edge);

}  // namespace geodrop
