// Surfaces of membranes in space, from their keys.
#pragma once

#include <geodrop/scene/scene.hpp>

#include <string>

namespace geodrop {

/// A mistake in a surface, and what is allowed instead; none if `found` is empty.
struct SurfaceFault {
  std::string found, allowed;
  std::string key = ".surface";  ///< of the membrane
};

/// Draws the surface of a membrane with edges of h / segments_per_cell, or reads its file, which is beside
/// `scene_file`. Cuts it off at walls where it ends. Fills MembraneSpec::drawn unless there is a mistake.
SurfaceFault draw_surface(const GridSpec& grid, const WallsSpec& walls, const std::string& scene_file,
                          MembraneSpec& membrane);

/// Where the file of a surface is.
std::string surface_path(const std::string& scene_file, const std::string& file);

}  // namespace geodrop
