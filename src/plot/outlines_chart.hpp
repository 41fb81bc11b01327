// Where bags lie at the ends of runs: their outlines in one picture.
#pragma once

#include "chart.hpp"

#include <filesystem>
#include <vector>

namespace geodrop {

/// Of runs, or of those of a sweep or an ensemble that are done: each membrane that bears tension in the last frame,
/// true to scale. Throws SceneError for a scene in space, one without such a membrane, or a directory without runs that
/// are done.
Chart outlines_chart(const std::vector<std::filesystem::path>& directories);

}  // namespace geodrop
