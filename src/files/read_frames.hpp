// Frames of a run, read back from its VTK files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "snapshot.hpp"

namespace geodrop {

/// Times of the frames in the order of their numbers [s], from particles.pvd. Throws SceneError if the directory has
/// none.
std::vector<double> frame_times(const std::filesystem::path& directory);

/// The frame that is nearest to this time.
std::size_t frame_near(const std::vector<double>& times, double t);

/// Throws SceneError if a file of the frame is missing or cannot be read.
Snapshot read_frame(const std::filesystem::path& directory, std::size_t index);

}  // namespace geodrop
