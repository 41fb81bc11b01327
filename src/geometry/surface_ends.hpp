// Surfaces that end at planes: half a body beside a plane of symmetry, a slice of a long tube.
#pragma once

#include <geodrop/geometry/triangle_surface.hpp>

#include <vector>

namespace geodrop {

/// Cuts off what lies beyond the plane. Points closer to it than `snap` [m] are moved onto it, so that no triangle is
/// left with an edge much shorter than that; triangles across it are parted. Points on it have its coordinate to the
/// last bit, and triangles in it are left out.
TriangleSurface cut_off(TriangleSurface surface, const SurfaceEnd& end, double snap);

/// The edges on the plane that one triangle has, as it runs along them.
std::vector<SurfaceEdge> open_edges(const TriangleSurface& surface, const SurfaceEnd& end);

/// A point in the plane of an end, and in those of the other ends across other axes; else where `near` is. With the
/// open edges of the end it makes a fan that closes the surface there.
Corner middle_of_fan(const std::vector<SurfaceEnd>& ends, const SurfaceEnd& end, const Corner& near);

/// The surface with a fan over each of its ends: closed.
TriangleSurface with_fans(TriangleSurface surface, const std::vector<SurfaceEnd>& ends);

}  // namespace geodrop
