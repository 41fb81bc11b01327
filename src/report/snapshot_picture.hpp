// A frame of a run as a picture: particles coloured by a field or by layers, membranes by what they bear, rigid bodies.
// In space two views side by side, see picture_views.
#pragma once

#include <geodrop/scene/scene.hpp>

#include <filesystem>
#include <vector>

#include "files/snapshot.hpp"
#include "picture_content.hpp"

namespace geodrop {

/// Throws SceneError if the frame has no such field, or an option does not fit the dimension of the scene.
void check_picture(const Scene& scene, const Snapshot& snapshot, const PictureOptions& options);

/// Writes a PNG.
void draw_snapshot(const Scene& scene, const Snapshot& snapshot, const PictureOptions& options,
                   const std::filesystem::path& file);

/// Writes a GIF that repeats, all pictures with the same window and scales. `directory`, `frames`: of the run.
void draw_animation(const Scene& scene, const std::filesystem::path& directory, const std::vector<std::size_t>& frames,
                    PictureOptions options, const std::filesystem::path& file);

}  // namespace geodrop
