// Closed triangulated surfaces of simple shapes, with edges of about a given length.
#pragma once

#include <geodrop/geometry/triangle_surface.hpp>

namespace geodrop {

/// An icosahedron whose faces are divided evenly and moved out to the ellipsoid; edges are on its longest axis.
TriangleSurface ellipsoid_surface(const Corner& centre, const Corner& semi_axes, double edge);

/// A cylinder with hemispherical caps about the ends of a segment: rings of triangles that are about equilateral.
TriangleSurface capsule_surface(const Corner& from, const Corner& to, double radius, double edge);

/// Two flat rectangles of cloth, sewn together along their rims, at z = centre. Drawn a little open: `thickness` in the
/// middle, less towards the rim as (1 - u^2)(1 - v^2).
TriangleSurface pillow_surface(const Corner& centre, double length_x, double length_y, double thickness, double edge);

/// Likewise two discs; open as 1 - (r/radius)^2.
TriangleSurface disc_pillow_surface(const Corner& centre, double radius, double thickness, double edge);

}  // namespace geodrop
