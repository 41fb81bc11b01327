// A frame as pictures show it: the plane as it is; a scene in space from its side and from its front, cut by a plane
// across the view, or the outside of its membranes.
#pragma once

#include <geodrop/scene/scene.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "files/snapshot.hpp"
#include "raster.hpp"

namespace geodrop {

/// A box of the scene along its axes.
struct Extent {
  std::array<double, 3> lower{1e300, 1e300, 1e300}, upper{-1e300, -1e300, -1e300};  ///< [m]; in the plane z is unused

  void add(const double* point);
  void widen(double margin);  ///< [m]
  double size(std::size_t axis) const { return upper[axis] - lower[axis]; }
};

/// Of all points, three numbers each.
Extent extent_of(const std::vector<double>& points);

/// Particles, membranes and rigid bodies but half-planes, in space the domain as well; and a margin.
Extent whole_extent(const Scene& scene, const Snapshot& snapshot);

/// Whether a rigid body, by its index in the scene, is a half-plane or half-space.
bool is_plane_without_end(const Scene& scene, std::uint32_t rigid);

/// The lines of one rigid body: from `first` on, before `end`.
struct BodyLines {
  std::size_t first = 0, end = 0;
};
std::vector<BodyLines> lines_by_body(const RigidSnapshot& rigid);

/// Axes of the scene to the right, upwards, and along the line of sight.
struct Facing {
  std::array<std::size_t, 3> axis;
  double toward = 1;  ///< 1: what is nearer to the viewer lies further along the third axis; -1: less far
  const char* name = "";
};

/// A frame in the coordinates of a picture: x to the right, y up, z towards the viewer.
struct View {
  Facing facing;
  std::string title;  ///< empty: the picture's
  Snapshot frame;
};

/// What of a scene in space is seen.
enum class Sight {
  cut,     ///< cut_frame
  outside  ///< triangles of the membranes
};

/// One view of the plane; of space the side and the front. `cut`: x of the plane of the front, y of that of the side
/// [m]; empty: the middle of the membranes (a plane of symmetry at which they end), without any of the domain.
std::vector<View> views_of(const Scene& scene, const Snapshot& snapshot, Sight sight,
                           const std::optional<std::array<double, 2>>& cut);

Window window_of(const Extent& extent, const Facing& facing);

}  // namespace geodrop
