// A frame of a run as a picture: particles coloured by a field or by layers, membranes by what they bear, rigid bodies.
#pragma once

#include <geodrop/scene/scene.hpp>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "files/snapshot.hpp"
#include "raster.hpp"

namespace geodrop {

using ValueRange = std::pair<double, double>;  ///< in SI units

struct PictureOptions {
  std::string field = "layers";        ///< or "material", or of the frame: "velocity", "stress_yy", ...
  std::string membrane = "tension";    ///< a field of membranes, or "none"
  std::optional<Window> window;        ///< empty: all particles, membranes and rigid bodies but half-planes
  std::optional<ValueRange> range;     ///< of the field; empty: of the frames drawn
  std::optional<ValueRange> tensions;  ///< of the membranes' field; empty: from 0 to the largest
};

/// Fields that a frame may be coloured by.
std::vector<std::string> picture_fields(const Snapshot& snapshot);

/// Throws SceneError if the scene is not of the plane or the frame has no such field.
void check_picture(const Scene& scene, const Snapshot& snapshot, const PictureOptions& options);

/// Writes a PNG.
void draw_snapshot(const Scene& scene, const Snapshot& snapshot, const PictureOptions& options,
                   const std::filesystem::path& file);

/// Writes a GIF that repeats, all pictures with the same window and scales. `directory`, `frames`: of the run.
void draw_animation(const Scene& scene, const std::filesystem::path& directory, const std::vector<std::size_t>& frames,
                    PictureOptions options, const std::filesystem::path& file);

}  // namespace geodrop
