// Runs side by side.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace geodrop {

/// Tables as text: keys of the scenes that differ; results of all runs and, of two, their difference, absolute and in
/// per cent of the first; steps and wall time. Throws SceneError if a directory is no run's.
std::string compare_runs(const std::vector<std::filesystem::path>& runs);

}  // namespace geodrop
